"""Rubber, the nearly incompressible Mooney-Rivlin solid.

W = C10 (I1 - 3) + C01 (I2 - 3) + K/2 ((J^2 - 1)/2 - ln J) with I1, I2 of J^(-2/3) b (Mooney 1940;
Rivlin 1948; split as in Simo and Hughes 1998, section 9.2). The Kirchhoff stress is
2 C10 dev bb + 2 C01 dev(I1 bb - bb^2) + K/2 (J^2 - 1) 1 with bb = J^(-2/3) b.
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
from cramp_cli.numerics.symmetric import deviator, left_cauchy_green, squared
from cramp_cli.numerics.vector import added, scaled


class MooneyRivlin(NamedTuple):
    """Constants of the two invariants, and the bulk modulus (Pa)."""

    C10: float
    C01: float
    bulk: float


@kirchhoff_stress.implement(MooneyRivlin)
def _(law, step, history, p):
    J = determinant(step.F)
    b = scaled(left_cauchy_green(step.F), J ** (-2.0 / 3.0))
    I1 = b[0] + b[1] + b[2]
    s = deviator(added(scaled(b, 2.0 * (law.C10 + law.C01 * I1)), -2.0 * law.C01, squared(b)))
    mean = 0.5 * law.bulk * (J * J - 1.0)
    return (s[0] + mean, s[1] + mean, s[2] + mean, s[3], s[4], s[5]), ()


@memory.implement(MooneyRivlin)
def _(law):
    return 0


@confined_modulus.implement(MooneyRivlin)
def _(law):
    return law.bulk + 8.0 * (law.C10 + law.C01) / 3.0


@shear_modulus.implement(MooneyRivlin)
def _(law):
    return 2.0 * (law.C10 + law.C01)


@poisson_ratio.implement(MooneyRivlin)
def _(law):
    G = 2.0 * (law.C10 + law.C01)
    return (3.0 * law.bulk - 2.0 * G) / (6.0 * law.bulk + 2.0 * G)
