"""Particles beside a tip are part cut, so that a tip is felt at any place within its cell.

With the line test alone a pair of particle and node falls from whole to cut at once when the tip
passes it: the jump across the crack ends abruptly somewhere around the tip, up to a third of a cell
ahead of it, by an amount that changes from node to node and with the height of the crack in its
cell. Here the cut share q of a particle rises from 0 at the tip to 1 some way behind it. The jump
of the velocity is q times the difference of the two sides of a node: it vanishes at the tip, and
its gradient holds that of q. What is whole moves with the mean of both sides (tip_shares.py).
"""

from math import inf, sqrt

import numpy as np

from cramp_cli.cracks.crossing import double_area
from cramp_cli.cracks.segments import ON_CRACK
from cramp_cli.numerics.kernel import inlined_kernel, kernel
from cramp_cli.state.paths import TIP

REACH = 5  # cells around a tip whose nodes are looked at
FAR = 10.0  # cells along a crack that belong to a tip; all nodes that are looked at are nearer
BEHIND = 3.0  # cells behind a tip within which a node may see a particle that is part cut
# cells from the line of the crack beyond which no particle sees both sides of a node; a little more
# than 2, or nodes of a crack on a grid line would be marked on one side and not on the other
LATERAL = 2.001
LEAST = 1e-3  # a smaller cut or whole share is none: a row must not hold next to nothing
EXTENSION = 3.0  # cells by which a tip is carried on to tell the sides ahead of it
TIE = 1e-9  # a segment must be nearer by this share than one that is nearer to the tip


@kernel
def along_crack(point, first, last, tip, x, y, far):
    """Return where a place lies from a tip: distance ahead along the crack and from it (m).

    Only that part of the crack counts that is less than `far` (m) from the tip, along the crack.

    Behind the tip the first distance is negative and counts along the crack. Further: the segment
    that is nearest, counted from the first, and its unit vector towards the tip. Places around the
    outside of a corner are as near to either of its segments: they belong to that towards the tip,
    or round-off would choose.

    first, last: points of the crack; tip: the one of both that is the tip
    """
    step = 1 if tip == first else -1
    ahead, nearest, segment, ex, ey = 0.0, inf, 0, 0.0, 0.0
    travelled = 0.0
    k = tip
    while k != (last if tip == first else first) and travelled < far:
        ax, ay, bx, by = point[k, 0], point[k, 1], point[k + step, 0], point[k + step, 1]
        dx, dy = bx - ax, by - ay
        size = sqrt(dx * dx + dy * dy)
        t = ((x - ax) * dx + (y - ay) * dy) / (size * size)
        t = min(t, 1.0) if k == tip else min(max(t, 0.0), 1.0)
        away = sqrt((x - ax - t * dx) ** 2 + (y - ay - t * dy) ** 2)
        if away < (1.0 - TIE) * nearest:
            nearest, ahead = away, -(travelled + t * size)
            segment = (k if step == 1 else k - 1) - first
            ex, ey = -dx / size, -dy / size
        travelled += size
        k += step
    return ahead, nearest, segment, ex, ey


@kernel
def rise(x, ramp):
    """Return the cut share of a point x behind the start of the ramp, and its integral to there."""
    if x <= 0.0:
        return 0.0, 0.0
    if x >= ramp:
        return 1.0, x - 0.5 * ramp
    return x / ramp, 0.5 * x * x / ramp


@inlined_kernel
def mean_half(half):
    """Return the mean half size of a particle (cells): a crack begins so far behind its front."""
    return 0.5 * (half[0] + half[1])


@kernel
def cut_share(paths, tip, x, y, half, width, tip_nodes):
    """Return the cut share of a particle at (x, y) and its gradient (per cell).

    Both are averages over the particle, as in GIMP: a particle that the ramp only grazes must not
    feel the whole gradient, or the stress ahead of the tip would be released.

    tip: 2 * crack + end; half: half size of the particle along each axis (cells)
    tip_nodes: of TipNodes
    """
    front, ramp = tip_nodes
    crack = tip // 2
    first, last = paths.start[crack], paths.start[crack + 1] - 1
    at = first if tip % 2 == 0 else last
    ahead, _, _, ex, ey = along_crack(paths.point, first, last, at, x, y, FAR * width)
    reach = abs(ex) * half[0] + abs(ey) * half[1]
    behind = front - mean_half(half) - ahead / width
    if behind - reach >= ramp:
        return 1.0, 0.0, 0.0
    low, low_sum = rise(behind - reach, ramp)
    high, high_sum = rise(behind + reach, ramp)
    cut, slope = 0.5 * (high_sum - low_sum) / reach, -0.5 * (high - low) / reach
    if cut < LEAST:
        return 0.0, 0.0, 0.0
    if cut > 1.0 - LEAST:
        return 1.0, 0.0, 0.0
    return cut, slope * ex, slope * ey


