"""Plane strain and plane stress: the strain normal to the plane that a plane leaves open."""

from typing import NamedTuple

from cramp_cli.materials.law import confined_modulus, kirchhoff_stress
from cramp_cli.numerics.dispatch import generic
from cramp_cli.numerics.tensor import solid_strain


class PlaneStrain(NamedTuple):
    """No strain normal to the plane."""

    thickness: float  # m


class PlaneStress(NamedTuple):
    """No stress normal to the plane."""

    thickness: float  # m


@generic
def strained(geometry, law, turned, dU):
    """Return strain of the step and stress after it (six components each).

    turned: stress before the step, turned with the particle (Pa)
    dU: step of the displacement gradient
    """


@generic
def is_plane_stress(geometry):
    """Return True for plane stress: E' is E, and kappa is (3 - nu)/(1 + nu)."""


@strained.implement(PlaneStrain)
def _(geometry, law, turned, dU):
    strain = solid_strain(dU, 0.0)
    return strain, kirchhoff_stress(law, turned, strain)


@strained.implement(PlaneStress)
def _(geometry, law, turned, dU):
    # Newton with the confined modulus: exact in one pass for a linear law, which starts from zero.
    zz = 0.0
    strain = solid_strain(dU, zz)
    stress = kirchhoff_stress(law, turned, strain)
    modulus = confined_modulus(law)
    for _ in range(20):
        zz -= stress[2] / modulus
        strain = solid_strain(dU, zz)
        stress = kirchhoff_stress(law, turned, strain)
        if abs(stress[2]) <= 1e-14 * modulus:
            break
    return strain, (stress[0], stress[1], 0.0, stress[3], stress[4], stress[5])


@is_plane_stress.implement(PlaneStrain)
def _(geometry):
    return False


@is_plane_stress.implement(PlaneStress)
def _(geometry):
    return True
