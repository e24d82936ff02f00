"""Give every particle-node pair its row: one velocity field per body and side of the cracks.

A row of a node is told by the contact group of its particles (state/groups.py), the cracks that the
lines from them cross and the sides they come from. So the result does not depend on the order of
particles, any number of cracks may meet at a node, and contact acts between rows that differ by
exactly one crack, or of two bodies. A particle that a tip is passing is part cut (tip_nodes.py): a
share of its weight goes to the row of its side, the rest to both sides (tip_shares.py).
"""

import numpy as np

from cramp_cli.cracks.crossing import (
    HAIR,
    ON_CRACK,
    crossed_cracks,
    crosses,
    double_area,
    note_sides,
    off_crack,
    sees_past_all,
)
from cramp_cli.cracks.tip_nodes import cut_share
from cramp_cli.cracks.tip_shares import far_share
from cramp_cli.numerics.kernel import inlined_kernel, kernel
from cramp_cli.shapes.shape import node_steps, offsets
from cramp_cli.state.stencil import AROUND, CLOSE, FAR

NO_CRACK = (-1, 0, -1, -1, 0, -1, 0)  # what `crossed_cracks` says of a free line


@kernel
def list_particles_near_cracks(stencil, bands, report, listed_capacity):
    """List the particles that must test for cracks, and those that may see nodes with several rows.

    bands: (blocks, bands + 1) first particle of each band; report: (blocks, bands, 3) of `locate`
    returns: number of particles to list, larger than `listed_capacity` if the table is too short
    """
    near, listed, around = stencil.near, stencil.listed, stencil.around
    n_listed, n_around = 0, 0
    for block in range(len(bands)):
        for band in range(bands.shape[1] - 1):
            if report[block, band, 2] == 0:
                continue
            for p in range(bands[block, band], bands[block, band + 1]):
                if near[p] == FAR:
                    continue
                around[n_around] = p
                n_around += 1
                if near[p] == AROUND:
                    continue
                near[p] = CLOSE
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
    rows.count[:4] = 0


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


@kernel
def row_across(rows, e, slot):
    """Return the row on the other side of the crack in `slot` of extra row `e`, or -1.

    It is the row that the same cracks tell from the other side, else the one without this crack.
    """
    node, group = rows.node[e], rows.group[e]
    other, other_side = rows.crack[e, 1 - slot], rows.side[e, 1 - slot]
    crack, side = rows.crack[e, slot], rows.side[e, slot]
    if other < 0:
        facing = find_row(rows, node, group, crack, -side, -1, 0)
    elif slot == 0:
        facing = find_row(rows, node, group, crack, -side, other, other_side)
    else:
        facing = find_row(rows, node, group, other, other_side, crack, -side)
    return facing if facing >= 0 else find_row(rows, node, group, other, other_side, -1, 0)


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
def add_normal(rows, row, crack, ends, s):
    """Add segment `s` of a crack, turned from above to below, to the normals of a row."""
    e = row - len(rows.first)
    for slot in range(2):
        if e >= 0 and s >= 0 and rows.crack[e, slot] == crack:
            rows.normal[e, slot, 0] += ends[s, 3] - ends[s, 1]
            rows.normal[e, slot, 1] += ends[s, 0] - ends[s, 2]


@inlined_kernel
def add_entry(stencil, line, k, row, share, bx, by):
    """Add an entry to the list of a particle."""
    e = stencil.entries[line]
    stencil.which[line, e], stencil.table[line, e] = k, max(row, 0)
    stencil.share[line, e] = share
    stencil.bend[line, e, 0], stencil.bend[line, e, 1] = bx, by
    stencil.entries[line] = e + 1


@inlined_kernel
def give_row(stencil, rows, ends, line, k, node, group, crossed):
    """Give the pair of a particle and its node `k` the row of the cracks it crosses."""
    a, side_a, seg_a, b, side_b, seg_b, more = crossed
    rows.count[3] += more
    row = join_row(rows, node, group, a, side_a, b, side_b)
    add_normal(rows, row, a, ends, seg_a)
    add_normal(rows, row, b, ends, seg_b)
    add_entry(stencil, line, k, row, 1.0, 0.0, 0.0)


