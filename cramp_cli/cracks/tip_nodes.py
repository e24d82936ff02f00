"""Nodes beside a tip are part cut, part whole, so that a tip is felt at any place within its cell.

With the line test alone a node falls from whole to cut at once when the tip passes it: the crack acts
as if it were up to a third of a cell longer than it is, by an amount that jumps from node to node and
with the height of the crack in its cell. Here the cut share of a node rises from 0 to 1 while the tip
passes it. A particle gives that share of its weight to the row of its side, the rest to the row that
both sides share: the grid is a blend of one in which the node is cut and one in which it is whole.
Sums, momentum and energy are those of both grids together, and both faces are treated alike.
"""

from math import inf, sqrt

import numpy as np

from cramp_cli.cracks.crossing import ON_CRACK, double_area
from cramp_cli.numerics.kernel import kernel
from cramp_cli.state.paths import EDGE

REACH = 4  # cells around a tip whose nodes are looked at
LATERAL = 2.0  # cells from the line of the crack beyond which no particle sees both sides of a node
EXTENSION = 3.0  # cells by which a tip is carried on to tell the sides ahead of it


@kernel
def along_crack(point, first, last, tip, nx, ny):
    """Return where a node lies from a tip: distance ahead along the crack, and from it (m); segment.

    Behind the tip the distance is negative and counts along the crack. first, last: points of the
    crack; tip: the one of both that is the tip. The segment is counted from the first.
    """
    step = 1 if tip == first else -1
    ahead, nearest, segment = 0.0, inf, 0
    travelled = 0.0
    k = tip
    while k != (last if tip == first else first):
        ax, ay, bx, by = point[k, 0], point[k, 1], point[k + step, 0], point[k + step, 1]
        dx, dy = bx - ax, by - ay
        size = sqrt(dx * dx + dy * dy)
        t = ((nx - ax) * dx + (ny - ay) * dy) / (size * size)
        t = min(t, 1.0) if k == tip else min(max(t, 0.0), 1.0)
        away = sqrt((nx - ax - t * dx) ** 2 + (ny - ay - t * dy) ** 2)
        if away < nearest:
            nearest, ahead = away, -(travelled + t * size)
            segment = (k if step == 1 else k - 1) - first
        travelled += size
        k += step
    return ahead, nearest, segment


@kernel
def forget_tips(rows):
    """Make all nodes plain again."""
    for i in range(rows.count[4]):
        rows.tip_crack[rows.tipped[i]] = -1
    rows.count[4] = 0


@kernel
def mark_tip_nodes(rows, paths, segments, cells, width, lower, strides, centre, ramp):
    """Find the cut share of the nodes around every tip.

    centre: where ahead of the tip a node is half cut (cells); ramp: cells from whole to cut
    """
    forget_tips(rows)
    point, start, ends = paths.point, paths.start, paths.ends
    for c in range(len(start) - 1):
        first, last = start[c], start[c + 1] - 1
        for end in range(2):
            if ends[c, end] == EDGE:
                continue
            tip = first if end == 0 else last
            i = int(np.floor((point[tip, 0] - lower[0]) / width))
            j = int(np.floor((point[tip, 1] - lower[1]) / width))
            for jj in range(max(j - REACH, 0), min(j + REACH + 1, cells[1]) + 1):
                for ii in range(max(i - REACH, 0), min(i + REACH + 1, cells[0]) + 1):
                    nx, ny = lower[0] + ii * width, lower[1] + jj * width
                    ahead, away, segment = along_crack(point, first, last, tip, nx, ny)
                    cut = min(max(0.5 - (ahead / width - centre) / ramp, 0.0), 1.0)
                    if cut < 1.0 and away < LATERAL * width:
                        node = ii * strides[0] + jj * strides[1]
                        _mark(rows, segments, node, c, first - c + segment, cut, nx, ny, width)


@kernel
def _mark(rows, segments, node, crack, segment, cut, nx, ny, width):
    if rows.tip_crack[node] >= 0:
        if cut >= rows.cut[node]:
            return
    else:
        rows.tipped[rows.count[4]] = node
        rows.count[4] += 1
    ends = segments.ends
    ax, ay, bx, by = ends[segment, 0], ends[segment, 1], ends[segment, 2], ends[segment, 3]
    limit = ON_CRACK * width * (abs(bx - ax) + abs(by - ay))
    above = double_area(ax, ay, bx, by, nx, ny) > limit
    rows.tip_crack[node], rows.tip_segment[node], rows.cut[node] = crack, segment, cut
    rows.tip_side[node] = 1 if above else -1
