"""From a material of a deck to the record of its law."""

from functools import singledispatch
from math import cos, radians, sin, sqrt, tan

import numpy as np

from cramp_cli.deck import hardening as rises
from cramp_cli.deck import materials as deck
from cramp_cli.materials.drucker_prager import DruckerPrager
from cramp_cli.materials.elastic import Elastic
from cramp_cli.materials.hardening import (
    JohnsonCook,
    LinearHardening,
    PowerHardening,
    VoceHardening,
)
from cramp_cli.materials.j2_plastic import J2Plastic
from cramp_cli.materials.mooney_rivlin import MooneyRivlin
from cramp_cli.materials.neo_hookean import NeoHookean
from cramp_cli.materials.orthotropic import Orthotropic
from cramp_cli.materials.viscoelastic import Viscoelastic

DIRECTIONS = 361  # of waves, over half a turn


@singledispatch
def law_of(section):
    """Return the record of the law that a section of `materials` describes."""
    raise TypeError(f"no law for {type(section).__name__}")


@law_of.register
def _(section: deck.ElasticSection):
    return Elastic(section.lame, section.shear)


@law_of.register
def _(section: deck.NeoHookeanSection):
    return NeoHookean(section.lame, section.shear)


@law_of.register
def _(section: deck.MooneyRivlinSection):
    return MooneyRivlin(section.C10, section.C01, section.K)


@law_of.register
def _(section: deck.ViscoelasticSection):
    shares, times = zip(*((part.share, part.time) for part in section.prony), strict=True)
    return Viscoelastic(Elastic(section.lame, section.shear), shares, times)


@law_of.register
def _(section: deck.DruckerPragerSection):
    friction, cohesion = cone(section.match, radians(section.friction_angle))
    dilation, _ = cone(section.match, radians(section.dilation_angle))
    elastic = Elastic(section.lame, section.shear)
    return DruckerPrager(elastic, friction, dilation, cohesion * section.cohesion)


def cone(match: str, angle: float) -> tuple[float, float]:
    """Return eta and xi of a friction angle (rad).

    De Souza Neto, Peric and Owen (2008), section 6.4.
    """
    if match == "plane_strain":
        root = sqrt(9.0 + 12.0 * tan(angle) ** 2)
        return 3.0 * tan(angle) / root, 3.0 / root
    sign = -1.0 if match == "compression" else 1.0
    scale = 6.0 / (sqrt(3.0) * (3.0 + sign * sin(angle)))
    return scale * sin(angle), scale * cos(angle)


@law_of.register
def _(section: deck.J2PlasticSection):
    elastic = Elastic(section.lame, section.shear)
    return J2Plastic(elastic, hardening_of(section.hardening, section.density))


@singledispatch
def hardening_of(section, density: float):
    """Return the record of a hardening; density (kg/m^3) turns energy into heat."""
    raise TypeError(f"no hardening for {type(section).__name__}")


@hardening_of.register
def _(section: rises.LinearHardeningSection, density):
    return LinearHardening(section.yield_stress, section.modulus)


@hardening_of.register
def _(section: rises.PowerHardeningSection, density):
    return PowerHardening(section.yield_stress, section.strain, section.exponent)


@hardening_of.register
def _(section: rises.VoceHardeningSection, density):
    return VoceHardening(section.yield_stress, section.saturation, section.strain)


@hardening_of.register
def _(section: rises.JohnsonCookSection, density):
    start = heating = 0.0
    if section.melt is not None:
        span = section.melt - section.room
        start = (section.started - section.room) / span
        if section.specific_heat is not None:
            heating = section.heated / (density * section.specific_heat * span)
    rate = (section.C, section.rate)
    return JohnsonCook(section.A, section.B, section.n, *rate, section.m, start, heating)


@law_of.register
def _(section: deck.TransverseSection):
    return law_of(section.orthotropic())


@law_of.register
def _(section: deck.OrthotropicSection):
    C, (G12, G23, G13) = stiffness(section), section.shears
    c, s = cos(radians(section.angle)), sin(radians(section.angle))
    fastest = max(fastest_in_plane(C, G12), C[2, 2])
    normal = (C[0, 0], C[1, 1], C[2, 2], C[0, 1], C[1, 2], C[0, 2])
    axes = (c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0)
    return Orthotropic(*map(float, normal), G12, G23, G13, axes, float(fastest))


def stiffness(section) -> np.ndarray:
    """Return the stiffness of the normal strains along the axes, shape (3, 3), in Pa."""
    a, b = -section.nu12 / section.E1, -section.nu13 / section.E1
    c = -section.nu23 / section.E2
    compliance = [[1.0 / section.E1, a, b], [a, 1.0 / section.E2, c], [b, c, 1.0 / section.E3]]
    return np.linalg.inv(compliance)


def fastest_in_plane(C, shear: float) -> float:
    """Return the largest rho c^2 of plane waves in all directions of the plane (Pa)."""
    angles = np.linspace(0.0, np.pi, DIRECTIONS)
    x, y = np.cos(angles), np.sin(angles)
    xx, yy = C[0, 0] * x**2 + shear * y**2, C[1, 1] * y**2 + shear * x**2
    xy = (C[0, 1] + shear) * x * y
    return (0.5 * (xx + yy) + np.hypot(0.5 * (xx - yy), xy)).max()
