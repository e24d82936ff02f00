"""Isotropic plasticity of metals: von Mises yield, radial return, isotropic hardening.

Simo and Hughes (1998), Computational Inelasticity, box 3.2, on the stress that elastic.py gives.
"""

from math import sqrt
from typing import Any, NamedTuple

from cramp_cli.materials.elastic import Elastic
from cramp_cli.materials.hardening import yield_stress
from cramp_cli.materials.law import (
    confined_modulus,
    kirchhoff_stress,
    memory,
    poisson_ratio,
    shear_modulus,
)
from cramp_cli.numerics.kernel import inlined_kernel
from cramp_cli.numerics.symmetric import deviator, square_of, work_of
from cramp_cli.numerics.vector import added, scaled
from cramp_cli.state.particles import DISSIPATED, OWN, PLASTIC_STRAIN

PASSES = 100
EXACT = 1e-13  # distance from the yield surface that is none, in stresses


class J2Plastic(NamedTuple):
    """An elastic solid that yields."""

    elastic: Elastic
    hardening: Any  # a record of hardening.py


@kirchhoff_stress.implement(J2Plastic)
def _(law, step, history, p):
    trial, _ = kirchhoff_stress(law.elastic, step, history, p)
    spent, alpha = history[p, DISSIPATED], history[p, PLASTIC_STRAIN]
    s = deviator(trial)
    q = sqrt(1.5 * square_of(s))
    if q <= yield_stress(law.hardening, alpha, 0.0, spent):
        return trial, (spent, alpha)
    gamma = _plastic_step(law, q, alpha, spent, step.dt)
    flow = scaled(s, 1.5 * gamma / q)
    new = added(trial, -2.0 * law.elastic.shear, flow)
    return new, (spent + work_of(step.turned, new, flow), alpha + gamma)


@inlined_kernel
def _plastic_step(law, q, alpha, spent, dt):
    """Return the plastic strain that brings q - 3G gamma down to the yield stress.

    Regula falsi after Illinois (Dowell and Jarratt 1971): exact at once for linear hardening, and
    needs no slope, which a power law does not have at zero strain.
    """
    triple = 3.0 * law.elastic.shear
    low, above = 0.0, q - yield_stress(law.hardening, alpha, 0.0, spent)
    high = q / triple
    below = -yield_stress(law.hardening, alpha + high, high / dt, spent)
    gamma, side = high, 0
    for number in range(PASSES):
        if number % 3 == 2:  # for the logarithm of a rate, whose root may lie far down
            gamma = 0.5 * (low + high)
        else:
            gamma = (low * below - high * above) / (below - above)
        rest = q - triple * gamma - yield_stress(law.hardening, alpha + gamma, gamma / dt, spent)
        if abs(rest) <= EXACT * q:
            break
        if rest < 0.0:  # an end that stays twice counts half
            above *= 0.5 if side < 0 else 1.0
            high, below, side = gamma, rest, -1
        else:
            below *= 0.5 if side > 0 else 1.0
            low, above, side = gamma, rest, 1
    return gamma


@memory.implement(J2Plastic)
def _(law):
    return OWN


@confined_modulus.implement(J2Plastic)
def _(law):
    return confined_modulus(law.elastic)


@shear_modulus.implement(J2Plastic)
def _(law):
    return shear_modulus(law.elastic)


@poisson_ratio.implement(J2Plastic)
def _(law):
    return poisson_ratio(law.elastic)
