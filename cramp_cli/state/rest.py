"""How fast the slowest motion of the solid swings, and what drag lets it come to rest soonest."""

from math import inf, pi, sqrt
from typing import NamedTuple

import numpy as np

from cramp_cli.numerics.kernel import kernel

# Drag over twice the frequency of `swing`, which is up to 1.4 times that of the slowest mode: the
# shape under a static load is not quite that of the mode. On seven static decks 0.7 comes to rest
# first, in 0.7 to 0.95 of the time that 1 takes.
CRITICAL = 0.7
LARGEST = 0.2  # drag times the time step: all is fast while a load has reached a few particles


class Rest(NamedTuple):
    """What a deck says about coming to rest."""

    auto: bool = False  # the drag on particles is found while running
    watched: bool = False  # there is drag: whether K has settled is looked after
    stops: bool = False  # the run ends when all is at rest
    loads_until: float = inf  # from then on no load and no prescribed motion changes (s)


class Swing(NamedTuple):
    """How the solid moves now."""

    frequency: float  # of its slowest motion (rad/s)
    kinetic: float  # J
    strained: float  # work of all stresses so far (J)
    volume: float  # m^3


@kernel
def sum_by_body(particles, sums, lo, hi):
    """Add inertia of the displacement, kinetic energy, work and volume of particles lo..hi.

    sums: (bodies, 4) m u.u (kg m^2), J, J, m^3. Body by body: what one gives hangs on no other.
    """
    x, X, v = particles.position, particles.origin, particles.velocity
    for p in range(lo, hi):
        moved, square = 0.0, 0.0
        for d in range(x.shape[1]):
            moved += (x[p, d] - X[p, d]) ** 2
            square += v[p, d] * v[p, d]
        line = particles.body[p]
        sums[line, 0] += particles.mass[p] * moved
        sums[line, 1] += 0.5 * particles.mass[p] * square
        sums[line, 2] += particles.work[p] * particles.volume[p]
        sums[line, 3] += particles.volume[p]


def swing(model, state) -> Swing:
    """Return how the solid swings.

    Rayleigh's quotient of the displacement from the start, omega^2 = 2 W / sum m u.u: a load
    brings forth a shape near that of the slowest mode it can excite. (Underwood 1983 takes this
    quotient with a stiffness of every node; the work of the stresses is at hand, and holds contact
    and cracks that open.) A motion slower than the run could not come to rest within it.
    """
    sums = np.zeros((len(model.groups.of_body), 4))
    for block in model.blocks:
        if block.law is not None:
            sum_by_body(state.particles, sums, block.lo, block.hi)
    inertia, kinetic, strained, volume = (sum(column) for column in sums.T.tolist())
    slowest = 2.0 * pi / model.end_time
    fastest = max(LARGEST / (2.0 * CRITICAL * model.dt), slowest)
    known = inertia > 0.0 and strained > 0.0
    frequency = sqrt(2.0 * strained / inertia) if known else slowest
    return Swing(min(max(frequency, slowest), fastest), kinetic, strained, volume)


def near_critical(frequency: float) -> float:
    """Return the drag on particles (1/s) that brings a motion of this frequency (rad/s) to rest."""
    return 2.0 * CRITICAL * frequency


def stretch_of(frequency: float, drag: float) -> float:
    """Return the time (s) in which a motion shows whether it has settled.

    frequency: rad/s; drag: 1/s. A period; beyond critical drag the time in which a slow creep falls
    by the factor e, if that is longer.
    """
    half, period = 0.5 * drag, 2.0 * pi / frequency
    if half <= frequency:
        return period
    return max(period, 1.0 / (half - sqrt(half * half - frequency * frequency)))
