"""What a law answers.

Every law is written once, in 3D; the analysis fills in what a plane leaves open (geometry.py).

A law that remembers owns columns of `Particles.history`. It reads them as history[p, column] and
returns what they become; the caller writes that once the step is settled, for plane stress asks a
law several times. The first two columns mean the same in all laws (state/particles.py): energy
dissipated, equivalent plastic strain. The work of the stress less the energy dissipated is what the
law has stored, to round-off for the laws in rate form.
"""

from typing import NamedTuple

from cramp_cli.numerics.dispatch import generic


class Straining(NamedTuple):
    """What a step does to a particle."""

    turned: tuple  # Kirchhoff stress before the step, turned with the particle (six, Pa)
    dU: tuple  # step of the displacement gradient (4 or 9)
    F: tuple  # deformation gradient after the step, in the plane or the solid (4 or 9)
    stretch: float  # normal to a plane problem, before the step
    dt: float  # s
    across: float = 0.0  # strain of the step normal to the plane that the motion gives, in a ring


class Strained(NamedTuple):
    """What a law is told of a step: the same with all that a plane leaves open."""

    turned: tuple  # Kirchhoff stress before the step, turned with the particle (six, Pa)
    strain: tuple  # strain of the step, tensor shear (six)
    dU: tuple  # step of the displacement gradient (4 or 9): its spin turns what the law remembers
    F: tuple  # deformation gradient after the step (nine)
    dt: float  # s


@generic
def kirchhoff_stress(law, step, history, p):
    """Return the Kirchhoff stress at the end of a step, and what the history becomes.

    step: of Strained; history: (n, k), of which row p is this particle's and is only read
    returns: (xx, yy, zz, xy, yz, xz; Pa) and a tuple as long as the law's memory
    """


@generic
def memory(law):
    """Return how many columns of the history the law needs: none, or at least the common two."""


@generic
def confined_modulus(law):
    """Return the modulus of uniaxial strain for small strains (Pa), K + 4G/3 if isotropic.

    It sets the dilational wave speed; of an anisotropic law it is that of the fastest direction.
    """


@generic
def shear_modulus(law):
    """Return the shear modulus for small strains (Pa); nan where direction or time decide on it.

    Without it a crack tip has no K_I and K_II.
    """


@generic
def poisson_ratio(law):
    """Return Poisson's ratio for small strains; nan where direction or time decide on it."""


def same_law(a, b) -> bool:
    """Return whether two records are of one law with the same constants."""
    return type(a) is type(b) and a == b
