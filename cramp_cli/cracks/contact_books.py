"""What contact of crack faces takes from a body: by friction, and where faces meet.

A step keeps what its passes do to every pair of rows, and books it at its end: then the velocities
of the particles after the step are known (docs/theory/energy.md). Nothing is divided by a reduced
mass: relative velocities are differences of p/m, momenta are what they are.
"""

from cramp_cli.cracks.rows import row_across
from cramp_cli.numerics.dispatch import by_length
from cramp_cli.numerics.kernel import inlined_kernel, kernel
from cramp_cli.numerics.vector import (
    dot,
    plus,
    times,
    vector,
)

# what a step keeps of a pair: relative velocity before and after it (m/s), what passes A and C take
# off it (m/s), momentum given in pass B (N s), force that pushes the pair (N)
BEFORE, AFTER, HALTED, GIVEN, PUSHED = 0, 1, 2, 3, 4

LEAST = 1e-4  # share of the mass of two rows; a pair of which one holds less is not booked


@kernel
def momentum_to_meet(grid, a, b, strides, momentum):
    """Return the momentum that row a must get from row b so that both move alike.

    momentum: (rows, dim); or the forces, for the force that gives both the same acceleration
    """
    ma, mb = grid.mass[a], grid.mass[b]
    pa, pb = vector(strides, momentum, a), vector(strides, momentum, b)
    return plus(times(pb, ma / (ma + mb)), -(mb / (ma + mb)), pa)


@kernel
def parting(grid, a, b, strides, momentum):
    """Return the velocity of row b relative to row a (m/s): bounded where rows hold little.

    momentum: (rows, dim); or the forces, for an acceleration (m/s^2)
    """
    fast = times(vector(strides, momentum, b), 1.0 / grid.mass[b])
    return plus(fast, -1.0 / grid.mass[a], vector(strides, momentum, a))


@inlined_kernel
def is_light(mass, a, b):
    """Return whether one of two rows holds next to nothing beside the other (LEAST)."""
    return min(mass[a], mass[b]) < LEAST * (mass[a] + mass[b])


@kernel
def note_parting(grid, rows, strides, field, k):
    """Keep how fast the sides of all cracks part, or how they are pushed, before others act on it.

    k: BEFORE or AFTER, field: momentum; PUSHED, field: force. Of the forces the part is kept that
    a constraint between nodes (followers.py) has not spread yet: it is this that the strain feels.
    """
    for i in range(rows.count[1]):
        row = rows.first[rows.shared[i]]
        while row >= 0:
            e = row - len(rows.first)
            for slot in range(2):
                partner = row_across(rows, e, slot) if rows.crack[e, slot] >= 0 else -1
                if partner >= 0 and grid.mass[row] > 0.0 and grid.mass[partner] > 0.0:
                    a, b = (row, partner) if rows.side[e, slot] > 0 else (partner, row)
                    if k == PUSHED:
                        kept = momentum_to_meet(grid, a, b, strides, field)
                    else:
                        kept = parting(grid, a, b, strides, field)
                    for d in range(len(strides)):
                        rows.impulse[e, slot, k, d] = kept[d]
            row = rows.next[e]


@kernel
def taken(book, e, slot, slow, n, dt, again):
    """Return what contact takes from a pair in a step (J): by friction, and where faces meet.

    The particles feel the momentum given in the update at the mean of their relative velocities w
    before and after the step. The strain feels what the first and the last pass leave of them: the
    forces f, which push the pair, do not work on what was halted. So

        given.(w + w_end)/2 - f.(halted + halted_end) dt/2.

    Friction is the part of this along the faces. Without second sums w_end is what the update has
    left (slow), and the strain feels that.

    n: unit normal; again: whether there are second sums
    """
    w, halted = kept_of(slow, book, e, slot, BEFORE), kept_of(slow, book, e, slot, HALTED)
    given, pushed = kept_of(slow, book, e, slot, GIVEN), kept_of(slow, book, e, slot, PUSHED)
    w_end = kept_of(slow, book, e, slot, AFTER)
    if not again:
        pushed, w_end = times(given, 1.0 / dt), slow
    mean, halted = times(plus(w, 1.0, w_end), 0.5), times(halted, 0.5 * dt)
    across = dot(given, n) * dot(mean, n) - dot(pushed, n) * dot(halted, n)
    return dot(given, mean) - dot(pushed, halted) - across, across


@by_length
def kept_of(like, book, e, slot, k):
    """Return vector k of what is kept of a pair."""


@kept_of.implement(2)
def _(like, book, e, slot, k):
    return (book[e, slot, k, 0], book[e, slot, k, 1])
