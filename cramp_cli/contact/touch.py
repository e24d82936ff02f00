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
    lean = (pairs.beside[i], pairs.lean[i])
    if rigid[gb]:
        v = vector(strides, velocity, gb)
        state, work, given = push(grid, a, lean, v, n, gap, *law, strides, dt, stage)
    elif rigid[ga]:
        v = vector(strides, velocity, ga)
        state, work, given = push(grid, b, lean, v, times(n, -1.0), gap, *law, strides, dt, stage)
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
def push(grid, row, lean, velocity, normal, gap, kind, mu, mu_static, strides, dt, stage):
    """Let a row touch a rigid body; return what it does, the work of friction (J), its momentum.

    A rigid body is a partner of infinite mass. lean: the row of the next node if they touch in
    between, and its share; velocity: its own (m/s); normal: towards it

    Between two nodes moves what is (1 - s) v_row + s v_next; a momentum there is shared alike
    """
    nxt, mass, own, share = shares(grid, row, lean)
    v = between(grid.momentum, grid.mass, row, nxt, own, share, strides)
    pull = between(grid.force, grid.mass, row, nxt, own, share, strides)
    dp, pushed = times(plus(velocity, -1.0, v), mass), times(pull, -mass * dt)
    given, state = impulse(kind, mu, mu_static, dp, normal, dot(dp, normal), gap)
    give(grid, row, own, given, strides, dt, stage)
    if share > 0.0:
        give(grid, nxt, share, given, strides, dt, stage)
    rubbing = kind == FRICTIONAL and state != OPEN and stage == UPDATE
    work = work_of_friction(dp, pushed, given, normal, mass) if rubbing else 0.0
    return state, work, given


@kernel
def shares(grid, row, lean):
    """Return the next row, the mass that a place between two rows feels (kg), and both shares."""
    nxt, share = lean
    if nxt < 0 or grid.mass[nxt] <= 0.0:
        return row, grid.mass[row], 1.0, 0.0
    own = 1.0 - share
    return nxt, 1.0 / (own * own / grid.mass[row] + share * share / grid.mass[nxt]), own, share


@kernel
def between(values, mass, row, nxt, own, share, strides):
    """Return values per mass, (rows, dim), at a place between two rows that have these shares."""
    first = times(vector(strides, values, row), own / mass[row])
    return plus(first, share / mass[nxt], vector(strides, values, nxt))


@kernel
def give(grid, row, share, given, strides, dt, stage):
    """Give a row its share of a momentum, and what a pass of contact keeps of it."""
    momentum, force = grid.momentum, grid.force
    for d in range(len(strides)):
        momentum[row, d] += share * given[d]
        if stage == FIRST:
            grid.saved[row, d] = momentum[row, d]
        elif stage == UPDATE:
            force[row, d] += share * given[d] / dt


@kernel
def touch_increments(increment, grid, pairs, rigid, strides):
    """Keep higher orders of the grid velocity from undoing the contact of the update.

    increment: (rows, dim), m/s; as in cracks/contact.py, a rigid body has none
    """
    for i in range(pairs.used[0]):
        a, b, state = pairs.row[i, 0], pairs.row[i, 1], pairs.state[i]
        n, lean = vector(strides, pairs.normal, i), (pairs.beside[i], pairs.lean[i])
        if state == OPEN:
            continue
        if rigid[pairs.group[i, 0]]:
            stop_increment(increment, grid, b, lean, n, state == SLIDING, strides)
        elif rigid[pairs.group[i, 1]]:
            stop_increment(increment, grid, a, lean, n, state == SLIDING, strides)
        else:
            share_between(increment, a, b, grid.mass[a], grid.mass[b], n, state == SLIDING, strides)


@kernel
def stop_increment(increment, grid, row, lean, n, sliding, strides):
    """Take from rows (and the next) the increment (m/s) where they touch a rigid body."""
    nxt, mass, own, share = shares(grid, row, lean)
    left = times(vector(strides, increment, row), own)
    left = plus(left, share, vector(strides, increment, nxt))
    if sliding:
        left = times(n, dot(left, n))
    for d in range(len(strides)):
        increment[row, d] -= own * mass / grid.mass[row] * left[d]
        if share > 0.0:
            increment[nxt, d] -= share * mass / grid.mass[nxt] * left[d]


@kernel
def work_of_friction(dp, pushed, given, normal, reduced):
    """Return what friction takes (J): the tangential momentum given times the mean slip.

    Mean of the slip at the start of the step, before the other forces have pushed the rows apart by
    `pushed` (N s), and at its end: with the velocities of the two strain updates, as for tractions.
    """
    tangential = plus(given, -dot(given, normal), normal)
    slip = plus(plus(dp, -0.5, pushed), -0.5, given)
    return dot(tangential, slip) / reduced
