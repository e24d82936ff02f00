"""Cracks move with the solid: each surface with the rows of its side, the plane with their mean."""

from cramp_cli.cracks.carry import carried
from cramp_cli.cracks.view import look_from, side_normal
from cramp_cli.numerics.kernel import inlined_kernel, kernel

LARGEST_STEP = 0.5  # a surface that would move further in one step (cells) stays


@inlined_kernel
def surface_step(surface, old, k, v, a, width, dt):
    """Move surface point k to second order; return whether it moved, and by how much."""
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
def move_surface(seen, paths, k, crack, side, normal, cut, grid, solid, place, dt):
    """Move point k of one surface with the rows of its side; return whether, and by how much."""
    surface = paths.above if side > 0 else paths.below
    old = paths.above_velocity if side > 0 else paths.below_velocity
    even = paths.law[k] >= 0
    count, total = look_from(
        seen, even, paths, k, crack, side, normal, cut, grid.mass, solid, place
    )
    if total <= 0.0:
        old[k, 0] = old[k, 1] = 0.0
        return False, 0.0, 0.0
    v, a = carried(seen, count, grid.velocity), carried(seen, count, grid.acceleration)
    return surface_step(surface, old, k, v, a, place[1], dt)


@kernel
def move_cracks(seen, paths, cut, grid, solid, place, dt):
    """Move all surfaces and planes of cracks by one step.

    seen: room for what a point sees; solid, place: as in `look_from`
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
            up, down = False, False
            ax, ay, bx, by = 0.0, 0.0, 0.0, 0.0
            if axis < 0 or body > 0:
                up, ax, ay = move_surface(seen, paths, k, c, 1, n, cut[k], grid, solid, place, dt)
            if axis < 0 or body < 0:
                down, bx, by = move_surface(
                    seen, paths, k, c, -1, n, cut[k], grid, solid, place, dt
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
    hold_joints(paths, solid[1])


@kernel
def hold_joints(paths, segments):
    """Keep the arms of every junction together: their ends move by the mean of all.

    The plane alone; surfaces go with their own sectors. A crack that is fixed holds its junctions.
    """
    point, crack, arms = paths.point, segments.crack, segments.arms
    for j in range(segments.used[3]):
        first, last = segments.first_arm[j], segments.first_arm[j + 1]
        x, y, share = 0.0, 0.0, 1.0 / (last - first)
        for i in range(first, last):
            s = arms[i] // 2
            k = s + crack[s] + arms[i] % 2
            x, y = x + share * point[k, 0], y + share * point[k, 1]
        for i in range(first, last):
            s = arms[i] // 2
            k = s + crack[s] + arms[i] % 2
            if paths.fixed[crack[s]]:
                x, y = point[k, 0], point[k, 1]
        for i in range(first, last):
            s = arms[i] // 2
            k = s + crack[s] + arms[i] % 2
            point[k, 0], point[k, 1] = x, y
