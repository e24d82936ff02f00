"""Cracks move with the solid: each surface with the rows of its side, the plane with their mean."""

from math import inf
from typing import NamedTuple

import numpy as np

from cramp_cli.cracks.crossing import ON_CRACK, crossed_cracks
from cramp_cli.cracks.rows import find_row, of_group
from cramp_cli.numerics.kernel import kernel

OFF_PLANE = 1e-4  # a surface looks at the nodes from this distance off the plane (cells)
LIGHT = 0.1  # rows of less than this share of the heaviest one around count less in even weights
LARGEST_STEP = 0.5  # a surface that would move further in one step (cells) stays


@kernel
def side_normal(point, k, first, last):
    """Return the unit normal at crack point k that points above."""
    i, j = max(k - 1, first), min(k + 1, last)
    dx, dy = point[j, 0] - point[i, 0], point[j, 1] - point[i, 1]
    size = np.sqrt(dx * dx + dy * dy)
    return (-dy / size, dx / size) if size > 0.0 else (0.0, 0.0)


@kernel
def surface_rows(rows, segments, of_crack, crack, side, node, cell, qx, qy, nx, ny, tolerance):
    """Return the rows of a node for one side of a crack at the point q, and for the other, or -1.

    Where rows of the node are told by this crack they decide: the row of the side, else the one
    without the crack. Without such rows the line from q to the node does. The other side counts
    beside a tip only.
    """
    group = of_crack[crack]
    crossed = crossed_cracks(segments, cell, qx, qy, nx, ny, tolerance)
    a, side_a, _, b, side_b, _, _ = of_group(crossed, of_crack, group)
    other, other_side = (b, side_b) if a == crack else (a, side_a)
    nodes = len(rows.first)
    beside_tip = rows.tip[node] // 2 == crack
    known = beside_tip
    row = rows.first[node]
    while row >= 0:
        for slot in range(2):
            known = known or rows.crack[row - nodes, slot] == crack
        row = rows.next[row - nodes]
    if not known:
        return find_row(rows, node, group, a, side_a, b, side_b), -1
    if other < 0:
        mine = find_row(rows, node, group, crack, side, -1, 0)
    elif crack < other:
        mine = find_row(rows, node, group, crack, side, other, other_side)
    else:
        mine = find_row(rows, node, group, other, other_side, crack, side)
    if mine < 0:
        mine = find_row(rows, node, group, other, other_side, -1, 0)
    if not beside_tip:
        return mine, -1
    if other < 0:
        facing = find_row(rows, node, group, crack, -side, -1, 0)
    elif crack < other:
        facing = find_row(rows, node, group, crack, -side, other, other_side)
    else:
        facing = find_row(rows, node, group, other, other_side, crack, -side)
    if facing < 0:
        facing = find_row(rows, node, group, other, other_side, -1, 0)
    return mine, facing if facing != mine else -1


class Seen(NamedTuple):
    """What the point of a surface sees: room for two rows of each of the four nodes around it."""

    row: np.ndarray  # (8,)
    weight: np.ndarray  # (8,) what the row counts
    mass: np.ndarray  # (8,) what it is weighed by (kg)


def make_seen() -> Seen:
    """Return room for what a point sees."""
    return Seen(np.zeros(8, dtype=np.int64), np.zeros(8), np.zeros(8))


@kernel
def look_around(
    seen, even, mass, rows, segments, of_crack, crack, side, cut, q, x, cells, width, lower, strides
):
    """Find the rows that a surface sees at x; return their number and the sum of the weights.

    even: rows count by their linear functions, as a stress on a surface wants it, light rows less;
    else by their masses as well
    q: x off the crack, on the side of the surface
    cut: share of the crack at x, as of a particle there (tip_nodes.py)
    """
    rx, ry = (x[0] - lower[0]) / width, (x[1] - lower[1]) / width
    i0 = min(max(int(np.floor(rx)), 0), cells[0] - 1)
    j0 = min(max(int(np.floor(ry)), 0), cells[1] - 1)
    qi = min(max(int(np.floor((q[0] - lower[0]) / width)), 0), cells[0] - 1)
    qj = min(max(int(np.floor((q[1] - lower[1]) / width)), 0), cells[1] - 1)
    cell = qi * strides[0] + qj * strides[1]
    count, heaviest = 0, 0.0
    for j in range(2):
        for i in range(2):
            node = (i0 + i) * strides[0] + (j0 + j) * strides[1]
            nx, ny = lower[0] + width * (i0 + i), lower[1] + width * (j0 + j)
            mine, facing = surface_rows(
                rows,
                segments,
                of_crack,
                crack,
                side,
                node,
                cell,
                q[0],
                q[1],
                nx,
                ny,
                ON_CRACK * width,
            )
            S = max(0.0, 1.0 - abs(rx - i0 - i)) * max(0.0, 1.0 - abs(ry - j0 - j))
            near = mass[mine] if mine >= 0 else 0.0
            far = mass[facing] if facing >= 0 else 0.0
            if near + far <= 0.0:
                continue
            # as a particle there: the share of the side, and of the mean of both sides
            own, felt = cut + (1.0 - cut) * near / (near + far), near + (1.0 - cut) * far
            for row, share in ((mine, own), (facing, 1.0 - own)):
                if row >= 0 and share > 0.0 and mass[row] > 0.0:
                    m = mass[row] if even else felt
                    seen.row[count], seen.weight[count], seen.mass[count] = row, S * share, m
                    heaviest = max(heaviest, m)
                    count += 1
    return count, weigh(seen, count, LIGHT * heaviest if even else inf)


