"""Does the line from a particle to a node cross a crack, and from which side?

The velocity field of a particle-node pair is found with this test (Nairn 2003). Every tie has one
answer, seen from everywhere: a point on a crack (within 1e-9 cells) lies below it, and a vertex
belongs to one of its two segments. So a crack may run along a grid line, through nodes, through
particles or along a diagonal, and acts as if it lay a hair above them. Lines that cross a crack
twice do not cross it.
"""

import numpy as np

from cramp_cli.cracks.branches import NEAR, add_crossing, reduce_crossed
from cramp_cli.cracks.segments import HAIR, ON_CRACK
from cramp_cli.numerics.kernel import inlined_kernel, kernel


@kernel
def double_area(ax, ay, bx, by, cx, cy):
    """Return twice the signed area of the triangle abc; positive when c is left of a -> b."""
    return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)


@inlined_kernel
def off_crack(segments, cell, x, y, tolerance):
    """Return a point moved a hair below the segment it lies on, if it lies on one."""
    ends, entry = segments.ends, segments.head[cell]
    while entry >= 0:
        s = segments.item[entry]
        dx, dy = ends[s, 2] - ends[s, 0], ends[s, 3] - ends[s, 1]
        cross = abs(dx * (y - ends[s, 1]) - dy * (x - ends[s, 0]))
        if cross > tolerance * (abs(dx) + abs(dy)):  # most points are far from most segments
            entry = segments.next[entry]
            continue
        size = np.sqrt(dx * dx + dy * dy)
        along = ((x - ends[s, 0]) * dx + (y - ends[s, 1]) * dy) / size
        away = cross / size
        if away < tolerance and tolerance < along < size - tolerance:
            hair = HAIR / ON_CRACK * tolerance
            return x + hair * dy / size, y - hair * dx / size
        entry = segments.next[entry]
    return x, y


@inlined_kernel
def off_vertex(ends, down, s, x, y, tolerance):
    """Return a point moved a hair below the crack if it lies on an end of segment `s`."""
    if abs(x - ends[s, 0]) < tolerance and abs(y - ends[s, 1]) < tolerance:
        return x + down[s, 0], y + down[s, 1]
    if abs(x - ends[s, 2]) < tolerance and abs(y - ends[s, 3]) < tolerance:
        return x + down[s, 2], y + down[s, 3]
    return x, y


@inlined_kernel
def crosses(ends, down, s, px, py, nx, ny, tolerance):
    """Return the side of p (+1 above, -1 below) if p -> n crosses segment `s`, else 0.

    tolerance: distance within which a point lies on the segment's line (m)
    """
    ax, ay, bx, by = ends[s, 0], ends[s, 1], ends[s, 2], ends[s, 3]
    limit = tolerance * (abs(bx - ax) + abs(by - ay))
    p_area, n_area = double_area(ax, ay, bx, by, px, py), double_area(ax, ay, bx, by, nx, ny)
    if min(abs(p_area), abs(n_area)) <= limit:  # only then can one of them lie on a vertex
        px, py = off_vertex(ends, down, s, px, py, tolerance)
        nx, ny = off_vertex(ends, down, s, nx, ny, tolerance)
        p_area, n_area = double_area(ax, ay, bx, by, px, py), double_area(ax, ay, bx, by, nx, ny)
    p_above, n_above = p_area > limit, n_area > limit
    if p_above == n_above:
        return 0
    a_left = double_area(nx, ny, px, py, ax, ay) >= 0.0
    b_left = double_area(nx, ny, px, py, bx, by) >= 0.0
    if a_left == b_left:
        return 0
    return 1 if p_above else -1


@inlined_kernel
def box_around(px, py, nx, ny, more):
    """Return lower and upper corner of the line p -> n, a little `more` on all sides."""
    low, high = (min(px, nx) - more, min(py, ny) - more), (max(px, nx) + more, max(py, ny) + more)
    return low, high


@inlined_kernel
def reaches(ends, s, box):
    """Return whether a segment may reach into a box."""
    ax, ay, bx, by = ends[s, 0], ends[s, 1], ends[s, 2], ends[s, 3]
    (x0, y0), (x1, y1) = box
    across = max(ax, bx) >= x0 and min(ax, bx) <= x1
    return across and max(ay, by) >= y0 and min(ay, by) <= y1


@inlined_kernel
def hidden_nodes(segments, cell, x, y, first_node, width, side, tolerance):
    """Return which nodes of a particle a segment hides from it, and which want a closer look.

    Bit k is that of node k; `segments.across[k]` is the segment that hides it, with the particle
    above it, or ~segment with the particle below. A closer look (`crossed_cracks`) is wanted where
    particle, node and end of a segment are about in line, a node all but lies on a segment, or
    several segments are crossed.

    first_node: place of the lowest of its side x side nodes (m)
    """
    ends, entry = segments.ends, segments.head[cell]
    hair, (nx, ny), reach = 2.0 * HAIR / ON_CRACK * tolerance, first_node, (side - 1) * width
    box = box_around(nx, ny, nx + reach, ny + reach, 2.0 * hair)
    found = (0, 0, 0)
    while entry >= 0:
        s = segments.item[entry]
        entry = segments.next[entry]
        if not reaches(ends, s, box):
            continue
        dx, dy = abs(ends[s, 2] - ends[s, 0]), abs(ends[s, 3] - ends[s, 1])
        near, on = hair * (dx + dy), 0.5 * tolerance * max(dx, dy)
        here = double_area(ends[s, 0], ends[s, 1], ends[s, 2], ends[s, 3], x, y)
        if abs(here) <= near:
            return 0, (1 << (side * side)) - 1
        how_near = (near, on, 2.0 * hair * reach)
        found = hide_behind(segments, s, here > 0.0, x, y, first_node, width, side, how_near, found)
    return found[0], found[1]


