"""The rows of a node: one velocity field per body and side of the cracks.

A row of a node is told by the contact group of its particles (state/groups.py), the cracks that the
lines from them cross and the sides they come from. So the result does not depend on the order of
particles, any number of cracks may meet at a node, and contact acts between rows that differ by
exactly one crack, or of two bodies.
"""

from cramp_cli.numerics.kernel import inlined_kernel, kernel


@kernel
def forget_rows(rows):
    """Remove all extra rows."""
    for i in range(rows.count[1]):
        rows.first[rows.shared[i]] = -1
    rows.count[:4] = rows.count[5] = 0


@inlined_kernel
def find_row(rows, node, group, a, side_a, b, side_b):
    """Return the row of a group at `node` across cracks a and b (-1 for none), or -1.

    A row without cracks is that of the node itself for the first of the groups that see it.
    """
    if a < 0 and group == rows.lowest[node]:
        return node
    nodes = len(rows.first)
    row = rows.first[node]
    while row >= 0:
        e = row - nodes
        same_cracks = rows.crack[e, 0] == a and rows.crack[e, 1] == b
        same_sides = (a < 0 or rows.side[e, 0] == side_a) and (b < 0 or rows.side[e, 1] == side_b)
        if rows.group[e] == group and same_cracks and same_sides:
            return row
        row = rows.next[e]
    return -1


@inlined_kernel
def row_told(rows, node, group, crack, side, other, other_side):
    """Return the row that a crack tells from a side, on a side of another (-1 for none), or -1."""
    if other < 0:
        return find_row(rows, node, group, crack, side, -1, 0)
    if crack < other:
        return find_row(rows, node, group, crack, side, other, other_side)
    return find_row(rows, node, group, other, other_side, crack, side)


@inlined_kernel
def row_on_side(rows, node, group, crack, side, other, other_side):
    """Return the row of a side of a crack, on a side of another crack (-1 for none), or -1.

    It is the row that these cracks tell from these sides, else the one without the first crack.
    """
    row = row_told(rows, node, group, crack, side, other, other_side)
    return row if row >= 0 else find_row(rows, node, group, other, other_side, -1, 0)


@kernel
def row_across(rows, e, slot):
    """Return the row on the other side of the crack in `slot` of extra row `e`, or -1."""
    crack, side = rows.crack[e, slot], rows.side[e, slot]
    other, other_side = rows.crack[e, 1 - slot], rows.side[e, 1 - slot]
    return row_on_side(rows, rows.node[e], rows.group[e], crack, -side, other, other_side)


@kernel
def crossed_row(rows, node, crack):
    """Return the row of `node` told by one crack alone, or -1."""
    nodes = len(rows.first)
    row = rows.first[node]
    while row >= 0:
        if rows.crack[row - nodes, 0] == crack and rows.crack[row - nodes, 1] < 0:
            return row
        row = rows.next[row - nodes]
    return -1


@kernel
def add_row(rows, node, group, a, side_a, b, side_b):
    """Add a row to `node`, keeping its rows in ascending order of groups, cracks and sides.

    returns: the row, or -1 when there is no room
    """
    nodes, e = len(rows.first), rows.count[0]
    rows.count[0] += 1
    if e >= len(rows.node):
        return -1
    if rows.first[node] < 0:
        rows.shared[rows.count[1]] = node
        rows.count[1] += 1
    rows.node[e], rows.group[e], rows.crack[e, 0], rows.crack[e, 1] = node, group, a, b
    rows.side[e, 0], rows.side[e, 1] = side_a, side_b
    rows.normal[e, :, :] = 0.0
    rows.touching[e, :] = 0
    rows.owner[e, :] = -1
    rows.impulse[e, :, :, :] = 0.0
    before, after = -1, rows.first[node]
    while after >= 0 and _comes_first(rows, after - nodes, group, a, side_a, b, side_b):
        before, after = after, rows.next[after - nodes]
    rows.next[e] = after
    if before < 0:
        rows.first[node] = nodes + e
    else:
        rows.next[before - nodes] = nodes + e
    return nodes + e


@kernel
def _comes_first(rows, e, group, a, side_a, b, side_b):
    cracks, sides = (rows.crack[e, 0], rows.crack[e, 1]), (rows.side[e, 0], rows.side[e, 1])
    return (rows.group[e], *cracks, *sides) < (group, a, b, side_a, side_b)


@inlined_kernel
def join_row(rows, node, group, a, side_a, b, side_b):
    """Return the row of a pair that crosses cracks a and b from the given sides.

    A pair that comes from the wrong side of a crack (a crack folded within a cell) is counted and
    kept without that crack. At a node beside a tip both sides have rows, and none is wrong.
    """
    row = find_row(rows, node, group, a, side_a, b, side_b)
    if row >= 0:
        return row
    wrong_a = a >= 0 and _is_wrong(rows, node, a, side_a)
    wrong_b = b >= 0 and _is_wrong(rows, node, b, side_b)
    if not wrong_a and not wrong_b:
        return add_row(rows, node, group, a, side_a, b, side_b)
    rows.count[2] += 1
    if wrong_a and not wrong_b and b >= 0:
        return _join_single(rows, node, group, b, side_b)
    if wrong_b and not wrong_a:
        return _join_single(rows, node, group, a, side_a)
    return _join_single(rows, node, group, -1, 0)


@kernel
def _join_single(rows, node, group, a, side_a):
    row = find_row(rows, node, group, a, side_a, -1, 0)
    return row if row >= 0 else add_row(rows, node, group, a, side_a, -1, 0)


@kernel
def _is_wrong(rows, node, crack, side):
    """Return whether the rows of a node know this crack from the other side only."""
    nodes = len(rows.first)
    row = rows.first[node]
    while row >= 0:
        for slot in range(2):
            if rows.crack[row - nodes, slot] == crack and rows.side[row - nodes, slot] != side:
                return True
        row = rows.next[row - nodes]
    return False


@inlined_kernel
def add_normal(rows, row, crack, segments, s):
    """Add segment `s` of a branch, turned from above to below, to the normals of a row.

    Where a branch is made of several cracks the law of the last one holds.
    """
    e, ends = row - len(rows.first), segments.ends
    for slot in range(2):
        if e >= 0 and s >= 0 and rows.crack[e, slot] == crack:
            rows.normal[e, slot, 0] += segments.turn[s] * (ends[s, 3] - ends[s, 1])
            rows.normal[e, slot, 1] += segments.turn[s] * (ends[s, 0] - ends[s, 2])
            rows.owner[e, slot] = max(rows.owner[e, slot], segments.crack[s])