@inlined_kernel
def give_shares(stencil, rows, ends, line, k, node, group, crossed, cut, gx, gy):
    """Give the pair of a particle and its node `k` beside a tip its rows.

    The cut share goes to the row of the side of the particle, the rest to the rows of both sides as
    their masses are: what is whole moves with the mean of both sides (tip_shares.py).
    """
    a, side_a, seg_a, b, side_b, seg_b, more = crossed
    rows.count[3] += more
    c, across = rows.tip[node] // 2, a == rows.tip[node] // 2
    if across:
        a, side_a, seg_a, b, side_b, seg_b = b, side_b, seg_b, -1, 0, -1
    elif b == c:
        across = True
        b, side_b, seg_b = -1, 0, -1
    far = far_share(rows, node)
    q, gain = (cut + (1.0 - cut) * far, 1.0 - far) if across else ((1.0 - cut) * far, -far)
    if q < 1.0:
        row = join_row(rows, node, group, a, side_a, b, side_b)
        add_normal(rows, row, a, ends, seg_a)
        add_normal(rows, row, b, ends, seg_b)
        add_entry(stencil, line, k, row, 1.0 - q, -gain * gx, -gain * gy)
    if q > 0.0:
        rows.count[3] += b >= 0
        side, seg = -rows.tip_side[node], rows.tip_segment[node]
        if a < 0 or c < a:
            row = join_row(rows, node, group, c, side, a, side_a)
        else:
            row = join_row(rows, node, group, a, side_a, c, side)
        add_normal(rows, row, c, ends, seg)
        add_normal(rows, row, a, ends, seg_a)
        add_entry(stencil, line, k, row, q, gain * gx, gain * gy)


@inlined_kernel
def box_is_cut(segments, cell, x, y, x0, y0, x1, y1, tolerance):
    """Return whether a crack may pass between a point and the corners of a box, or touch one."""
    ends, entry = segments.ends, segments.head[cell]
    while entry >= 0:
        s = segments.item[entry]
        ax, ay, bx, by = ends[s, 0], ends[s, 1], ends[s, 2], ends[s, 3]
        limit = 2.0 * HAIR / ON_CRACK * tolerance * (abs(bx - ax) + abs(by - ay))
        areas = (
            double_area(ax, ay, bx, by, x, y),
            double_area(ax, ay, bx, by, x0, y0),
            double_area(ax, ay, bx, by, x1, y0),
            double_area(ax, ay, bx, by, x0, y1),
            double_area(ax, ay, bx, by, x1, y1),
        )
        if min(areas) <= limit and max(areas) >= -limit:
            return True
        entry = segments.next[entry]
    return False


@inlined_kernel
def is_imagined(segments, s, x, y, nx, ny, tolerance):
    """Return whether a line crosses segment `s` only where its tip has been carried on."""
    ends, real = segments.ends, segments.real
    carried = ends[s, 0] != real[s, 0] or ends[s, 1] != real[s, 1]
    carried = carried or ends[s, 2] != real[s, 2] or ends[s, 3] != real[s, 3]
    return carried and crosses(real, segments.down, s, x, y, nx, ny, tolerance) == 0


@inlined_kernel
def without_imagined(segments, crossed, own, x, y, nx, ny, tolerance):
    """Return the cracks crossed; those of another tip than the node's count where they are real.

    A tip is carried on to tell the sides ahead of it at its own nodes; at the nodes of a tip that
    comes to meet it, this would cut what still holds the two together.

    own: crack of the tip that is near the node, or -1
    """
    a, _, seg_a, b, _, seg_b, _ = crossed
    no_b = b >= 0 and b != own and is_imagined(segments, seg_b, x, y, nx, ny, tolerance)
    no_a = a >= 0 and a != own and is_imagined(segments, seg_a, x, y, nx, ny, tolerance)
    return but_for(crossed, no_a, no_b)


