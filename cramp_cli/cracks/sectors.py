"""Sectors around a junction that touch across an arm which no line to their node has crossed.

Contact finds partners among the rows of a node by their labels: those that differ by one branch.
Beside a junction two sectors may lie side by side although their labels differ by more: of three
arms the node sees one sector across the first and one across the second; the third lies between
them, and all three arms together are crossed by nothing (branches.py).
"""

from cramp_cli.cracks.branches import NEAR, add_crossing, reduce_crossed
from cramp_cli.numerics.kernel import inlined_kernel, kernel


@kernel
def pair_sectors(rows, segments, width, lower, strides):
    """List the pairs of rows of a node that one branch parts, by a way round a junction."""
    rows.count[5] = 0
    if segments.used[3] == 0:
        return
    for i in range(rows.count[1]):
        node = rows.shared[i]
        x, y = lower[0] + node % strides[1] * width, lower[1] + node // strides[1] * width
        a = node
        while a >= 0:
            b = row_after(rows, a)
            while b >= 0:
                _pair(rows, segments, a, b, x, y, width)
                b = row_after(rows, b)
            a = row_after(rows, a)


@inlined_kernel
def row_after(rows, row):
    """Return the next row of the same node, or -1."""
    nodes = len(rows.first)
    return rows.first[row] if row < nodes else rows.next[row - nodes]


@kernel
def _pair(rows, segments, a, b, x, y, width):
    """Note rows a and b of a node at (x, y) if one branch parts them in the end."""
    nodes, found = len(rows.first), segments.found
    group_a = rows.lowest[a] if a < nodes else rows.group[a - nodes]
    if group_a != rows.group[b - nodes]:
        return
    count = _add_label(rows, found, 0, a, 1)
    count = _add_label(rows, found, count, b, -1)
    if count < 2:
        return
    count, n = reduce_crossed(segments, count, x, y, NEAR * width), rows.count[5]
    s = found[0, 2]
    if count != 1 or s < 0 or n == len(rows.pair):
        return
    above = found[0, 1] > 0  # row a
    rows.pair[n, 0], rows.pair[n, 1] = (a, b) if above else (b, a)
    ends, turn = segments.ends, segments.turn[s]
    rows.pair_normal[n, 0] = turn * (ends[s, 3] - ends[s, 1])
    rows.pair_normal[n, 1] = turn * (ends[s, 0] - ends[s, 2])
    rows.pair_crack[n], rows.pair_touching[n] = segments.crack[s], 0
    rows.count[5] = n + 1


@inlined_kernel
def _add_label(rows, found, count, row, way):
    """Add what tells a row to the branches on a way from its particles (1) or to them (-1)."""
    e = row - len(rows.first)
    for slot in range(2):
        branch = rows.crack[e, slot] if e >= 0 else -1
        if branch < 0:
            continue
        at = -1
        for i in range(count):
            at = i if found[i, 0] == branch else at
        if at < 0:
            count = add_crossing(found, count, branch, way * rows.side[e, slot], -1)
            continue
        for k in range(at, count - 1):
            found[k, 0], found[k, 1], found[k, 2] = (
                found[k + 1, 0],
                found[k + 1, 1],
                found[k + 1, 2],
            )
        count -= 1
    return count
