"""The segments of all cracks, laid out anew in every step, and the cells in which they lie."""

from typing import NamedTuple

import numpy as np

from cramp_cli.cracks.branches import number_branches
from cramp_cli.numerics.kernel import kernel
from cramp_cli.state.paths import EDGE, TIP

ON_CRACK = 1e-9  # a point closer to a crack than this (cells) lies on it
HAIR = 1e-6  # a point on a vertex is taken to lie this far below it (cells)
MOST_NODES = 64  # that a particle may see in the plane
MOST_CROSSED = 16  # branches that a line from a particle to a node is known to cross
EXTENSION = 4.0  # an edge end is carried on by this many segment lengths


class Segments(NamedTuple):
    """Segments of all cracks, edge ends carried on into free space, and the cells they touch."""

    ends: np.ndarray  # (segments, 4) x, y of both ends (m), tips carried on
    real: np.ndarray  # (segments, 4) the same with tips where they are
    down: np.ndarray  # (segments, 4) a hair below both ends, the same for neighbours (m)
    crack: np.ndarray  # (segments,) crack of each segment, ascending
    branch: np.ndarray  # (segments,) branch of each segment: branches.py
    turn: np.ndarray  # (segments,) -1 where the branch runs against the crack, else 1
    joint: np.ndarray  # (segments, 2) junction at both ends, -1 for none
    arms: np.ndarray  # (2 * segments,) 2 * segment + end of the arms of all junctions, by junction
    first_arm: np.ndarray  # (2 * segments + 1,) the first of each junction
    of_end: np.ndarray  # (2 * segments,) branch at the ends of all cracks: 2 * crack + end
    head: np.ndarray  # (nodes,) first entry of the list of a cell (by its lowest node), or -1
    item: np.ndarray  # (entries,) segment of an entry
    next: np.ndarray  # (entries,) next entry of the same cell, or -1; segments ascend
    zone: np.ndarray  # (nodes,) 1 for cells whose particles may see a node with several rows
    used: np.ndarray  # (4,) segments, entries in use, entries wanted, junctions
    across: np.ndarray  # (64,) room for what hides the nodes of a particle: crossing.py
    found: np.ndarray  # (16, 3) room for the branches that a line crosses: crossing.py


def make_segments(node_count: int, segment_count: int, entries: int) -> Segments:
    """Return empty lists."""
    return Segments(
        ends=np.zeros((segment_count, 4)),
        real=np.zeros((segment_count, 4)),
        down=np.zeros((segment_count, 4)),
        crack=np.zeros(segment_count, dtype=np.int64),
        branch=np.zeros(segment_count, dtype=np.int64),
        turn=np.ones(segment_count, dtype=np.int64),
        joint=np.full((segment_count, 2), -1, dtype=np.int64),
        arms=np.zeros(2 * segment_count, dtype=np.int64),
        first_arm=np.zeros(2 * segment_count + 1, dtype=np.int64),
        of_end=np.zeros(2 * segment_count, dtype=np.int64),
        head=np.full(node_count, -1, dtype=np.int64),
        item=np.zeros(entries, dtype=np.int64),
        next=np.zeros(entries, dtype=np.int64),
        zone=np.zeros(node_count, dtype=np.uint8),
        used=np.zeros(4, dtype=np.int64),
        across=np.zeros(MOST_NODES, dtype=np.int64),
        found=np.zeros((MOST_CROSSED, 3), dtype=np.int64),
    )


@kernel
def find_down(down, s, point, k, first, last, hair):
    """Set the hair below both ends of segment k -> k+1, across the mean of segments that meet."""
    for end in range(2):
        i, j = max(k + end - 1, first), min(k + end + 1, last)
        dx, dy = unit_sum(point, i, k + end, j)
        down[s, 2 * end], down[s, 2 * end + 1] = hair * dy, -hair * dx


@kernel
def unit_sum(point, i, at, j):
    """Return the sum of the directions i -> at and at -> j; one of them where they are the same."""
    total = (0.0, 0.0)
    for a, b in ((i, at), (at, j)):
        dx, dy = point[b, 0] - point[a, 0], point[b, 1] - point[a, 1]
        size = np.hypot(dx, dy)
        if size > 0.0:
            total = (total[0] + dx / size, total[1] + dy / size)
    return total


@kernel
def lay_out_segments(segments, paths, beyond_tip, hair):
    """Copy the segments of all cracks; edges go on, tips by `beyond_tip` (m, one per crack)."""
    point, start, kinds = paths.point, paths.start, paths.ends
    n = 0
    for c in range(len(start) - 1):
        last = start[c + 1] - 2
        for k in range(start[c], last + 1):
            dx, dy = point[k + 1, 0] - point[k, 0], point[k + 1, 1] - point[k, 1]
            size = np.sqrt(dx * dx + dy * dy)
            for end in range(2):
                at = k + end
                outermost = (end == 0 and k == start[c]) or (end == 1 and k == last)
                edge = outermost and kinds[c, end] == EDGE
                on = EXTENSION if edge else 0.0
                on_tip = on
                if outermost and kinds[c, end] == TIP:
                    on_tip = beyond_tip[c] / size
                elif outermost and not edge and paths.joint[at] < 0:
                    on_tip = 4.0 * hair / size  # ends of cracks that meet in a point must meet
                sign = 2 * end - 1
                segments.real[n, 2 * end] = point[at, 0] + sign * on * dx
                segments.real[n, 2 * end + 1] = point[at, 1] + sign * on * dy
                segments.ends[n, 2 * end] = point[at, 0] + sign * on_tip * dx
                segments.ends[n, 2 * end + 1] = point[at, 1] + sign * on_tip * dy
            segments.crack[n] = c
            find_down(segments.down, n, point, k, start[c], start[c + 1] - 1, hair)
            n += 1
    return n


@kernel
def cell_range(a, b, lower, width, cells, grown):
    """Return first and last cell of an axis between two coordinates, grown and clipped."""
    # A segment on a grid line belongs to the cells on both sides of it.
    first = int(np.floor((min(a, b) - lower) / width - HAIR)) - grown
    last = int(np.floor((max(a, b) - lower) / width + HAIR)) + grown
    return max(first, 0), min(last, cells - 1)


@kernel
def list_segments(segments, paths, cells, width, lower, strides, growth, zone_growth, beyond_tip):
    """Fill the lists of segments per cell; return False if they do not fit.

    `used[2]` says how many there are.

    A particle tests the segments within `growth` cells of its own; nodes with several rows can be
    seen from cells within `zone_growth`.
    """
    head, item, following, zone = segments.head, segments.item, segments.next, segments.zone
    head[:] = -1
    zone[:] = 0
    count = lay_out_segments(segments, paths, beyond_tip, HAIR * width)
    number_branches(segments, paths, count, HAIR * width)
    line = segments.ends
    entries = 0
    for s in range(count - 1, -1, -1):  # pushed to the front, so that lists ascend
        for grown in (growth, zone_growth):
            i0, i1 = cell_range(line[s, 0], line[s, 2], lower[0], width, cells[0], grown)
            j0, j1 = cell_range(line[s, 1], line[s, 3], lower[1], width, cells[1], grown)
            for j in range(j0, j1 + 1):
                for i in range(i0, i1 + 1):
                    cell = i * strides[0] + j * strides[1]
                    if grown != growth:
                        zone[cell] = 1
                        continue
                    if entries < len(item):
                        item[entries] = s
                        following[entries] = head[cell]
                        head[cell] = entries
                    entries += 1
    segments.used[0], segments.used[1], segments.used[2] = count, min(entries, len(item)), entries
    return entries <= len(item)