@inlined_kernel
def but_for(crossed, no_a, no_b):
    """Return the cracks crossed without the first, the second, or both."""
    a, side_a, seg_a, b, side_b, seg_b, more = crossed
    if no_b:
        b, side_b, seg_b = -1, 0, -1
    if no_a:
        a, side_a, seg_a = b, side_b, seg_b
        b, side_b, seg_b = -1, 0, -1
    return a, side_a, seg_a, b, side_b, seg_b, more


@inlined_kernel
def of_group(crossed, of_crack, group):
    """Return those of the cracks crossed that cut bodies of a group."""
    a, b = crossed[0], crossed[3]
    return but_for(crossed, a >= 0 and of_crack[a] != group, b >= 0 and of_crack[b] != group)


@kernel
def assign_rows(
    stencil,
    rows,
    segments,
    paths,
    particles,
    of_body,
    of_crack,
    shape,
    strides,
    nodes_along,
    width,
    lower,
    centre,
    ramp,
):
    """List the rows of all particles near cracks and meetings; too many are counted, not made.

    A particle that sees all its nodes across no crack and shares none with another group leaves the
    list: its rows are its nodes.

    of_body, of_crack: contact group of each
    """
    position, body = particles.position, particles.body
    listed, base, local = stencil.listed, stencil.base, stencil.local
    steps = offsets(strides, shape)
    side, tolerance = len(node_steps(shape, 1)), ON_CRACK * width
    line = 0
    for candidate in range(stencil.count[0]):
        p = listed[candidate]
        cell, beside_tip, meets, group = base[p], False, False, of_body[body[p]]
        for d in range(len(strides)):
            cell += int(np.floor(local[p, d])) * strides[d]
        for k in range(len(steps)):
            node = base[p] + steps[k]
            beside_tip = beside_tip or rows.tip[node] >= 0
            meets = meets or rows.lowest[node] < rows.highest[node]
        corner = (base[p] % nodes_along[0], base[p] // strides[1])
        x0, y0 = lower[0] + width * corner[0], lower[1] + width * corner[1]
        x1, y1 = x0 + width * (side - 1), y0 + width * (side - 1)
        x, y = position[p, 0], position[p, 1]
        listed_for = beside_tip or meets
        if not listed_for and not box_is_cut(segments, cell, x, y, x0, y0, x1, y1, tolerance):
            stencil.near[p] = AROUND
            continue
        listed[line], stencil.near[p], stencil.entries[line] = p, line, 0
        x, y = off_crack(segments, cell, x, y, tolerance)
        note_sides(segments, cell, x, y, tolerance)
        known, cut, gx, gy = -1, 1.0, 0.0, 0.0
        for k in range(len(steps)):
            nx = lower[0] + width * (corner[0] + k % side)
            ny = lower[1] + width * (corner[1] + k // side)
            node = base[p] + steps[k]
            tip = rows.tip[node]
            tip = -1 if tip >= 0 and of_crack[tip // 2] != group else tip
            crossed = NO_CRACK
            if not sees_past_all(segments, cell, nx, ny, tolerance):
                own = tip // 2 if tip >= 0 else -1
                nx, ny = off_crack(segments, cell, nx, ny, tolerance)
                crossed = crossed_cracks(segments, cell, x, y, nx, ny, tolerance)
                crossed = without_imagined(segments, crossed, own, x, y, nx, ny, tolerance)
                crossed = of_group(crossed, of_crack, group)
            if tip < 0:
                give_row(stencil, rows, segments.ends, line, k, node, group, crossed)
                continue
            if tip != known:
                known = tip
                cut, gx, gy = cut_share(paths, tip, x, y, shape.half, width, centre, ramp)
            give_shares(stencil, rows, segments.ends, line, k, node, group, crossed, cut, gx, gy)
        line += 1
    stencil.count[0] = line


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
