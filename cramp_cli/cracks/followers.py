"""A node ahead of a tip opens as the nodes behind it do.

Behind a smooth tip the crack opens by q S d: the cut share q of a particle, the weight S of a node,
the jump d between the two sides of that node (tip_shares.py). The weight of a node ahead of the tip
rises where q falls. Their product is a bubble over the last particles behind the tip; in its middle
it has no slope along the crack, so that nothing shears these particles, and little mass moves with
it. With a jump of its own the node opens some ten times as far as its neighbour behind: the tip is
a quarter of a cell too long, and comes to rest there some thousand times more slowly than a wave
passes a cell. So the node has no jump of its own: it follows the nodes a whole number of cells
behind it (on an oblique crack the mean of those around that place, by what moves with their
jumps). A jump is that of above against below, so the nodes of either side lead: on a crack that
crosses a row of nodes near its tip, those behind a follower lie on its other side.

A node just behind an oblique tip may be as weakly held, where it hardly sees the other side: with
next to nothing that moves with its jump (`FAINT`) it follows as well.

A tip that runs leads nobody: closing tractions keep its nodes from opening far (release.py), and
each node that it passes would lose what parts its jump from that of the others.

The constraint is that of a Galerkin method: the jump of a lead takes up the momentum that parts the
sides of its followers, and forces as momenta, so energy is kept and each node keeps its momentum.
The inertia of a lead is the reduced mass of its sides; a follower adds only what moves with its
jump (`inertia_of_jump`): with all of its mass waves would open the tip too slowly.
"""

from math import ceil, floor
from typing import NamedTuple

import numpy as np

from cramp_cli.cracks.rows import find_row
from cramp_cli.cracks.tip_nodes import FAR, along_crack
from cramp_cli.cracks.tip_shares import inertia_of_jump
from cramp_cli.numerics.kernel import inlined_kernel, kernel

MOST = 32  # nodes of a tip that may follow, or lead: LATERAL and REACH of tip_nodes.py leave 30
ON_TIP = 1e-9  # cells; a node at the tip is behind it
LIGHT = 1e-6  # a smaller weight of a node that leads is none
# Share of its mass that moves with the jump of a node, below which it follows up to a cell behind
# the tip. With 0.003 K is the same, with 0.006 off by 2.5 % at small angles, with none the tip of a
# crack at 45 degrees jumps by a sixth of a cell when it passes a node.
FAINT = 0.004
# Sine of the angle to the grid below which no node is faint: none matters there, and half a body
# beside a symmetry plane, which is a line of the grid, does not know of those on its crack.
OBLIQUE = 0.02


class Followers(NamedTuple):
    """Pairs of rows, above and below a crack, whose jump is that of others behind the tip.

    A follower without leads has sides that move as one.
    """

    count: np.ndarray  # (2,) followers and leads in use
    follower: np.ndarray  # (followers, 2) rows above and below the crack
    lead: np.ndarray  # (followers, 4) number of a lead
    weight: np.ndarray  # (followers, 4) what it counts, 0 for none
    row: np.ndarray  # (leads, 2) rows of a lead, as of a follower
    inertia: np.ndarray  # (leads,) mass that moves with the jump, that of followers included, kg
    jump: np.ndarray  # (leads, dim) momentum that parts the sides, then the jump of the velocity


def make_followers(tips: int, dim: int) -> Followers:
    """Return room for the followers of so many tips."""
    n = MOST * tips
    return Followers(
        count=np.zeros(2, dtype=np.int64),
        follower=np.zeros((n, 2), dtype=np.int64),
        lead=np.zeros((n, 4), dtype=np.int64),
        weight=np.zeros((n, 4)),
        row=np.zeros((n, 2), dtype=np.int64),
        inertia=np.zeros(n),
        jump=np.zeros((n, dim)),
    )


