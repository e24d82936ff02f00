"""Ways back from the grid: FLIP, FMPM(k) with PIC as its first order, XPIC(k).

Nairn and Hammerquist (2021) for FMPM, Hammerquist and Nairn (2017) for XPIC. All keep position and
velocity consistent to second order: under a constant acceleration a particle falls exactly.
"""

from typing import NamedTuple

from cramp_cli.numerics.dispatch import generic
from cramp_cli.numerics.vector import plus, times


class Flip(NamedTuple):
    """Particles keep their velocity and receive the change seen by the grid."""

    order: int  # 1


class Fmpm(NamedTuple):
    """Particles take the grid velocity of order k; k = 1 is PIC."""

    order: int


class Xpic(NamedTuple):
    """Particles take the velocity of extended PIC of order k."""

    order: int


@generic
def moved(update, V, u, a, ag, ap, dt):
    """Return the velocity after the step and the mean velocity that moves the particle.

    V: particle velocity; u: grid velocity at the particle (of order k for FMPM and XPIC); a: grid
    acceleration at the particle; ag, ap: damping of grid and particle velocity (1/s)
    """


@moved.implement(Flip)
def _(update, V, u, a, ag, ap, dt):
    vm = plus(u, -dt, a)
    dV = plus(plus(times(a, dt), -ag * dt, vm), -ap * dt, V)
    return plus(V, 1.0, dV), plus(vm, 0.5, dV)


@moved.implement(Fmpm)
def _(update, V, u, a, ag, ap, dt):
    new = plus(plus(u, -ag * dt, u), -ap * dt, V)
    return new, times(plus(V, 1.0, new), 0.5)


@moved.implement(Xpic)
def _(update, V, u, a, ag, ap, dt):
    new = plus(plus(u, -ag * dt, u), -ap * dt, V)
    vm = plus(u, -dt, a)
    return new, plus(plus(vm, 0.5, new), -0.5, V)
