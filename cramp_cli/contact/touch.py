"""Contact of bodies, pair by pair: the laws are those of crack faces (cracks/contact.py).

A node with three bodies has three pairs, which touch one after the other, several times, until none
approaches: the momentum that one body gets the other gives, so the sum is kept to round-off.

All three passes of a step go by the separation at its start: a pair that touched in the update
alone would give the strain a velocity with which the bodies still approach.
"""

from cramp_cli.contact.adhesion import adhere
from cramp_cli.cracks.contact import (
    ADHESIVE,
    FIRST,
    FRICTIONAL,
    OPEN,
    SLIDING,
    UPDATE,
    impulse,
    share_between,
    touch_pair,
)
from cramp_cli.cracks.contact_books import is_light, momentum_to_meet
from cramp_cli.numerics.kernel import kernel
from cramp_cli.numerics.vector import (
    dot,
    plus,
    times,
    vector,
)

SWEEPS = 10  # over the pairs of a node that has several


@kernel
def touch_pairs(grid, pairs, clouds, laws, bodies, share, forces, strides, step, stage):
    """Let all pairs touch, node by node; add the forces on the bodies in the update of momenta.

    bodies: (groups,) 1 for rigid ones; (groups, dim) velocity of these (m/s)
    step: its duration (s), the width of a cell (m)
    share: (nodes,) of a node's sums that are the bodies' own, less than 1 at symmetry planes
    forces: (groups, dim) of all others on the bodies of a group (N)

    returns: work of friction, and work of the rigid bodies on the others (J)
    """
    (_, velocity), (dt, _) = bodies, step
    friction, external, first = 0.0, 0.0, 0
    while first < pairs.used[0]:
        last = first + 1
        while last < pairs.used[0] and pairs.node[last] == pairs.node[first]:
            last += 1
        own = share[pairs.node[first]]
        pairs.state[first:last] = OPEN
        for _ in range(1 if last == first + 1 else SWEEPS):
            for i in range(first, last):
                work, given = touch_one(grid, pairs, i, clouds, laws, bodies, strides, step, stage)
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
def touch_one(grid, pairs, i, clouds, laws, bodies, strides, step, stage):
    """Let pair i touch; return the work of friction (J) and the momentum that row a got."""
    a, b, ga, gb = pairs.row[i, 0], pairs.row[i, 1], pairs.group[i, 0], pairs.group[i, 1]
    (rigid, velocity), (dt, width) = bodies, step
    n, gap = vector(strides, pairs.normal, i), pairs.gap[i]
    state, work, given = OPEN, 0.0, times(n, 0.0)
    if grid.mass[a] <= 0.0 and not rigid[ga] or grid.mass[b] <= 0.0 and not rigid[gb]:
        return work, given
    kind = laws.kind[ga, gb]
    if kind == ADHESIVE:
        dp, towards = momentum_wanted(grid, pairs, i, bodies, strides)
        kind = adhere(pairs, i, laws, clouds, dp, towards, width, dt, stage)
    law = (kind, laws.mu[ga, gb], laws.mu_static[ga, gb])
    if rigid[gb]:
        v = vector(strides, velocity, gb)
        state, work, given = push(grid, a, v, n, gap, *law, strides, dt, stage)
    elif rigid[ga]:
        v = vector(strides, velocity, ga)
        state, work, given = push(grid, b, v, times(n, -1.0), gap, *law, strides, dt, stage)
        given = times(given, -1.0)
    else:
        pushed = times(momentum_to_meet(grid, a, b, strides, grid.force), dt)
        dp = momentum_to_meet(grid, a, b, strides, grid.momentum)
        state, given = touch_pair(grid, a, b, n, gap, law, strides, dt, stage)
        rubbing = kind == FRICTIONAL and state != OPEN and stage == UPDATE
        if rubbing and not is_light(grid.mass, a, b):  # what holds next to nothing has no velocity
            reduced = grid.mass[a] * (grid.mass[b] / (grid.mass[a] + grid.mass[b]))
            work = work_of_friction(dp, pushed, given, n, reduced)
    pairs.state[i] = max(pairs.state[i], state)
    return work, given


@kernel
def momentum_wanted(grid, pairs, i, bodies, strides):
    """Return the momentum that brings pair i to one velocity, and the normal from who gets it."""
    a, b, ga, gb = pairs.row[i, 0], pairs.row[i, 1], pairs.group[i, 0], pairs.group[i, 1]
    (rigid, velocity), n = bodies, vector(strides, pairs.normal, i)
    if rigid[gb]:
        return momentum_to_follow(grid, a, vector(strides, velocity, gb), strides), n
    if rigid[ga]:
        follow = momentum_to_follow(grid, b, vector(strides, velocity, ga), strides)
        return follow, times(n, -1.0)
    return momentum_to_meet(grid, a, b, strides, grid.momentum), n


@kernel
def momentum_to_follow(grid, row, velocity, strides):
    """Return the momentum that a row needs to move with a velocity (m/s)."""
    return plus(times(velocity, grid.mass[row]), -1.0, vector(strides, grid.momentum, row))


@kernel
def push(grid, row, velocity, normal, gap, kind, mu, mu_static, strides, dt, stage):
    """Let a row touch a rigid body; return what it does, the work of friction (J), its momentum.

    A rigid body is a partner of infinite mass. velocity: its own (m/s); normal: towards it
    """
    mass, momentum, force = grid.mass[row], grid.momentum, grid.force
    dp = momentum_to_follow(grid, row, velocity, strides)
    pushed = times(vector(strides, force, row), -dt)
    dpn = dot(dp, normal)
    given, state = impulse(kind, mu, mu_static, dp, normal, dpn, gap)
    for d in range(len(strides)):
        momentum[row, d] += given[d]
        if stage == FIRST:
            grid.saved[row, d] = momentum[row, d]
        elif stage == UPDATE:
            force[row, d] += given[d] / dt
    rubbing = kind == FRICTIONAL and state != OPEN and stage == UPDATE
    work = work_of_friction(dp, pushed, given, normal, mass) if rubbing else 0.0
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


@kernel
def work_of_friction(dp, pushed, given, normal, reduced):
    """Return what friction takes (J): the tangential momentum given times the mean slip.

    Mean of the slip at the start of the step, before the other forces have pushed the rows apart by
    `pushed` (N s), and at its end: with the velocities of the two strain updates, as for tractions.
    """
    tangential = plus(given, -dot(given, normal), normal)
    slip = plus(plus(dp, -0.5, pushed), -0.5, given)
    return dot(tangential, slip) / reduced