@kernel
def cut_along_cracks(cut, paths, smooth, at_tips, width, front, ramp):
    """Set the cut share (points,) of all points of all cracks: 1 but beside smooth tips.

    at_tips: of Scratch; a point is cut as the centre of a particle of that size
    """
    point, start = paths.point, paths.start
    cut[:] = 1.0
    for tip in range(2 * (len(start) - 1)):
        c, end = tip // 2, tip % 2
        if paths.ends[c, end] != TIP or not smooth[c]:
            continue
        k, step = (start[c], 1) if end == 0 else (start[c + 1] - 1, -1)
        behind = (front - at_tips[tip, 1]) * width
        while start[c] <= k < start[c + 1] and behind < ramp * width:
            cut[k] = min(cut[k], behind / (ramp * width))
            if start[c] <= k + step < start[c + 1]:
                dx, dy = point[k + step, 0] - point[k, 0], point[k + step, 1] - point[k, 1]
                behind += sqrt(dx * dx + dy * dy)
            k += step


@kernel
def forget_tips(rows):
    """Make all nodes plain again."""
    for i in range(rows.count[4]):
        rows.tip[rows.tipped[i]] = -1
    rows.count[4] = 0


@kernel
def mark_tip_nodes(rows, paths, segments, smooth, cells, width, lower, strides):
    """Find the nodes around every tip; a node between two tips belongs to the nearer one.

    smooth: (cracks,) whether the tips of a crack are
    """
    forget_tips(rows)
    point, start, ends = paths.point, paths.start, paths.ends
    for tip in range(2 * (len(start) - 1)):
        c, end = tip // 2, tip % 2
        if ends[c, end] != TIP or not smooth[c]:
            continue
        first, last = start[c], start[c + 1] - 1
        at = first if end == 0 else last
        i = int(np.floor((point[at, 0] - lower[0]) / width))
        j = int(np.floor((point[at, 1] - lower[1]) / width))
        for jj in range(max(j - REACH, 0), min(j + REACH + 1, cells[1]) + 1):
            for ii in range(max(i - REACH, 0), min(i + REACH + 1, cells[0]) + 1):
                x, y = lower[0] + ii * width, lower[1] + jj * width
                ahead, away, segment, _, _ = along_crack(point, first, last, at, x, y, FAR * width)
                if ahead > -BEHIND * width and away < LATERAL * width:
                    node = ii * strides[0] + jj * strides[1]
                    other = rows.tip[node]
                    if other < 0 or abs(ahead) < _distance_ahead(paths, other, x, y, width):
                        _mark(rows, segments, node, tip, first - c + segment, x, y, width)


@kernel
def _distance_ahead(paths, tip, x, y, width):
    crack = tip // 2
    first, last = paths.start[crack], paths.start[crack + 1] - 1
    at = first if tip % 2 == 0 else last
    return abs(along_crack(paths.point, first, last, at, x, y, FAR * width)[0])


@kernel
def _mark(rows, segments, node, tip, segment, x, y, width):
    if rows.tip[node] < 0:
        rows.tipped[rows.count[4]] = node
        rows.count[4] += 1
    ends = segments.ends
    ax, ay, bx, by = ends[segment, 0], ends[segment, 1], ends[segment, 2], ends[segment, 3]
    limit = ON_CRACK * width * (abs(bx - ax) + abs(by - ay))
    above = double_area(ax, ay, bx, by, x, y) > limit
    rows.tip[node], rows.tip_segment[node] = tip, segment
    rows.tip_branch[node], rows.tip_turn[node] = segments.branch[segment], segments.turn[segment]
    rows.tip_seen[node, :] = rows.tip_cut[node, :] = 0.0
    rows.tip_split[node] = False
    rows.tip_side[node] = 1 if above else -1