@inlined_kernel
def hide_behind(segments, s, above, x, y, first_node, width, side, how_near, found):
    """Add the nodes that segment `s` hides to those found: hidden, unsure, lying on a segment.

    A node on a segment lies below it. All areas are linear in the place of the node.

    above: whether the particle is
    how_near: twice the areas within which a node is near the line of the segment or on it, and an
    end near the way from particle to node (m^2)
    """
    ends, (near, on, in_line), (nx, ny) = segments.ends, how_near, first_node
    hidden, unsure, lying = found
    ax, ay, bx, by = ends[s, 0], ends[s, 1], ends[s, 2], ends[s, 3]
    sign = 1.0 if above else -1.0
    node = sign * double_area(ax, ay, bx, by, nx, ny)  # negative for a node across
    right, up = -sign * (by - ay) * width, sign * (bx - ax) * width
    if node + (side - 1) * (min(right, 0.0) + min(up, 0.0)) > near:  # of most segments
        return found
    a, b = double_area(nx, ny, x, y, ax, ay), double_area(nx, ny, x, y, bx, by)
    a_right, a_up = (y - ay) * width, (ax - x) * width
    b_right, b_up = (y - by) * width, (bx - x) * width
    for j in range(side):
        for i in range(side):
            to_node = node + i * right + j * up
            to_a, to_b = a + i * a_right + j * a_up, b + i * b_right + j * b_up
            beside = min(to_a, to_b) > in_line or max(to_a, to_b) < -in_line
            if to_node > near or beside:
                continue
            bit, lies = 1 << (i + j * side), abs(to_node) < on
            if min(abs(to_a), abs(to_b)) <= in_line or (to_node >= -near and not lies):
                unsure |= bit
                continue
            unsure |= (lying if lies else 0) & bit
            lying |= bit if lies else 0
            if above or not lies:
                unsure |= hidden & bit
                hidden |= bit
                segments.across[i + j * side] = s if above else ~s
    return hidden, unsure, lying


@inlined_kernel
def crossed_once(segments, k):
    """Return what `crossed_cracks` would for node `k`, which a single segment hides."""
    across = segments.across[k]
    s = max(across, ~across)
    return segments.branch[s], (1 if across >= 0 else -1) * segments.turn[s], s, -1, 0, -1, 0


@inlined_kernel
def crossed_cracks(segments, cell, px, py, nx, ny, tolerance):
    """Return the first two branches of cracks that the line p -> n crosses.

    returns: a, side_a, segment_a, b, side_b, segment_b, more

    cell: lowest node of the cell of p; branches are -1 where there is none; `more` counts further
    branches
    """
    found = segments.found
    count = _find_crossed(segments, cell, px, py, nx, ny, tolerance)
    if count > 1 and segments.used[3] > 0:
        count = reduce_crossed(segments, count, nx, ny, NEAR / ON_CRACK * tolerance)
    a, side_a, seg_a = -1, 0, -1
    b, side_b, seg_b = -1, 0, -1
    if count > 0:
        a, side_a, seg_a = found[0, 0], found[0, 1], found[0, 2]
    if count > 1:
        b, side_b, seg_b = found[1, 0], found[1, 1], found[1, 2]
    return a, side_a, seg_a, b, side_b, seg_b, max(count - 2, 0)


@kernel
def _find_crossed(segments, cell, px, py, nx, ny, tolerance):
    """Note which branches a line crosses in the end: branch, side of p, a segment; return how many.

    Crossings of a branch alternate along the line: their sum is the side of p, or 0.
    """
    item, following, found = segments.item, segments.next, segments.found
    box = box_around(px, py, nx, ny, 4.0 * HAIR / ON_CRACK * tolerance)
    entry, count = segments.head[cell], 0
    while entry >= 0:
        s, hit = item[entry], 0
        entry = following[entry]
        if reaches(segments.ends, s, box):  # most segments about a cell do not
            hit = crosses(segments.ends, segments.down, s, px, py, nx, ny, tolerance)
        if hit == 0:
            continue
        hit *= segments.turn[s]
        known = False
        for i in range(count):
            if found[i, 0] == segments.branch[s]:
                known = True
                found[i, 1] += hit
                if hit * found[i, 1] > 0:
                    found[i, 2] = s
        if not known:
            count = add_crossing(found, count, segments.branch[s], hit, s)
    kept = 0
    for i in range(count):
        if found[i, 1] % 2 != 0:
            found[kept, 0], found[kept, 2] = found[i, 0], found[i, 2]
            found[kept, 1] = 1 if found[i, 1] > 0 else -1
            kept += 1
    return kept
