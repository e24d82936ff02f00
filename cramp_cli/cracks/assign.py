"""Give every particle-node pair its row.

Most particles see all their nodes across no crack: their rows are their nodes. The others have a
list of entries. A particle that a tip is passing is part cut (tip_nodes.py): a share of its weight
goes to the row of its side, the rest to both sides (tip_shares.py).
"""

import numpy as np

from cramp_cli.cracks.branches import off_joint
from cramp_cli.cracks.crossing import hidden_nodes, off_crack
from cramp_cli.cracks.lines import cracks_between
from cramp_cli.cracks.rows import add_normal, join_row
from cramp_cli.cracks.segments import HAIR, ON_CRACK
from cramp_cli.cracks.tip_nodes import cut_share
from cramp_cli.cracks.tip_shares import far_share
from cramp_cli.numerics.kernel import inlined_kernel, kernel
from cramp_cli.numerics.vector import pick
from cramp_cli.shapes.shape import gradients, node_steps, offsets, place_of, sees, weights
from cramp_cli.state.stencil import AROUND, CLOSE, FAR


@kernel
def list_particles_near_cracks(stencil, bands, report, listed_capacity):
    """List the particles that must test for cracks, and those that may see nodes with several rows.

    bands: (blocks, bands + 1) first particle of each band; report: (blocks, bands, 4) of `locate`
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


@inlined_kernel
def add_entry(stencil, line, k, row, share, bx, by):
    """Add an entry to the list of a particle."""
    e = stencil.entries[line]
    stencil.which[line, e], stencil.table[line, e] = k, max(row, 0)
    stencil.share[line, e] = share
    stencil.bend[line, e, 0], stencil.bend[line, e, 1] = bx, by
    stencil.entries[line] = e + 1


@inlined_kernel
def is_felt(weight, gradient):
    """Return whether a particle gives anything to a node that it lists.

    A box that lies within two cells lists nodes of a third one as well, on one side of it and not
    on the other: rows and normals must not know them.
    """
    felt = weight > 0.0
    for slope in gradient:
        felt = felt or slope != 0.0
    return felt


@inlined_kernel
def give_row(stencil, rows, segments, line, k, node, group, crossed):
    """Give the pair of a particle and its node `k` the row of the cracks it crosses."""
    a, side_a, seg_a, b, side_b, seg_b, more = crossed
    rows.count[3] += more
    row = join_row(rows, node, group, a, side_a, b, side_b)
    add_normal(rows, row, a, segments, seg_a)
    add_normal(rows, row, b, segments, seg_b)
    add_entry(stencil, line, k, row, 1.0, 0.0, 0.0)


@inlined_kernel
def give_shares(stencil, rows, segments, line, k, node, group, crossed, cut, gx, gy):
    """Give the pair of a particle and its node `k` beside a tip its rows.

    The cut share goes to the row of the side of the particle, the rest to the rows of both sides as
    their masses are: what is whole moves with the mean of both sides (tip_shares.py).
    """
    a, side_a, seg_a, b, side_b, seg_b, more = crossed
    rows.count[3] += more
    c, across = rows.tip_branch[node], a == rows.tip_branch[node]
    if across:
        a, side_a, seg_a, b, side_b, seg_b = b, side_b, seg_b, -1, 0, -1
    elif b == c:
        across = True
        b, side_b, seg_b = -1, 0, -1
    far = far_share(rows, node)
    q, gain = (cut + (1.0 - cut) * far, 1.0 - far) if across else ((1.0 - cut) * far, -far)
    if q < 1.0:
        row = join_row(rows, node, group, a, side_a, b, side_b)
        add_normal(rows, row, a, segments, seg_a)
        add_normal(rows, row, b, segments, seg_b)
        add_entry(stencil, line, k, row, 1.0 - q, -gain * gx, -gain * gy)
    if q > 0.0:
        rows.count[3] += b >= 0
        side, seg = -rows.tip_side[node] * rows.tip_turn[node], rows.tip_segment[node]
        if a < 0 or c < a:
            row = join_row(rows, node, group, c, side, a, side_a)
        else:
            row = join_row(rows, node, group, a, side_a, c, side)
        add_normal(rows, row, c, segments, seg)
        add_normal(rows, row, a, segments, seg_a)
        add_entry(stencil, line, k, row, q, gain * gx, gain * gy)


@inlined_kernel
def are_plain(rows, first, steps):
    """Return whether no node of a particle is beside a tip or shared; first: the lowest of them."""
    for k in range(len(steps)):
        node = first + steps[k]
        if rows.tip[node] >= 0 or rows.lowest[node] < rows.highest[node]:
            return False
    return True


@kernel
def assign_rows(
    stencil, rows, segments, paths, particles, groups, part, line, shape, place, tip_nodes
):
    """List the rows of a block near cracks and meetings; too many are counted, not made.

    A plain particle leaves the list: its rows are its nodes.

    groups: contact group of every body, of every crack
    part: first of the listed particles of the block, and the one after its last; line: where those
    that stay on the list begin
    place: strides, nodes along the axes, width, lower; tip_nodes: of TipNodes

    returns: the line after the last that is in use
    """
    (of_body, of_crack), (strides, nodes_along, width, lower) = groups, place
    listed, base, local = stencil.listed, stencil.base, stencil.local
    steps, side, tolerance = offsets(strides, shape), len(node_steps(shape, 1)), ON_CRACK * width
    for candidate in range(part[0], part[1]):
        p = listed[candidate]
        first, cell, group = base[p], base[p], of_body[particles.body[p]]
        for d in range(len(strides)):
            cell += int(np.floor(local[p, d])) * strides[d]
        i, j = first % nodes_along[0], first // strides[1]
        lowest = (lower[0] + width * i, lower[1] + width * j)
        place = place_of(shape, strides, stencil, p)
        S, G = weights(place, shape), gradients(place, shape)
        x, y = particles.position[p, 0], particles.position[p, 1]
        hidden, unsure = hidden_nodes(segments, cell, x, y, lowest, width, side, tolerance)
        if hidden | unsure == 0 and are_plain(rows, first, steps):
            stencil.near[p] = AROUND
            continue
        listed[line], stencil.near[p], stencil.entries[line] = p, line, 0
        if unsure:
            x, y = off_joint(segments, x, y, HAIR * width)
            x, y = off_crack(segments, cell, x, y, tolerance)
        known, cut, gx, gy = -1, 1.0, 0.0, 0.0
        for k in range(len(steps)):
            if not sees(place, shape, k) or not is_felt(S[k], pick(G, k)):
                continue
            n = (lower[0] + width * (i + k % side), lower[1] + width * (j + k // side))
            node = first + steps[k]
            tip = rows.tip[node]
            tip = -1 if tip >= 0 and of_crack[tip // 2] != group else tip
            beside = rows.tip_branch[node] if tip >= 0 else -1
            crossed = cracks_between(
                segments, cell, hidden, unsure, k, (x, y), n, beside, of_crack, group, tolerance
            )
            if tip < 0:
                give_row(stencil, rows, segments, line, k, node, group, crossed)
                continue
            if tip != known:
                known = tip
                cut, gx, gy = cut_share(paths, tip, x, y, shape.half, width, tip_nodes)
            give_shares(stencil, rows, segments, line, k, node, group, crossed, cut, gx, gy)
        line += 1
    return line
