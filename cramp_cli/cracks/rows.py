"""Give every particle-node pair its row: one velocity field for each side of the cracks.

A row of a node is told by the cracks that the lines from its particles cross, so the result does not
depend on the order of particles, any number of cracks may meet at a node, and contact acts between
rows that differ by exactly one crack.
"""

import numpy as np

from cramp_cli.cracks.crossing import ON_CRACK, crossed_cracks
from cramp_cli.numerics.kernel import kernel
from cramp_cli.numerics.tensor import vector
from cramp_cli.shapes.shape import node_steps, offsets


@kernel
def find_particles_near_cracks(stencil, segments, strides, listed_capacity):
    """List the particles that must test for cracks, and those that may see a node with several rows.

    returns: number of particles to list, larger than `listed_capacity` if the table is too short
    """
    base, local, near = stencil.base, stencil.local, stencil.near
    listed, around = stencil.listed, stencil.around
    head, zone = segments.head, segments.zone
    n_listed, n_around = 0, 0
    for p in range(len(base)):
        near[p] = -1
        cell = base[p]
        for d in range(len(strides)):
            cell += int(np.floor(local[p, d])) * strides[d]
        if zone[cell]:
            around[n_around] = p
            n_around += 1
            if head[cell] >= 0:
                if n_listed < listed_capacity:
                    near[p] = n_listed
                    listed[n_listed] = p
                n_listed += 1
    stencil.count[0], stencil.count[1] = min(n_listed, listed_capacity), n_around
    return n_listed


@kernel
def forget_rows(rows):
    """Remove all extra rows."""
    for i in range(rows.count[1]):
        rows.first[rows.shared[i]] = -1
    rows.count[:] = 0


@kernel
def find_row(rows, node, a, b):
    """Return the row of `node` reached across cracks a and b (-1 for none), or -1 if there is none."""
    if a < 0:
        return node
    nodes = len(rows.first)
    row = rows.first[node]
    while row >= 0:
        if rows.crack[row - nodes, 0] == a and rows.crack[row - nodes, 1] == b:
            return row
        row = rows.next[row - nodes]
    return -1


@kernel
def add_row(rows, node, a, b):
    """Add a row to `node`, keeping its rows in ascending order of cracks; return it, or -1 if full."""
    nodes, e = len(rows.first), rows.count[0]
    if e >= len(rows.node):
        rows.count[0] += 1
        return -1
    rows.count[0] += 1
    if rows.first[node] < 0:
        rows.shared[rows.count[1]] = node
        rows.count[1] += 1
    rows.node[e], rows.crack[e, 0], rows.crack[e, 1] = node, a, b
    rows.side[e, :] = 0
    rows.normal[e, :, :] = 0.0
    rows.touching[e, :] = 0
    before, after = -1, rows.first[node]
    while after >= 0 and (rows.crack[after - nodes, 0], rows.crack[after - nodes, 1]) < (a, b):
        before, after = after, rows.next[after - nodes]
    rows.next[e] = after
    if before < 0:
        rows.first[node] = nodes + e
    else:
        rows.next[before - nodes] = nodes + e
    return nodes + e


@kernel
def join_row(rows, node, a, side_a, b, side_b):
    """Return the row of a pair that crosses cracks a and b from the given sides.

    A pair that comes from the wrong side of a crack (a crack folded within a cell) is counted and kept
    in the row of the other crack, or in the node's own.
    """
    nodes = len(rows.first)
    if a < 0:
        return node
    row = find_row(rows, node, a, b)
    if row < 0:
        row = add_row(rows, node, a, b)
        if row >= 0:
            rows.side[row - nodes, 0], rows.side[row - nodes, 1] = side_a, side_b
        return row
    wrong_a = rows.side[row - nodes, 0] != side_a
    wrong_b = b >= 0 and rows.side[row - nodes, 1] != side_b
    if not wrong_a and not wrong_b:
        return row
    rows.count[2] += 1
    if b >= 0 and wrong_a and not wrong_b:
        return join_single(rows, node, b, side_b)
    if b >= 0 and wrong_b and not wrong_a:
        return join_single(rows, node, a, side_a)
    return node


@kernel
def join_single(rows, node, a, side_a):
    """Return the row across crack a alone, added if need be; the node's own row on a wrong side."""
    row = find_row(rows, node, a, -1)
    if row < 0:
        row = add_row(rows, node, a, -1)
        if row >= 0:
            rows.side[row - len(rows.first), 0] = side_a
    elif rows.side[row - len(rows.first), 0] != side_a:
        return node
    return row


@kernel
def add_normal(rows, row, slot, ends, s):
    """Add segment `s`, turned from above to below, to the normal of a row."""
    e = row - len(rows.first)
    rows.normal[e, slot, 0] += ends[s, 3] - ends[s, 1]
    rows.normal[e, slot, 1] += ends[s, 0] - ends[s, 2]


@kernel
def assign_rows(
    stencil, rows, segments, position, shape_of_table, strides, nodes_along, width, lower
):
    """Fill the table of rows of all listed particles; rows too many are counted, not made."""
    listed, table, base, local = stencil.listed, stencil.table, stencil.base, stencil.local
    nodes, ends = len(rows.first), segments.ends
    steps = offsets(strides, shape_of_table)
    side = len(node_steps(shape_of_table, 1))
    tolerance = ON_CRACK * width
    for line in range(stencil.count[0]):
        p = listed[line]
        cell = base[p]
        for d in range(len(strides)):
            cell += int(np.floor(local[p, d])) * strides[d]
        x = vector(strides, position, p)
        corner = (base[p] % nodes_along[0], base[p] // strides[1])
        for k in range(len(steps)):
            node = base[p] + steps[k]
            nx = lower[0] + width * (corner[0] + k % side)
            ny = lower[1] + width * (corner[1] + k // side)
            a, side_a, seg_a, b, side_b, seg_b, more = crossed_cracks(
                segments, cell, x[0], x[1], nx, ny, tolerance
            )
            rows.count[3] += more
            row = join_row(rows, node, a, side_a, b, side_b)
            table[line, k] = max(row, 0)
            if row >= nodes:
                if rows.crack[row - nodes, 0] == a:
                    add_normal(rows, row, 0, ends, seg_a)
                if rows.crack[row - nodes, 0] == b and b >= 0:
                    add_normal(rows, row, 0, ends, seg_b)
                if rows.crack[row - nodes, 1] == b and b >= 0:
                    add_normal(rows, row, 1, ends, seg_b)


@kernel
def clear_shared(rows):
    """Set displacement and place to zero in all rows of nodes with several rows."""
    nodes = len(rows.first)
    for i in range(rows.count[1]):
        row = rows.shared[i]
        while row >= 0:
            rows.displacement[row, :] = 0.0
            rows.place[row, :] = 0.0
            row = rows.first[row] if row < nodes else rows.next[row - nodes]
