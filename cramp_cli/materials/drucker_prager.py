"""Perfect plasticity of soil, rock and concrete: a cone with friction, cohesion and dilation.

f = sqrt(J2) + eta p - xi c with the mean stress p, tension positive; the potential of the plastic
flow has eta_flow in place of eta. De Souza Neto, Peric and Owen (2008), Computational Methods for
Plasticity, section 8.3; the apex is returned to along the mean stress.
"""

from math import sqrt
from typing import NamedTuple

from cramp_cli.materials.elastic import Elastic
from cramp_cli.materials.law import (
    confined_modulus,
    kirchhoff_stress,
    memory,
    poisson_ratio,
    shear_modulus,
)
from cramp_cli.numerics.symmetric import deviator, square_of, work_of
from cramp_cli.numerics.vector import added, scaled
from cramp_cli.state.particles import DISSIPATED, OWN, PLASTIC_STRAIN


class DruckerPrager(NamedTuple):
    """An elastic solid and its cone."""

    elastic: Elastic
    friction: float  # eta
    dilation: float  # eta of the flow, at most eta
    cohesion: float  # xi c, Pa


@kirchhoff_stress.implement(DruckerPrager)
def _(law, step, history, p):
    G = law.elastic.shear
    K = law.elastic.lame + 2.0 * G / 3.0
    spent, alpha = history[p, DISSIPATED], history[p, PLASTIC_STRAIN]
    trial, _ = kirchhoff_stress(law.elastic, step, history, p)
    s, mean = deviator(trial), (trial[0] + trial[1] + trial[2]) / 3.0
    root = sqrt(0.5 * square_of(s))
    f = root + law.friction * mean - law.cohesion
    if f <= 0.0:
        return trial, (spent, alpha)
    gamma = f / (G + K * law.friction * law.dilation)
    if G * gamma < root:
        left, volume = 1.0 - G * gamma / root, law.dilation * gamma
    else:  # the apex
        left, volume = 0.0, (mean - law.cohesion / law.friction) / K
    d, third, fall = scaled(s, 0.5 * (1.0 - left) / G), volume / 3.0, K * volume
    flow = (d[0] + third, d[1] + third, d[2] + third, d[3], d[4], d[5])
    new = added(trial, -2.0 * G, d)
    new = (new[0] - fall, new[1] - fall, new[2] - fall, new[3], new[4], new[5])
    sheared = sqrt(2.0 / 3.0 * square_of(d))
    return new, (spent + work_of(step.turned, new, flow), alpha + sheared)


@memory.implement(DruckerPrager)
def _(law):
    return OWN


@confined_modulus.implement(DruckerPrager)
def _(law):
    return confined_modulus(law.elastic)


@shear_modulus.implement(DruckerPrager)
def _(law):
    return shear_modulus(law.elastic)


@poisson_ratio.implement(DruckerPrager)
def _(law):
    return poisson_ratio(law.elastic)
