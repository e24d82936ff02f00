"""Isotropic elasticity with finite rotation.

Kirchhoff stress changes by the strain of the step after it has been turned with the particle
(hypoelastic; the same as linear elasticity while strains are small).
"""

from typing import NamedTuple

from cramp_cli.materials.law import (
    confined_modulus,
    kirchhoff_stress,
    memory,
    poisson_ratio,
    shear_modulus,
)


class Elastic(NamedTuple):
    """Lame constants (Pa)."""

    lame: float
    shear: float


@kirchhoff_stress.implement(Elastic)
def _(law, step, history, p):
    turned, strain = step.turned, step.strain
    pressure = law.lame * (strain[0] + strain[1] + strain[2])
    double = 2.0 * law.shear
    new = (
        turned[0] + pressure + double * strain[0],
        turned[1] + pressure + double * strain[1],
        turned[2] + pressure + double * strain[2],
        turned[3] + double * strain[3],
        turned[4] + double * strain[4],
        turned[5] + double * strain[5],
    )
    return new, ()


@memory.implement(Elastic)
def _(law):
    return 0


@confined_modulus.implement(Elastic)
def _(law):
    return law.lame + 2.0 * law.shear


@shear_modulus.implement(Elastic)
def _(law):
    return law.shear


@poisson_ratio.implement(Elastic)
def _(law):
    return 0.5 * law.lame / (law.lame + law.shear)
