"""Rubber, the compressible neo-Hookean solid.

W = G/2 (tr b - 3 - 2 ln J) + lambda/2 ((J^2 - 1)/2 - ln J): Simo and Pister (1984) with the volume
term that NairnMPM uses; tau = G (b - 1) + lambda/2 (J^2 - 1) 1.
"""

from typing import NamedTuple

from cramp_cli.materials.law import (
    confined_modulus,
    kirchhoff_stress,
    memory,
    poisson_ratio,
    shear_modulus,
)
from cramp_cli.numerics.matrix import determinant
from cramp_cli.numerics.symmetric import left_cauchy_green


class NeoHookean(NamedTuple):
    """Lame constants of small strains (Pa)."""

    lame: float
    shear: float


@kirchhoff_stress.implement(NeoHookean)
def _(law, step, history, p):
    G, J, b = law.shear, determinant(step.F), left_cauchy_green(step.F)
    pressure = 0.5 * law.lame * (J * J - 1.0) - G
    tau = (
        G * b[0] + pressure,
        G * b[1] + pressure,
        G * b[2] + pressure,
        G * b[3],
        G * b[4],
        G * b[5],
    )
    return tau, ()


@memory.implement(NeoHookean)
def _(law):
    return 0


@confined_modulus.implement(NeoHookean)
def _(law):
    return law.lame + 2.0 * law.shear


@shear_modulus.implement(NeoHookean)
def _(law):
    return law.shear


@poisson_ratio.implement(NeoHookean)
def _(law):
    return 0.5 * law.lame / (law.lame + law.shear)
