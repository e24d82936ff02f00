"""Contact between both sides of a crack, row against row (Nairn 2003, Bardenhagen et al. 2001)."""

from typing import NamedTuple

import numpy as np

from cramp_cli.cracks.contact_books import (
    GIVEN,
    HALTED,
    is_light,
    momentum_to_meet,
    parting,
    taken,
)
from cramp_cli.cracks.openings import apart
from cramp_cli.cracks.rows import row_across
from cramp_cli.numerics.dispatch import by_length
from cramp_cli.numerics.kernel import inlined_kernel, kernel
from cramp_cli.numerics.vector import (
    dot,
    plus,
    times,
    vector,
)

IGNORE, FRICTIONAL, STICK, GLUED, ADHESIVE = 0, 1, 2, 3, 4
LAWS = {
    "ignore": IGNORE,
    "frictional": FRICTIONAL,
    "stick": STICK,
    "glued": GLUED,
    "adhesive": ADHESIVE,  # of bodies alone: contact/adhesion.py
}

FELT = 0.05  # share of the mass of two rows from which a row's forces count in full
OPEN, SLIDING, STUCK = 0, 1, 2  # what a pair of rows does

FIRST, UPDATE, LAST = 0, 1, 2  # passes A, B, C: after the first sums, the update, the second sums


class ContactLaws(NamedTuple):
    """Law of every crack."""

    kind: np.ndarray  # (cracks,) IGNORE, FRICTIONAL, STICK or GLUED
    mu: np.ndarray  # (cracks,) coefficient of sliding friction
    mu_static: np.ndarray  # (cracks,) coefficient of static friction, not below mu


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
def touch_pair(grid, a, b, normal, gap, law, strides, dt, stage):
    """Let rows a (above) and b (below) touch.

    law: kind, mu, mu_static

    returns: what they do, and the momentum that a got from b
    """
    momentum, saved, force = grid.momentum, grid.saved, grid.force
    kind, mu, mu_static = law
    dp = momentum_to_meet(grid, a, b, strides, momentum)
    given, state = impulse(kind, mu, mu_static, dp, normal, dot(dp, normal), gap)
    for d in range(len(strides)):
        momentum[a, d] += given[d]
        momentum[b, d] -= given[d]
        if stage == FIRST:
            saved[a, d], saved[b, d] = momentum[a, d], momentum[b, d]
        elif stage == UPDATE:
            force[a, d] += given[d] / dt
            force[b, d] -= given[d] / dt
    return state, given


@kernel
def gap_ahead(grid, a, b, normal, gap, strides, dt):
    """Return the opening between rows a and b at the end of the step if nothing pushes them (m).

    The forces count: faces that are pressed together must not let go for a step, or friction lets
    them creep. They do not where a row holds little: its f/m has no bound, particles hardly feel
    it, and faces that are open would meet.
    """
    share = min(grid.mass[a], grid.mass[b]) / (grid.mass[a] + grid.mass[b])
    felt = 0.5 * dt * dt * min(share / FELT, 1.0)
    speed = parting(grid, a, b, strides, grid.saved)
    pull = parting(grid, a, b, strides, grid.force)
    ahead = plus(times(speed, dt), felt, pull)
    return gap + dot(ahead, normal)


@kernel
def touch(grid, rows, laws, share, strides, dt, stage, book_at):
    """Contact between rows of a node that differ by one crack; return what it takes (J).

    Pairs 0-1, 0-2 come before 1-3, 2-3 (rows of a node ascend by their cracks).

    share: (nodes,) of a node's sums that are the body's own, less than 1 at symmetry planes
    book_at: pass in which all that the passes of a step take is told: LAST, or UPDATE without it
    returns: work of friction, loss of impacts
    """
    nodes = len(rows.first)
    friction, impact, how = 0.0, 0.0, (strides, dt, stage, book_at)
    for i in range(rows.count[1]):
        node = rows.shared[i]
        for crossings in (1, 2):
            row = rows.first[node]
            while row >= 0:
                e = row - nodes
                if (rows.crack[e, 1] >= 0) == (crossings == 2):
                    for slot in range(crossings):
                        rubbed, lost = touch_across(grid, rows, laws, *how, row, slot)
                        friction += share[node] * rubbed
                        impact += share[node] * lost
                row = rows.next[e]
    for i in range(rows.count[5]):
        rubbed, lost = touch_sectors(grid, rows, laws, strides, dt, stage, i)
        above = rows.pair[i, 0]
        own = share[above if above < nodes else rows.node[above - nodes]]
        friction += own * rubbed
        impact += own * lost
    return friction, impact


