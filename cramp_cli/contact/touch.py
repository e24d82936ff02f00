"""Contact of bodies, pair by pair: the laws are those of crack faces (cracks/contact.py).

A node with three bodies has three pairs, which touch one after the other, several times, until none
approaches: the momentum that one body gets the other gives, so the sum is kept to round-off.

All three passes of a step go by the separation at its start: a pair that touched in the update
alone would give the strain a velocity with which the bodies still approach.
"""

from cramp_cli.cracks.contact import (
    FIRST,
    OPEN,
    SLIDING,
    UPDATE,
    impulse,
    share_between,
    touch_pair,
    work_of_friction,
)
from cramp_cli.numerics.kernel import kernel
from cramp_cli.numerics.vector import (
    dot,
    plus,
    times,
    vector,
)

SWEEPS = 10  # over the pairs of a node that has several


@kernel
def touch_pairs(grid, pairs, laws, rigid, velocity, share, forces, strides, dt, stage):
    """Let all pairs touch, node by node; add the forces on the bodies in the update of momenta.

    rigid: (groups,) 1 for rigid bodies; velocity: (groups, dim) of these (m/s)
    share: (nodes,) of a node's sums that are the bodies' own, less than 1 at symmetry planes
    forces: (groups, dim) of all others on the bodies of a group (N)

    returns: work of friction, and work of the rigid bodies on the others (J)
    """
    friction, external, first = 0.0, 0.0, 0
    while first < pairs.used[0]:
        last = first + 1
        while last < pairs.used[0] and pairs.node[last] == pairs.node[first]:
            last += 1
        own = share[pairs.node[first]]
        pairs.state[first:last] = OPEN
        for _ in range(1 if last == first + 1 else SWEEPS):
            for i in range(first, last):
                work, given = touch_one(grid, pairs, i, laws, rigid, velocity, strides, dt, stage)
                if stage == UPDATE:
                    ga, gb = pairs.group[i, 0], pairs.group[i, 1]
                    friction += own * work
                    for d in range(len(strides)):
                        forces[ga, d] += own * given[d] / dt
                        forces[gb, d] -= own * given[d] / dt
                        external += own * given[d] * (velocity[gb, d] - velocity[ga, d])
        first = last
    return friction, external


@kernel
def touch_one(grid, pairs, i, laws, rigid, velocity, strides, dt, stage):
    """Let pair i touch; return the work of friction (J) and the momentum that row a got."""
    a, b, ga, gb = pairs.row[i, 0], pairs.row[i, 1], pairs.group[i, 0], pairs.group[i, 1]
    law = (laws.kind[ga, gb], laws.mu[ga, gb], laws.mu_static[ga, gb])
    n, gap = vector(strides, pairs.normal, i), pairs.gap[i]
    state, work, given = OPEN, 0.0, times(n, 0.0)
    if rigid[gb]:
        v = vector(strides, velocity, gb)
        state, work, given = push(grid, a, v, n, gap, *law, strides, dt, stage)
    elif rigid[ga]:
        v = vector(strides, velocity, ga)
        state, work, given = push(grid, b, v, times(n, -1.0), gap, *law, strides, dt, stage)
        given = times(given, -1.0)
    elif grid.mass[a] > 0.0 and grid.mass[b] > 0.0:
        state, work, given = touch_pair(grid, a, b, n, gap, *law, strides, dt, stage)
    pairs.state[i] = max(pairs.state[i], state)
    return work, given


@kernel
def push(grid, row, velocity, normal, gap, kind, mu, mu_static, strides, dt, stage):
    """Let a row touch a rigid body; return what it does, the work of friction (J), its momentum.

    A rigid body is a partner of infinite mass. velocity: its own (m/s); normal: towards it
    """
    mass, momentum, force = grid.mass[row], grid.momentum, grid.force
    p = vector(strides, momentum, row)
    if mass <= 0.0:
        return OPEN, 0.0, times(p, 0.0)
    dp = plus(times(velocity, mass), -1.0, p)
    dpn = dot(dp, normal)
    given, state = impulse(kind, mu, mu_static, dp, normal, dpn, gap)
    for d in range(len(strides)):
        momentum[row, d] += given[d]
        if stage == FIRST:
            grid.saved[row, d] = momentum[row, d]
        elif stage == UPDATE:
            force[row, d] += given[d] / dt
    work = work_of_friction(dp, given, normal, mass) if state == SLIDING else 0.0
    return state, work, given


@kernel
def touch_increments(increment, grid, pairs, rigid, strides):
    """Keep higher orders of the grid velocity from undoing the contact of the update.

    increment: (rows, dim), m/s; as in cracks/contact.py, a rigid body has none
    """
    for i in range(pairs.used[0]):
        a, b = pairs.row[i, 0], pairs.row[i, 1]
        ma, mb = grid.mass[a], grid.mass[b]
        n, state = vector(strides, pairs.normal, i), pairs.state[i]
        if rigid[pairs.group[i, 0]]:
            ma, mb = 1.0, 0.0
        elif rigid[pairs.group[i, 1]]:
            ma, mb = 0.0, 1.0
        if state != OPEN:
            share_between(increment, a, b, ma, mb, n, state == SLIDING, strides)
