"""Contact between both sides of a crack, row against row (Nairn 2003, Bardenhagen et al. 2001)."""

from typing import NamedTuple

import numpy as np

from cramp_cli.cracks.rows import row_across
from cramp_cli.numerics.dispatch import by_length
from cramp_cli.numerics.kernel import inlined_kernel, kernel
from cramp_cli.numerics.vector import (
    dot,
    plus,
    times,
    vector,
)
from cramp_cli.shapes.shape import offsets, place_of, weights
from cramp_cli.transfer.rows import add

IGNORE, FRICTIONAL, STICK, GLUED, ADHESIVE = 0, 1, 2, 3, 4
LAWS = {
    "ignore": IGNORE,
    "frictional": FRICTIONAL,
    "stick": STICK,
    "glued": GLUED,
    "adhesive": ADHESIVE,  # of bodies alone: contact/adhesion.py
}

OPEN, SLIDING, STUCK = 0, 1, 2  # what a pair of rows does

FIRST, UPDATE, LAST = 0, 1, 2  # passes A, B, C: after the first sums, the update, the second sums


class ContactLaws(NamedTuple):
    """Law of every crack."""

    kind: np.ndarray  # (cracks,) IGNORE, FRICTIONAL, STICK or GLUED
    mu: np.ndarray  # (cracks,) coefficient of sliding friction
    mu_static: np.ndarray  # (cracks,) coefficient of static friction, not below mu


@kernel
def sum_displacement(rows, particles, stencil, shape, strides, lo, hi):
    """Add mass-weighted displacement and position of particles lo..hi to rows of shared nodes."""
    first, displacement, place = rows.first, rows.displacement, rows.place
    base, near = stencil.base, stencil.near
    entries, which, table, share = stencil.entries, stencil.which, stencil.table, stencil.share
    steps = offsets(strides, shape)
    for i in range(stencil.count[1]):
        p = stencil.around[i]
        if p < lo or p >= hi or not is_any_shared(first, base[p], steps):
            continue
        S = weights(place_of(shape, strides, stencil, p), shape)
        x, X = vector(strides, particles.position, p), vector(strides, particles.origin, p)
        m, u, line = particles.mass[p], plus(x, -1.0, X), near[p]
        if line < 0:
            for k in range(len(steps)):
                node = base[p] + steps[k]
                if first[node] >= 0:
                    add(displacement, node, m * S[k], u)
                    add(place, node, m * S[k], x)
            continue
        for e in range(entries[line]):
            k, row = which[line, e], table[line, e]
            if first[base[p] + steps[k]] >= 0:
                add(displacement, row, m * share[line, e] * S[k], u)
                add(place, row, m * share[line, e] * S[k], x)


@inlined_kernel
def is_any_shared(first, lowest, steps):
    """Return whether one of the nodes of a particle has several rows; lowest: the first of them."""
    shared = False
    for k in range(len(steps)):
        shared = shared or first[lowest + steps[k]] >= 0
    return shared


@by_length
def unit_normal(like, normal, e, slot):
    """Return the normal of an extra row across the crack in `slot`, from above to below."""


@unit_normal.implement(2)
def _(like, normal, e, slot):
    size = np.hypot(normal[e, slot, 0], normal[e, slot, 1])
    over = 1.0 / size if size > 0.0 else 0.0
    return (normal[e, slot, 0] * over, normal[e, slot, 1] * over)


@kernel
def impulse(kind, mu, mu_static, dp, n, dpn, gap):
    """Return the momentum that side a receives from side b, and whether the sides slide or stick.

    dp: momentum that would bring both to their common velocity; n: unit normal from a to b
    dpn: dp.n; gap: opening (m), negative where the sides overlap
    """
    if kind == GLUED:
        return dp, STUCK
    if gap >= 0.0 or dpn >= 0.0:
        return times(dp, 0.0), OPEN
    if kind == STICK:
        return dp, STUCK
    tangential = plus(dp, -dpn, n)
    size = np.sqrt(dot(tangential, tangential))
    if size <= -mu_static * dpn:
        return dp, STUCK
    return plus(times(n, dpn), -mu * dpn / size, tangential), SLIDING


