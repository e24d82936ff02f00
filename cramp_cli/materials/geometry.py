"""Plane strain, plane stress, rings: the strain normal to the plane that a plane leaves open."""

from math import nan, pi
from typing import NamedTuple

from cramp_cli.materials.law import Strained, confined_modulus, kirchhoff_stress
from cramp_cli.numerics.dispatch import generic
from cramp_cli.numerics.kernel import inlined_kernel
from cramp_cli.numerics.matrix import solid_matrix
from cramp_cli.numerics.symmetric import solid_strain

PASSES = 50
SETTLED = 1e-14  # normal stress that is none, in confined moduli
ROUND_OFF = 1e-10  # the least a stiff solid under large strain may be left with
FLATTEST = 0.05  # least slope of the normal stress that is trusted, in confined moduli


class PlaneStrain(NamedTuple):
    """No strain normal to the plane."""

    thickness: float  # m


class PlaneStress(NamedTuple):
    """No stress normal to the plane."""

    thickness: float  # m


class Axisymmetric(NamedTuple):
    """A body of revolution: x is the radius, y the axis; every particle is a whole ring.

    The strain normal to the plane is v_r/r, found with the velocity gradient.
    """

    circumference: float = 2.0 * pi  # of the ring of radius 1


@generic
def strained(geometry, law, step, history, p):
    """Return the strain of a step, the stress after it (six each), and what the history becomes.

    step: of Straining
    """


@generic
def rate_across(geometry, L, p):
    """Return the strain rate normal to the plane that motion gives a particle (1/s).

    L: (n, 4), (n, 9), or in rings (n, 5): velocity gradients
    """


@generic
def depth(geometry, x):
    """Return how deep the body is behind the plane at x (m): numbers or arrays."""


@generic
def is_plane_stress(geometry):
    """Return True for plane stress: E' is E, and kappa is (3 - nu)/(1 + nu)."""


@strained.implement(PlaneStrain)
def _(geometry, law, step, history, p):
    whole = _completed(step, 0.0)
    stress, past = kirchhoff_stress(law, whole, history, p)
    return whole.strain, stress, past


@strained.implement(Axisymmetric)
def _(geometry, law, step, history, p):
    whole = _completed(step, step.across)
    stress, past = kirchhoff_stress(law, whole, history, p)
    return whole.strain, stress, past


@strained.implement(PlaneStress)
def _(geometry, law, step, history, p):
    # The first pass is exact for an isotropic linear law; others go on with secants.
    zz = 0.0
    whole = _completed(step, zz)
    stress, past = kirchhoff_stress(law, whole, history, p)
    modulus = confined_modulus(law)
    slope = modulus
    for _ in range(PASSES):
        before, change = stress[2], -stress[2] / slope
        zz += change
        whole = _completed(step, zz)
        stress, past = kirchhoff_stress(law, whole, history, p)
        if abs(stress[2]) <= SETTLED * modulus:
            break
        slope = max((stress[2] - before) / change, FLATTEST * modulus)
    rest = 0.0 if abs(stress[2]) <= ROUND_OFF * modulus else nan  # nan: the run ends with a message
    return whole.strain, (stress[0], stress[1], rest, stress[3], stress[4], stress[5]), past


@inlined_kernel
def _completed(step, zz):
    """Return the step with the strain `zz` normal to a plane problem."""
    strain = solid_strain(step.dU, zz)
    F = solid_matrix(step.F, step.stretch * (1.0 + zz + 0.5 * zz * zz))
    return Strained(step.turned, strain, step.dU, F, step.dt)


@is_plane_stress.implement(PlaneStrain)
def _(geometry):
    return False


@is_plane_stress.implement(Axisymmetric)
def _(geometry):
    return False


@is_plane_stress.implement(PlaneStress)
def _(geometry):
    return True


@rate_across.implement(PlaneStrain)
def _(geometry, L, p):
    return 0.0


@rate_across.implement(PlaneStress)
def _(geometry, L, p):
    return 0.0


@rate_across.implement(Axisymmetric)
def _(geometry, L, p):
    return L[p, 4]


@depth.implement(PlaneStrain)
def _(geometry, x):
    return geometry.thickness + 0.0 * x


@depth.implement(PlaneStress)
def _(geometry, x):
    return geometry.thickness + 0.0 * x


@depth.implement(Axisymmetric)
def _(geometry, x):
    return geometry.circumference * x
