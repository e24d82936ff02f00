"""A symmetry plane: the body goes on as its own mirror image on the other side.

The plane lies on a grid line. Particles near it reach the nodes one row outside (GIMP); their image
reaches the row inside by the same amount. So the sums of the row outside are added, reflected, to
the row inside, and the row outside becomes the image of the row inside: with this a half model
repeats the whole one to round-off.

A crack that lies on the plane separates body and image: rows reached through it are free surface,
and so are the nodes of the plane that lie on it. Beside a smooth tip body and image share nodes in
part: a node has a row for either of them, and the one is the image of the other.
"""

from typing import NamedTuple

import numpy as np

from cramp_cli.cracks.crossing import crosses
from cramp_cli.cracks.rows import find_row, row_across
from cramp_cli.cracks.segments import ON_CRACK
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
    """Return the row of node `image` that is the image of `row`, of the same body, or -1.

    It belongs to the same side of all cracks, but to the other side of the crack on the plane; such
    rows there are only where a smooth tip lets body and image share a node.
    """
    if row < nodes:
        return find_row(rows, image, rows.lowest[row], -1, 0, -1, 0)
    e = row - nodes
    a, b = rows.crack[e, 0], rows.crack[e, 1]
    first, second = rows.side[e, 0], rows.side[e, 1]
    if crack >= 0:
        first = -first if rows.owner[e, 0] == crack else first
        second = -second if rows.owner[e, 1] == crack else second
    return find_row(rows, image, rows.group[e], a, first, b, second if b >= 0 else 0)


@kernel
def image_on_plane(rows, row, crack):
    """Return the row that is the image of an extra row of a node on the plane, or -1.

    Both belong to the same node, on either side of the crack that lies on the plane.
    """
    if crack < 0:
        return -1
    e = row - len(rows.first)
    if rows.owner[e, 0] == crack:
        return row_across(rows, e, 0)
    return row_across(rows, e, 1) if rows.owner[e, 1] == crack else -1


@kernel
def reflect(field, rows, axis, crack, outside, inside, add):
    """Make the rows outside images of those inside; with `add`, sum both sides first.

    field: (rows, k), a vector per row; axis: component that changes its sign, -1 for none
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
def reflect_on(field, rows, axis, crack, on, free, add):
    """Make the two rows of a node on the plane that body and image share images of each other.

    field: (rows, k); axis: component that changes its sign, -1 for none; with `add`, sum both first
    """
    nodes = len(rows.first)
    for i in range(len(on)):
        row = rows.first[on[i]]
        while row >= 0:
            image = image_on_plane(rows, row, crack) if free[i] else -1
            if image >= 0 and rows.tip_split[on[i]]:
                for d in range(field.shape[1]):
                    sign = -1.0 if d == axis else 1.0
                    if add:
                        field[row, d] += sign * field[image, d]
                    field[image, d] = sign * field[row, d]
            row = rows.next[row - nodes]


@kernel
def double_on(field, rows, crack, on, free):
    """Add the image's share to the rows on the plane, except along its crack; field: (rows, k)."""
    nodes = len(rows.first)
    for i in range(len(on)):
        row = on[i]
        while row >= 0:
            beyond = row >= nodes and (
                rows.owner[row - nodes, 0] == crack or rows.owner[row - nodes, 1] == crack
            )
            if not free[i] and not (beyond and crack >= 0):
                for d in range(field.shape[1]):
                    field[row, d] *= 2.0
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
        free[i] = rows.tip_split[on[i]] if rows.tip[on[i]] // 2 == crack else odd


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
                rows.owner[row - nodes, 0] == crack or rows.owner[row - nodes, 1] == crack
            )
            if not free[i] and not (beyond and crack >= 0):
                taken += field[row, axis]
                field[row, axis] = 0.0
            row = rows.first[row] if row < nodes else rows.next[row - nodes]
    return taken


@kernel
def sum_outside(force, rows, axis, crack, outside, inside, on):
    """Return the sum of the normal components in the rows that are the image's.

    These are the nodes outside, and where body and image share nodes the rows across the crack.
    """
    total, nodes = 0.0, len(rows.first)
    for i in range(len(outside)):
        total += force[outside[i], axis]
    for i in range(len(inside)):
        row = rows.first[inside[i]]
        while row >= 0:
            if image_on_plane(rows, row, crack) >= 0:
                total += force[row, axis]
            row = rows.next[row - nodes]
    for i in range(len(on)):
        row = rows.first[on[i]]
        while row >= 0:
            image = image_on_plane(rows, row, crack)
            if image >= 0 and rows.tip_split[on[i]]:
                body = rows.tip_side[inside[i]] == rows.side[row - nodes, 0]
                total += force[image if body else row, axis]
            row = rows.next[row - nodes]
    return total


def reflect_even(m: Mirror, free, rows, field) -> None:
    """Give a sum (rows, k) that has no direction on both sides of a plane to each other."""
    reflect(field, rows, -1, m.crack, m.outside, m.inside, True)
    double_on(field, rows, m.crack, m.on, free)
    reflect_on(field, rows, -1, m.crack, m.on, free, True)