@kernel
def momentum_to_meet(grid, a, b, strides, momentum):
    """Return the momentum that row a must get from row b so that both move alike.

    momentum: (rows, dim); or the forces, for the force that gives both the same acceleration
    """
    ma, mb = grid.mass[a], grid.mass[b]
    pa, pb = vector(strides, momentum, a), vector(strides, momentum, b)
    return plus(times(pb, ma / (ma + mb)), -(mb / (ma + mb)), pa)


@kernel
def touch_pair(grid, a, b, normal, gap, kind, mu, mu_static, strides, dt, stage):
    """Let rows a (above) and b (below) touch.

    returns: what they do, the work of friction (J), and the momentum that a got from b
    """
    mass, momentum, saved, force = grid.mass, grid.momentum, grid.saved, grid.force
    ma, mb = mass[a], mass[b]
    reduced = ma * (mb / (ma + mb))
    dp = momentum_to_meet(grid, a, b, strides, momentum)
    pushed = times(momentum_to_meet(grid, a, b, strides, force), dt)
    dpn = dot(dp, normal)
    given, state = impulse(kind, mu, mu_static, dp, normal, dpn, gap)
    for d in range(len(strides)):
        momentum[a, d] += given[d]
        momentum[b, d] -= given[d]
        if stage == FIRST:
            saved[a, d], saved[b, d] = momentum[a, d], momentum[b, d]
        elif stage == UPDATE:
            force[a, d] += given[d] / dt
            force[b, d] -= given[d] / dt
    rubbing = kind == FRICTIONAL and state != OPEN and stage == UPDATE
    work = work_of_friction(dp, pushed, given, normal, reduced) if rubbing else 0.0
    return state, work, given


@kernel
def gap_ahead(grid, a, b, normal, gap, strides, dt):
    """Return the opening between rows a and b at the end of the step if they do not touch (m)."""
    mass = grid.mass
    share_a, share_b = mass[a] / (mass[a] + mass[b]), mass[b] / (mass[a] + mass[b])
    pa, pb = vector(strides, grid.momentum, a), vector(strides, grid.momentum, b)
    fa, fb = vector(strides, grid.force, a), vector(strides, grid.force, b)
    dpn = dot(plus(times(pb, share_a), -share_b, pa), normal)
    dfn = dot(plus(times(fb, share_a), -share_b, fa), normal)
    return gap + (dpn - 0.5 * dfn * dt) * dt / (mass[a] * share_b)


@kernel
def work_of_friction(dp, pushed, given, normal, reduced):
    """Return what friction takes (J): the tangential momentum given times the mean slip.

    Mean of the slip at the start of the step, before the other forces have pushed the rows apart by
    `pushed` (N s), and at its end: with the velocities of the two strain updates, as for tractions.
    """
    tangential = plus(given, -dot(given, normal), normal)
    slip = plus(plus(dp, -0.5, pushed), -0.5, given)
    return dot(tangential, slip) / reduced


@kernel
def touch(grid, rows, laws, strides, dt, stage):
    """Contact between rows of a node that differ by one crack; return the work of friction (J).

    Pairs 0-1, 0-2 come before 1-3, 2-3 (rows of a node ascend by their cracks).
    """
    nodes = len(rows.first)
    friction = 0.0
    for i in range(rows.count[1]):
        node = rows.shared[i]
        for crossings in (1, 2):
            row = rows.first[node]
            while row >= 0:
                e = row - nodes
                if (rows.crack[e, 1] >= 0) == (crossings == 2):
                    for slot in range(crossings):
                        friction += touch_across(grid, rows, laws, strides, dt, stage, row, slot)
                row = rows.next[e]
    for i in range(rows.count[5]):
        friction += touch_sectors(grid, rows, laws, strides, dt, stage, i)
    return friction


@kernel
def touch_sectors(grid, rows, laws, strides, dt, stage, i):
    """Contact of pair `i` of sectors beside a junction (sectors.py)."""
    crack, a, b = rows.pair_crack[i], rows.pair[i, 0], rows.pair[i, 1]
    if laws.kind[crack] == IGNORE or min(grid.mass[a], grid.mass[b]) <= 0.0:
        return 0.0
    n = unit(vector(strides, rows.pair_normal, i))
    state, work = touch_rows(grid, rows, laws, crack, a, b, n, strides, dt, stage)
    rows.pair_touching[i] = state
    return work


