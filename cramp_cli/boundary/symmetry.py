"""A symmetry plane: the body goes on as its own mirror image on the other side.

The plane lies on a grid line. Particles near it reach the nodes one row outside (GIMP); their image
reaches the row inside by the same amount. So the sums of the row outside are added, reflected, to
the row inside, and the row outside becomes the image of the row inside: with this a half model
repeats the whole one to round-off.

A crack that lies on the plane separates body and image: rows reached through it are free surface,
and so are the nodes of the plane that lie on it.
"""

from typing import NamedTuple

import numpy as np

from cramp_cli.cracks.crossing import ON_CRACK, crosses
from cramp_cli.cracks.rows import find_row
from cramp_cli.numerics.kernel import kernel


class Mirror(NamedTuple):
    """Nodes of a symmetry plane and the rows of nodes beside it."""

    axis: int  # normal of the plane
    on: np.ndarray  # (n,) nodes of the plane
    place: np.ndarray  # (n, dim) where they are (m)
    outside: np.ndarray  # (n,) nodes one row outside
    inside: np.ndarray  # (n,) their images one row inside
    crack: int  # crack that lies on the plane, or -1


@kernel
def image_row(rows, nodes, row, image, crack):
    """Return the row of node `image` of the same body and side of all cracks as `row`.

    returns -1 where there is none or where `row` is reached through the crack on the plane
    """
    if row < nodes:
        return find_row(rows, image, rows.lowest[row], -1, 0, -1, 0)
    e = row - nodes
    a, b = rows.crack[e, 0], rows.crack[e, 1]
    if crack >= 0 and crack in (a, b):
        return -1
    return find_row(rows, image, rows.group[e], a, rows.side[e, 0], b, rows.side[e, 1])


@kernel
def reflect(field, rows, axis, crack, outside, inside, add):
    """Make the rows outside images of those inside; with `add`, sum both sides first.

    field: (rows, dim), a vector per row; axis: normal of the plane
    """
    nodes = len(rows.first)
    for i in range(len(outside)):
        row = outside[i]
        while row >= 0:
            image = image_row(rows, nodes, row, inside[i], crack)
            if image >= 0:
                for d in range(field.shape[1]):
                    sign = -1.0 if d == axis else 1.0
                    if add:
                        field[image, d] += sign * field[row, d]
                    field[row, d] = sign * field[image, d]
            row = rows.first[row] if row < nodes else rows.next[row - nodes]


@kernel
def double_on(field, rows, crack, on, free):
    """Add the image's share to the rows on the plane, except along its crack; field: (rows, k)."""
    nodes = len(rows.first)
    for i in range(len(on)):
        row = on[i]
        while row >= 0:
            beyond = row >= nodes and (
                rows.crack[row - nodes, 0] == crack or rows.crack[row - nodes, 1] == crack
            )
            if not free[i] and not (beyond and crack >= 0):
                for d in range(field.shape[1]):
                    field[row, d] *= 2.0
            row = rows.first[row] if row < nodes else rows.next[row - nodes]


@kernel
def reflect_mass(mass, rows, crack, outside, inside):
    """Add the mass of rows outside to their images and copy it back."""
    nodes = len(rows.first)
    for i in range(len(outside)):
        row = outside[i]
        while row >= 0:
            image = image_row(rows, nodes, row, inside[i], crack)
            if image >= 0:
                mass[image] += mass[row]
                mass[row] = mass[image]
            row = rows.first[row] if row < nodes else rows.next[row - nodes]


@kernel
def find_open_nodes(free, rows, on, mirror_axis, crack, place, ends, down, owner, count, width):
    """Mark the nodes of the plane that its crack cuts: there the body is free.

    free: (n,) written; ends, owner: segments of all cracks and the crack of each
    """
    for i in range(len(free)):
        odd = False
        px, py = place[i, 0], place[i, 1]
        if mirror_axis == 0:
            px += 0.1 * width
        else:
            py += 0.1 * width
        for s in range(count):
            if owner[s] == crack:
                hit = crosses(ends, down, s, px, py, place[i, 0], place[i, 1], ON_CRACK * width)
                back = crosses(
                    ends, down, s, 2.0 * place[i, 0] - px, 2.0 * place[i, 1] - py,
                    place[i, 0], place[i, 1], ON_CRACK * width,
                )  # fmt: skip
                if hit != 0 or back != 0:
                    odd = not odd
        free[i] = odd and rows.tip[on[i]] // 2 != crack


@kernel
def stop_normal(field, rows, axis, crack, on, free):
    """Set the component normal to the plane to zero in the rows on it, except along its crack.

    returns: what was taken away, summed
    """
    nodes = len(rows.first)
    taken = 0.0
    for i in range(len(on)):
        row = on[i]
        while row >= 0:
            beyond = row >= nodes and (
                rows.crack[row - nodes, 0] == crack or rows.crack[row - nodes, 1] == crack
            )
            if not free[i] and not (beyond and crack >= 0):
                taken += field[row, axis]
                field[row, axis] = 0.0
            row = rows.first[row] if row < nodes else rows.next[row - nodes]
    return taken


@kernel
def sum_outside(force, axis, outside):
    """Return the sum of the normal components in the nodes outside."""
    total = 0.0
    for i in range(len(outside)):
        total += force[outside[i], axis]
    return total
