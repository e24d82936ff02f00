"""Linear viscoelasticity: springs and dashpots in parallel (Prony series), elastic in volume.

G(t) = G (1 - sum g_i (1 - exp(-t/tau_i))). Each branch remembers its stress h_i, which follows
exactly where the strain rate is constant over the step (Taylor, Pister and Goudreau 1970; Simo and
Hughes 1998, section 10.3).
"""

from math import exp, expm1, nan
from typing import NamedTuple

from cramp_cli.materials.elastic import Elastic
from cramp_cli.materials.law import (
    confined_modulus,
    kirchhoff_stress,
    memory,
    poisson_ratio,
    shear_modulus,
)
from cramp_cli.numerics.dispatch import by_length
from cramp_cli.numerics.symmetric import (
    deviator,
    six,
    turn,
    work_of,
)
from cramp_cli.numerics.vector import added, scaled
from cramp_cli.state.particles import DISSIPATED, OWN

NOTHING = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


class Viscoelastic(NamedTuple):
    """An elastic solid, of which part of the shear modulus relaxes."""

    elastic: Elastic  # of the first moment
    shares: tuple  # g_i, of the shear modulus
    times: tuple  # tau_i, s


@kirchhoff_stress.implement(Viscoelastic)
def _(law, step, history, p):
    trial, _ = kirchhoff_stress(law.elastic, step, history, p)
    lost, taken, branches = _relax(law.shares, law.times, law.elastic.shear, step, history, p, OWN)
    spent = history[p, DISSIPATED] + taken
    return added(trial, -1.0, lost), (spent, 0.0) + branches


@by_length
def _relax(shares, times, G, step, history, p, at):
    """Return stress and energy that the dashpots take in a step, and the stress of all branches."""
    x, double = step.dt / times[0], 2.0 * G * shares[0]
    h, e = turn(step.dU, six(step.dU, history, p, at)), deviator(step.strain)
    new = added(scaled(h, exp(-x)), -double * expm1(-x) / x, e)
    flow = added(e, -1.0 / double, added(new, -1.0, h))  # strain of the dashpot
    lost, taken, others = _relax(shares[1:], times[1:], G, step, history, p, at + 6)
    return added(lost, double, flow), taken + work_of(h, new, flow), new + others


@_relax.implement(0)
def _(shares, times, G, step, history, p, at):
    return NOTHING, 0.0, ()


@memory.implement(Viscoelastic)
def _(law):
    return OWN + 6 * len(law.shares)


@confined_modulus.implement(Viscoelastic)
def _(law):
    return confined_modulus(law.elastic)


@shear_modulus.implement(Viscoelastic)
def _(law):
    return nan  # another one at every moment


@poisson_ratio.implement(Viscoelastic)
def _(law):
    return nan