@kernel
def sides_beside_tip(rows, of_crack, node):
    """Return the rows of a node beside a tip above and below its crack, or -1 for none.

    of_crack: contact group of every crack
    """
    group, across = of_crack[rows.tip[node] // 2], -rows.tip_side[node] * rows.tip_turn[node]
    own = find_row(rows, node, group, -1, 0, -1, 0)
    across = find_row(rows, node, group, rows.tip_branch[node], across, -1, 0)
    return (own, across) if rows.tip_side[node] > 0 else (across, own)


@kernel
def list_followers(followers, rows, paths, running, of_crack, width, lower, strides):
    """List the nodes at tips that see both sides but do not hold them, and those that they follow.

    running: (ends,) of Growth
    """
    followers.count[:] = 0
    for i in range(rows.count[4]):
        node = rows.tipped[i]
        above, below = sides_beside_tip(rows, of_crack, node)
        if min(above, below) < 0 or running[rows.tip[node]]:
            continue
        x, y, ahead, ex, ey = _from_tip(rows, paths, node, width, lower, strides)
        if follows(rows, node, ahead / width, (ex, ey)):
            back = max(ceil(ahead / width - ON_TIP), 1)
            f = followers.count[0]
            followers.count[0] += 1
            followers.follower[f, 0], followers.follower[f, 1] = above, below
            place = (x - back * ex * width, y - back * ey * width)
            _find_leads(followers, f, rows, paths, of_crack, node, place, width, lower, strides)


@inlined_kernel
def follows(rows, node, ahead, way):
    """Return whether a node has no jump of its own.

    ahead: of its tip (cells); way: unit vector along the crack
    """
    seen = rows.tip_seen[node, 0] + rows.tip_seen[node, 1]
    faint = inertia_of_jump(rows, node) < FAINT * seen and min(abs(way[0]), abs(way[1])) > OBLIQUE
    return ahead > ON_TIP or (faint and ahead > -1.0)


@kernel
def _from_tip(rows, paths, node, width, lower, strides):
    """Return where a node is (m), how far ahead of its tip (m), and the way of the crack there."""
    tip = rows.tip[node]
    first, last = paths.start[tip // 2], paths.start[tip // 2 + 1] - 1
    at = first if tip % 2 == 0 else last
    x, y = lower[0] + node % strides[1] * width, lower[1] + node // strides[1] * width
    ahead, _, _, ex, ey = along_crack(paths.point, first, last, at, x, y, FAR * width)
    return x, y, ahead, ex, ey


@kernel
def _find_leads(followers, f, rows, paths, of_crack, node, place, width, lower, strides):
    """Let follower f follow those of the four nodes around a place that have jumps of their own.

    node: that of the follower; place: behind it (m)
    """
    weight, lead, total = followers.weight, followers.lead, 0.0
    rx, ry = (place[0] - lower[0]) / width, (place[1] - lower[1]) / width
    i0, j0 = floor(rx), floor(ry)
    for k in range(4):
        i, j = i0 + k % 2, j0 + k // 2
        other = i * strides[0] + j * strides[1]
        w = (1.0 - abs(rx - i)) * (1.0 - abs(ry - j))
        weight[f, k], lead[f, k] = 0.0, 0
        if w < LIGHT or rows.tip[other] != rows.tip[node]:
            continue
        above, below = sides_beside_tip(rows, of_crack, other)
        _, _, ahead, ex, ey = _from_tip(rows, paths, other, width, lower, strides)
        w *= inertia_of_jump(rows, other)  # a node that hardly sees the other side leads nowhere
        if w > 0.0 and min(above, below) >= 0 and not follows(rows, other, ahead / width, (ex, ey)):
            weight[f, k] = w
            lead[f, k] = _number_of_lead(followers, rows, other, above, below)
            total += w
    for k in range(4):
        weight[f, k] /= total if total > 0.0 else 1.0
        followers.inertia[lead[f, k]] += weight[f, k] * inertia_of_jump(rows, node)


@kernel
def _number_of_lead(followers, rows, node, above, below):
    """Return the number of the lead with these rows; a new one if there is none."""
    row, n = followers.row, followers.count[1]
    for k in range(n):
        if row[k, 0] == above and row[k, 1] == below:
            return k
    row[n, 0], row[n, 1] = above, below
    near, far = rows.tip_seen[node, 0], rows.tip_seen[node, 1]
    followers.inertia[n] = near * far / (near + far)
    followers.count[1] += 1
    return n


@kernel
def follow(field, mass, followers, strides):
    """Give followers the jump of their leads; field: (rows, dim) momentum (kg m/s) or force (N)."""
    row, jump, inertia = followers.row, followers.jump, followers.inertia
    follower, lead, weight = followers.follower, followers.lead, followers.weight
    leads, dim = followers.count[1], len(strides)
    for d in range(dim):
        for k in range(leads):
            jump[k, d] = _parting(field, mass, row[k, 0], row[k, 1], d)
        for f in range(followers.count[0]):
            parting = _parting(field, mass, follower[f, 0], follower[f, 1], d)
            for e in range(4):
                jump[lead[f, e], d] += weight[f, e] * parting
        for k in range(leads):
            jump[k, d] /= inertia[k] if inertia[k] > 0.0 else 1.0
            _part(field, mass, row[k, 0], row[k, 1], d, jump[k, d])
        for f in range(followers.count[0]):
            led = 0.0
            for e in range(4):
                led += weight[f, e] * jump[lead[f, e], d]
            _part(field, mass, follower[f, 0], follower[f, 1], d, led)


@inlined_kernel
def _parting(field, mass, a, b, d):
    """Return the momentum of row b relative to row a."""
    both = mass[a] + mass[b]
    return (mass[a] * field[b, d] - mass[b] * field[a, d]) / both if both > 0.0 else 0.0


@inlined_kernel
def _part(field, mass, a, b, d, jump):
    """Let row b move faster than row a by `jump`, their sum as before."""
    both = mass[a] + mass[b]
    if both > 0.0:
        change = mass[a] * mass[b] / both * jump - _parting(field, mass, a, b, d)
        field[a, d] -= change
        field[b, d] += change
