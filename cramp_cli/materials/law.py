"""What a law answers.

Every law is written once, in 3D; the analysis fills in what a plane leaves open.
"""

from cramp_cli.numerics.dispatch import generic


@generic
def kirchhoff_stress(law, turned, strain):
    """Return the Kirchhoff stress (xx, yy, zz, xy, yz, xz; Pa) at the end of a step.

    turned: stress before the step, turned with the particle (Pa)
    strain: strain of the step, tensor shear
    """


@generic
def confined_modulus(law):
    """Return the modulus of uniaxial strain, K + 4G/3 (Pa): it sets the dilational wave speed."""


@generic
def shear_modulus(law):
    """Return the shear modulus for small strains (Pa)."""


@generic
def poisson_ratio(law):
    """Return Poisson's ratio for small strains."""


def same_law(a, b) -> bool:
    """Return whether two records are of one law with the same constants."""
    return type(a) is type(b) and a == b