@kernel
def weigh(seen, count, enough):
    """Weigh rows by mass up to what is `enough` (kg); by all of it if that is infinite.

    returns: the sum of the weights
    """
    total = 0.0
    for e in range(count):
        m = seen.mass[e]
        seen.weight[e] *= m if enough == inf else min(m / enough, 1.0)
        total += seen.weight[e]
    return total


@kernel
def surface_motion(
    seen,
    even,
    grid,
    rows,
    segments,
    of_crack,
    crack,
    side,
    cut,
    q,
    x,
    cells,
    width,
    lower,
    strides,
):
    """Return mass seen, velocity and acceleration of one surface at x (look_around)."""
    velocity, acceleration = grid.velocity, grid.acceleration
    who = (rows, segments, of_crack, crack, side, cut)
    place = (q, x, cells, width, lower, strides)
    count, total = look_around(seen, even, grid.mass, *who, *place)
    vx, vy, ax, ay = 0.0, 0.0, 0.0, 0.0
    for e in range(count):
        row, w = seen.row[e], seen.weight[e]
        vx += w * velocity[row, 0]
        vy += w * velocity[row, 1]
        ax += w * acceleration[row, 0]
        ay += w * acceleration[row, 1]
    if total > 0.0:
        return total, vx / total, vy / total, ax / total, ay / total
    return 0.0, 0.0, 0.0, 0.0, 0.0


@kernel
def surface_step(surface, old, k, seen, v, a, width, dt):
    """Move surface point k to second order; return whether it moved, and by how much."""
    if seen <= 0.0:
        old[k, 0] = old[k, 1] = 0.0
        return False, 0.0, 0.0
    dx = dt * (1.5 * v[0] - 0.5 * old[k, 0] - a[0] * dt)
    dy = dt * (1.5 * v[1] - 0.5 * old[k, 1] - a[1] * dt)
    if max(abs(dx), abs(dy)) > LARGEST_STEP * width:
        old[k, 0] = old[k, 1] = 0.0
        return False, 0.0, 0.0
    surface[k, 0] += dx
    surface[k, 1] += dy
    old[k, 0], old[k, 1] = v[0], v[1]
    return True, dx, dy


@kernel
def move_surface(
    seen,
    paths,
    grid,
    rows,
    segments,
    of_crack,
    crack,
    side,
    cut,
    k,
    q,
    cells,
    width,
    lower,
    strides,
    dt,
):
    """Move point k of one surface with the rows of its side; return whether, and by how much."""
    surface = paths.above if side > 0 else paths.below
    old = paths.above_velocity if side > 0 else paths.below_velocity
    x = (surface[k, 0], surface[k, 1])
    who, place = (rows, segments, of_crack, crack, side, cut), (q, x, cells, width, lower, strides)
    mass, vx, vy, ax, ay = surface_motion(seen, paths.law[k] >= 0, grid, *who, *place)
    return surface_step(surface, old, k, mass, (vx, vy), (ax, ay), width, dt)


@kernel
def move_cracks(seen, paths, cut, grid, rows, segments, of_crack, cells, width, lower, strides, dt):
    """Move all surfaces and planes of cracks by one step.

    seen: room for what a point sees
    cut: (points,) share of the crack at each point, below 1 beside smooth tips; of_crack: contact
    group of the bodies that each crack cuts

    A side that sees no solid moves with the other one. A crack on a symmetry plane has a body on
    one side only; the other side is its image, so the plane stays where it is.
    """
    point, above, below = paths.point, paths.above, paths.below
    for c in range(len(paths.start) - 1):
        if paths.fixed[c]:
            continue
        first, last = paths.start[c], paths.start[c + 1] - 1
        axis, body = paths.mirror[c, 0], paths.mirror[c, 1]
        who, place = (grid, rows, segments, of_crack, c), (cells, width, lower, strides, dt)
        for k in range(first, last + 1):
            n = side_normal(point, k, first, last)
            off = OFF_PLANE * width
            up, down = False, False
            ax, ay, bx, by = 0.0, 0.0, 0.0, 0.0
            if axis < 0 or body > 0:
                q = (point[k, 0] + off * n[0], point[k, 1] + off * n[1])
                up, ax, ay = move_surface(seen, paths, *who, 1, cut[k], k, q, *place)
            if axis < 0 or body < 0:
                q = (point[k, 0] - off * n[0], point[k, 1] - off * n[1])
                down, bx, by = move_surface(seen, paths, *who, -1, cut[k], k, q, *place)
            flip_x, flip_y = -1.0 if axis == 0 else 1.0, -1.0 if axis == 1 else 1.0
            if up and not down:
                bx, by = flip_x * ax, flip_y * ay
                below[k, 0] += bx
                below[k, 1] += by
            elif down and not up:
                ax, ay = flip_x * bx, flip_y * by
                above[k, 0] += ax
                above[k, 1] += ay
            point[k, 0] += 0.5 * (ax + bx)
            point[k, 1] += 0.5 * (ay + by)