@kernel
def touch_sectors(grid, rows, laws, strides, dt, stage, i):
    """Contact of pair `i` of sectors beside a junction (sectors.py).

    What it takes is told by the velocities before and after the step, without those of the strain.
    """
    crack, a, b = rows.pair_crack[i], rows.pair[i, 0], rows.pair[i, 1]
    kind = laws.kind[crack]
    if kind == IGNORE or min(grid.mass[a], grid.mass[b]) <= 0.0:
        return 0.0, 0.0
    n = unit(vector(strides, rows.pair_normal, i))
    before = parting(grid, a, b, strides, grid.saved)
    state, given = touch_rows(grid, rows, laws, crack, a, b, n, strides, dt, stage)
    rows.pair_touching[i] = state
    if stage != UPDATE or is_light(grid.mass, a, b):
        return 0.0, 0.0
    mean = times(plus(before, 1.0, parting(grid, a, b, strides, grid.momentum)), 0.5)
    across = dot(given, n) * dot(mean, n)
    along = dot(given, mean) - across
    return (along, across) if kind == FRICTIONAL else (0.0, along + across)


@inlined_kernel
def unit(v):
    """Return a vector of length 1, or zero."""
    size = np.sqrt(dot(v, v))
    return times(v, 1.0 / size if size > 0.0 else 0.0)


@kernel
def touch_across(grid, rows, laws, strides, dt, stage, book_at, row, slot):
    """Contact of a row with the row on the other side of the crack in `slot`."""
    e = row - len(rows.first)
    crack = rows.owner[e, slot]
    kind = laws.kind[crack]
    if kind == IGNORE:
        return 0.0, 0.0
    partner = row_across(rows, e, slot)
    if partner < 0 or grid.mass[row] <= 0.0 or grid.mass[partner] <= 0.0:
        return 0.0, 0.0
    a, b = (row, partner) if rows.side[e, slot] > 0 else (partner, row)
    n = unit_normal(strides, rows.normal, e, slot)
    fast = parting(grid, a, b, strides, grid.momentum)
    state, given = touch_rows(grid, rows, laws, crack, a, b, n, strides, dt, stage)
    rows.touching[e, slot] = state
    slow, book = parting(grid, a, b, strides, grid.momentum), rows.impulse
    for d in range(len(strides)):
        if stage == UPDATE:
            book[e, slot, GIVEN, d] = given[d]
        else:
            book[e, slot, HALTED, d] += fast[d] - slow[d]
    if stage != book_at or is_light(grid.mass, a, b):
        return 0.0, 0.0
    rubbed, lost = taken(book, e, slot, slow, n, dt, stage == LAST)
    return (rubbed, lost) if kind == FRICTIONAL else (0.0, rubbed + lost)


@kernel
def touch_rows(grid, rows, laws, crack, a, b, n, strides, dt, stage):
    """Let rows a (above) and b (below) touch by the law of a crack; n: unit normal from a to b.

    returns: what they do, and the momentum that a got from b
    """
    opening, flush = apart(rows, a, b, strides)
    gap = dot(opening, n) - flush
    if stage == UPDATE:
        gap = gap_ahead(grid, a, b, n, gap, strides, dt)
    law = (laws.kind[crack], laws.mu[crack], laws.mu_static[crack])
    return touch_pair(grid, a, b, n, gap, law, strides, dt, stage)


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
