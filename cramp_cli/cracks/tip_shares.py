"""How much of what a node beside a tip sees lies on either side of the crack.

A particle that a tip is passing is cut to a share q (tip_nodes.py). At a node beside the tip the
sides have the velocities v_own and v_far, and the particle moves with

    v = q v_side + (1 - q) v_mean,    v_mean = (1 - far) v_own + far v_far,

where `far` is the share of the mass around the node that lies across the crack: v_mean is what the
node would have without a crack. The jump of the velocity is q (v_own - v_far), and apart from it
the node has its one velocity: no motion is left that the particles hardly feel. (A row of its own
for what is whole has such motions: the tip would creep under a constant load.)
"""

import numpy as np

from cramp_cli.cracks.crossing import double_area
from cramp_cli.cracks.segments import ON_CRACK
from cramp_cli.cracks.tip_nodes import FAR, along_crack, cut_share, mean_half
from cramp_cli.numerics.kernel import inlined_kernel, kernel
from cramp_cli.shapes.shape import offsets, place_of, sees, weights


@inlined_kernel
def far_share(rows, node):
    """Return the share of the mass that a node sees across the crack; 0 where nothing is cut."""
    own, far = rows.tip_seen[node, 0], rows.tip_seen[node, 1]
    return far / (own + far) if rows.tip_split[node] and far > 0.0 else 0.0


@inlined_kernel
def inertia_of_jump(rows, node):
    """Return the mass that moves with the jump of a node beside a tip (kg).

    A particle moves with q S times the jump and the share of the mass across: the sum of m S times
    the square of what stands beside S.
    """
    own, far = rows.tip_seen[node, 0], rows.tip_seen[node, 1]
    if own + far <= 0.0:
        return 0.0
    share = far / (own + far)
    return share**2 * rows.tip_cut[node, 0] + (1.0 - share) ** 2 * rows.tip_cut[node, 1]


@kernel
def sum_sides(rows, at_tips, stencil, paths, particles, groups, part, shape, place, tip_nodes):
    """Sum what every node beside a tip sees on both sides; mark the nodes that see a cut.

    at_tips: of Scratch; groups: contact group of every body, of every crack
    part: first of the listed particles of a block, and the one after its last
    place: strides, width
    """
    (of_body, of_crack), (strides, width) = groups, place
    position, mass, body = particles.position, particles.mass, particles.body
    steps = offsets(strides, shape)
    for candidate in range(part[0], part[1]):
        p = stencil.listed[candidate]
        beside = False
        for k in range(len(steps)):
            beside = beside or rows.tip[stencil.base[p] + steps[k]] >= 0
        if not beside:
            continue
        tip, known, side, cut = -1, -1, 0, 0.0
        place = place_of(shape, strides, stencil, p)
        S = weights(place, shape)
        for k in range(len(steps)):
            node = stencil.base[p] + steps[k]
            tip = rows.tip[node] if sees(place, shape, k) else -1
            if tip < 0 or of_crack[tip // 2] != of_body[body[p]]:
                continue
            if tip != known:
                known = tip
                x, y = position[p, 0], position[p, 1]
                side = _side_of(paths, tip, x, y, width)
                cut, _, _ = cut_share(paths, tip, x, y, shape.half, width, tip_nodes)
                note_size(at_tips, paths, tip, x, y, mean_half(shape.half), width)
            there = 0 if side == rows.tip_side[node] else 1
            rows.tip_seen[node, there] += S[k] * mass[p]
            rows.tip_cut[node, there] += S[k] * mass[p] * cut * cut
            rows.tip_split[node] = rows.tip_split[node] or cut > 0.0


@inlined_kernel
def note_size(at_tips, paths, tip, x, y, half, width):
    """Note the half size (cells) of a particle if none was nearer to its tip."""
    at = paths.start[tip // 2] if tip % 2 == 0 else paths.start[tip // 2 + 1] - 1
    away = np.hypot(x - paths.point[at, 0], y - paths.point[at, 1]) / width
    if away < at_tips[tip, 0] or (away == at_tips[tip, 0] and half > at_tips[tip, 1]):
        at_tips[tip, 0], at_tips[tip, 1] = away, half


@kernel
def see_image(rows, crack, on, outside, inside):
    """Add what the nodes around a symmetry plane see of the image, across the crack on the plane.

    outside, inside: nodes on both sides of the plane, each the image of the other
    """
    split = rows.tip_split
    for i in range(len(on)):
        both = rows.tip[inside[i]] // 2 == crack and rows.tip[outside[i]] // 2 == crack
        for seen in (rows.tip_seen, rows.tip_cut):
            if rows.tip[on[i]] // 2 == crack:
                seen[on[i], 0] = seen[on[i], 1] = seen[on[i], 0] + seen[on[i], 1]
            if both:
                seen[inside[i], 1] = seen[outside[i], 1]
                seen[outside[i], 0] = seen[inside[i], 0]
        if both:
            split[inside[i]] = split[outside[i]] = split[inside[i]] or split[outside[i]]


@kernel
def _side_of(paths, tip, x, y, width):
    """Return the side of a crack, carried on straight at its tip, on which a place lies."""
    point, crack = paths.point, tip // 2
    first, last = paths.start[crack], paths.start[crack + 1] - 1
    at = first if tip % 2 == 0 else last
    _, _, segment, _, _ = along_crack(point, first, last, at, x, y, FAR * width)
    k = first + segment
    ax, ay, bx, by = point[k, 0], point[k, 1], point[k + 1, 0], point[k + 1, 1]
    limit = ON_CRACK * width * (abs(bx - ax) + abs(by - ay))
    return 1 if double_area(ax, ay, bx, by, x, y) > limit else -1