@inlined_kernel
def unit(v):
    """Return a vector of length 1, or zero."""
    size = np.sqrt(dot(v, v))
    return times(v, 1.0 / size if size > 0.0 else 0.0)


@kernel
def touch_across(grid, rows, laws, strides, dt, stage, row, slot):
    """Contact of a row with the row on the other side of the crack in `slot`."""
    e = row - len(rows.first)
    crack = rows.owner[e, slot]
    if laws.kind[crack] == IGNORE:
        return 0.0
    partner = row_across(rows, e, slot)
    if partner < 0 or grid.mass[row] <= 0.0 or grid.mass[partner] <= 0.0:
        return 0.0
    a, b = (row, partner) if rows.side[e, slot] > 0 else (partner, row)
    n = unit_normal(strides, rows.normal, e, slot)
    state, work = touch_rows(grid, rows, laws, crack, a, b, n, strides, dt, stage)
    rows.touching[e, slot] = state
    return work


@kernel
def touch_rows(grid, rows, laws, crack, a, b, n, strides, dt, stage):
    """Let rows a (above) and b (below) touch by the law of a crack; n: unit normal from a to b.

    returns: what they do, and the work of friction (J)
    """
    apart = plus(
        times(vector(strides, rows.displacement, b), 1.0 / grid.mass[b]),
        -1.0 / grid.mass[a],
        vector(strides, rows.displacement, a),
    )
    gap = dot(apart, n)
    if stage == UPDATE:
        gap = gap_ahead(grid, a, b, n, gap, strides, dt)
    state, friction, _ = touch_pair(
        grid,
        a,
        b,
        n,
        gap,
        laws.kind[crack],
        laws.mu[crack],
        laws.mu_static[crack],
        strides,
        dt,
        stage,
    )
    return state, friction if stage == UPDATE else 0.0


@kernel
def touch_increment(increment, grid, rows, laws, strides):
    """Keep higher orders of the grid velocity (XPIC, FMPM) from undoing the contact of the update.

    Sides that touched in the update share the normal component of the increment, sides that stuck
    share all of it.

    increment: (rows, dim), m/s
    """
    for i in range(rows.count[1]):
        node = rows.shared[i]
        for crossings in (1, 2):
            row = rows.first[node]
            while row >= 0:
                e = row - len(rows.first)
                if (rows.crack[e, 1] >= 0) == (crossings == 2):
                    for slot in range(crossings):
                        share_increment(increment, grid.mass, rows, strides, row, slot)
                row = rows.next[e]
    for i in range(rows.count[5]):
        if rows.pair_touching[i] != OPEN:
            a, b, n = rows.pair[i, 0], rows.pair[i, 1], unit(vector(strides, rows.pair_normal, i))
            sliding = rows.pair_touching[i] == SLIDING
            share_between(increment, a, b, grid.mass[a], grid.mass[b], n, sliding, strides)


@kernel
def share_increment(increment, mass, rows, strides, row, slot):
    """Let a row and the one across the crack in `slot` share their increment as they touched."""
    e = row - len(rows.first)
    state = rows.touching[e, slot]
    partner = row_across(rows, e, slot)
    if state == 0 or partner < 0:
        return
    n = unit_normal(strides, rows.normal, e, slot)
    masses = (mass[row], mass[partner])
    share_between(increment, row, partner, *masses, n, state == SLIDING, strides)


@kernel
def share_between(increment, a, b, ma, mb, n, sliding, strides):
    """Let rows a and b share their increment by their masses, along n alone if they slide."""
    apart = plus(vector(strides, increment, b), -1.0, vector(strides, increment, a))
    if sliding:
        apart = times(n, dot(apart, n))
    share = mb / (ma + mb)
    for d in range(len(strides)):
        increment[a, d] += share * apart[d]
        increment[b, d] -= (1.0 - share) * apart[d]
