"""Cracks move with the solid: each surface with the rows of its side, the plane with their mean."""

import numpy as np

from cramp_cli.cracks.crossing import ON_CRACK, crossed_cracks
from cramp_cli.cracks.rows import find_row
from cramp_cli.numerics.kernel import kernel

OFF_PLANE = 1e-4  # a surface looks at the nodes from this distance off the plane (cells)
LARGEST_STEP = 0.5  # a surface that would move further in one step (cells) stays


@kernel
def side_normal(point, k, first, last):
    """Return the unit normal at crack point k that points above."""
    i, j = max(k - 1, first), min(k + 1, last)
    dx, dy = point[j, 0] - point[i, 0], point[j, 1] - point[i, 1]
    size = np.sqrt(dx * dx + dy * dy)
    return (-dy / size, dx / size) if size > 0.0 else (0.0, 0.0)


@kernel
def surface_rows(rows, segments, crack, side, node, cell, qx, qy, nx, ny, tolerance):
    """Return the rows of a node for one side of a crack at the point q, and for the other, or -1.

    Where rows of the node are told by this crack they decide: the row of the side, else the one
    without the crack. Without such rows the line from q to the node does. The other side counts
    beside a tip only.
    """
    a, side_a, _, b, side_b, _, _ = crossed_cracks(segments, cell, qx, qy, nx, ny, tolerance)
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
        return find_row(rows, node, a, side_a, b, side_b), -1
    if other < 0:
        mine = find_row(rows, node, crack, side, -1, 0)
    elif crack < other:
        mine = find_row(rows, node, crack, side, other, other_side)
    else:
        mine = find_row(rows, node, other, other_side, crack, side)
    if mine < 0:
        mine = find_row(rows, node, other, other_side, -1, 0)
    if not beside_tip:
        return mine, -1
    if other < 0:
        facing = find_row(rows, node, crack, -side, -1, 0)
    elif crack < other:
        facing = find_row(rows, node, crack, -side, other, other_side)
    else:
        facing = find_row(rows, node, other, other_side, crack, -side)
    if facing < 0:
        facing = find_row(rows, node, other, other_side, -1, 0)
    return mine, facing if facing != mine else -1


@kernel
def surface_motion(grid, rows, segments, crack, side, cut, q, x, cells, width, lower, strides):
    """Return mass seen, velocity and acceleration of one surface at x (linear functions).

    cut: share of the crack at x, as of a particle there (tip_nodes.py)
    """
    mass, velocity, acceleration = grid.mass, grid.velocity, grid.acceleration
    rx, ry = (x[0] - lower[0]) / width, (x[1] - lower[1]) / width
    i0 = min(max(int(np.floor(rx)), 0), cells[0] - 1)
    j0 = min(max(int(np.floor(ry)), 0), cells[1] - 1)
    qi = min(max(int(np.floor((q[0] - lower[0]) / width)), 0), cells[0] - 1)
    qj = min(max(int(np.floor((q[1] - lower[1]) / width)), 0), cells[1] - 1)
    cell = qi * strides[0] + qj * strides[1]
    total, vx, vy, ax, ay = 0.0, 0.0, 0.0, 0.0, 0.0
    for j in range(2):
        for i in range(2):
            node = (i0 + i) * strides[0] + (j0 + j) * strides[1]
            nx, ny = lower[0] + width * (i0 + i), lower[1] + width * (j0 + j)
            mine, facing = surface_rows(
                rows, segments, crack, side, node, cell, q[0], q[1], nx, ny, ON_CRACK * width
            )
            S = max(0.0, 1.0 - abs(rx - i0 - i)) * max(0.0, 1.0 - abs(ry - j0 - j))
            near = mass[mine] if mine >= 0 else 0.0
            far = mass[facing] if facing >= 0 else 0.0
            if near + far <= 0.0:
                continue
            # as a particle there: the share of the side, and of the mean of both sides
            part, both = near / (near + far), S * (near + (1.0 - cut) * far)
            shares = (cut + (1.0 - cut) * part, (1.0 - cut) * (1.0 - part))
            for row, share in zip((mine, facing), shares):  # noqa: B905 - numba knows no strict
                if row < 0 or share == 0.0:
                    continue
                w = both * share
                total += w
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
    paths, grid, rows, segments, crack, side, cut, k, q, cells, width, lower, strides, dt
):
    """Move point k of one surface with the rows of its side; return whether, and by how much."""
    surface = paths.above if side > 0 else paths.below
    old = paths.above_velocity if side > 0 else paths.below_velocity
    x = (surface[k, 0], surface[k, 1])
    seen, vx, vy, ax, ay = surface_motion(
        grid, rows, segments, crack, side, cut, q, x, cells, width, lower, strides
    )
    return surface_step(surface, old, k, seen, (vx, vy), (ax, ay), width, dt)


@kernel
def move_cracks(paths, cut, grid, rows, segments, cells, width, lower, strides, dt):
    """Move all surfaces and planes of cracks by one step.

    cut: (points,) share of the crack at each point, below 1 beside smooth tips

    A side that sees no solid moves with the other one. A crack on a symmetry plane has a body on
    one side only; the other side is its image, so the plane stays where it is.
    """
    point, above, below = paths.point, paths.above, paths.below
    for c in range(len(paths.start) - 1):
        if paths.fixed[c]:
            continue
        first, last = paths.start[c], paths.start[c + 1] - 1
        axis, body = paths.mirror[c, 0], paths.mirror[c, 1]
        for k in range(first, last + 1):
            n = side_normal(point, k, first, last)
            off = OFF_PLANE * width
            up, down = False, False
            ax, ay, bx, by = 0.0, 0.0, 0.0, 0.0
            if axis < 0 or body > 0:
                q = (point[k, 0] + off * n[0], point[k, 1] + off * n[1])
                up, ax, ay = move_surface(
                    paths,
                    grid,
                    rows,
                    segments,
                    c,
                    1,
                    cut[k],
                    k,
                    q,
                    cells,
                    width,
                    lower,
                    strides,
                    dt,
                )
            if axis < 0 or body < 0:
                q = (point[k, 0] - off * n[0], point[k, 1] - off * n[1])
                down, bx, by = move_surface(
                    paths,
                    grid,
                    rows,
                    segments,
                    c,
                    -1,
                    cut[k],
                    k,
                    q,
                    cells,
                    width,
                    lower,
                    strides,
                    dt,
                )
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
