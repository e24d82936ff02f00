"""Elasticity with three planes of symmetry: wood, composites. Transverse isotropy is a case of it.

As elastic.py, with the strain of the step taken to the axes of the particle: turned by the rotation
of its deformation gradient from where the deck has put them. Energy is kept to second order in the
strain, as by all hypoelastic laws; meant for small strains and any rotation.
"""

from math import nan
from typing import NamedTuple

from cramp_cli.materials.law import (
    confined_modulus,
    kirchhoff_stress,
    memory,
    poisson_ratio,
    shear_modulus,
)
from cramp_cli.numerics.matrix import product, rotation_of, transposed
from cramp_cli.numerics.symmetric import congruent
from cramp_cli.numerics.vector import added


class Orthotropic(NamedTuple):
    """Stiffness in the axes 1, 2, 3 of the material (Pa), and how they lie at the start."""

    C11: float
    C22: float
    C33: float
    C12: float
    C23: float
    C13: float
    G12: float
    G23: float
    G13: float
    axes: tuple  # rotation matrix: its columns are the axes (nine)
    confined: float  # of the fastest wave of all directions, Pa


@kirchhoff_stress.implement(Orthotropic)
def _(law, step, history, p):
    R = product(rotation_of(step.F), law.axes)
    e = congruent(transposed(R), step.strain)
    s = (
        law.C11 * e[0] + law.C12 * e[1] + law.C13 * e[2],
        law.C12 * e[0] + law.C22 * e[1] + law.C23 * e[2],
        law.C13 * e[0] + law.C23 * e[1] + law.C33 * e[2],
        2.0 * law.G12 * e[3],
        2.0 * law.G23 * e[4],
        2.0 * law.G13 * e[5],
    )
    return added(step.turned, 1.0, congruent(R, s)), ()


@memory.implement(Orthotropic)
def _(law):
    return 0


@confined_modulus.implement(Orthotropic)
def _(law):
    return law.confined


@shear_modulus.implement(Orthotropic)
def _(law):
    return nan


@poisson_ratio.implement(Orthotropic)
def _(law):
    return nan
