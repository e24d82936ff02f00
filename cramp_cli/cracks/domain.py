"""J, K_I and K_II of one domain, whatever it holds: its particles by material, summed."""

from typing import NamedTuple

import numpy as np

from cramp_cli.cracks.domain_integral import (
    Hooke,
    inner_radius,
    integral_of_weight,
    integrate_domain,
)
from cramp_cli.cracks.ring_integral import integrate_hoop, intensities_of
from cramp_cli.cracks.second_material import add_difference
from cramp_cli.materials.geometry import Axisymmetric, depth, is_plane_stress
from cramp_cli.materials.law import poisson_ratio, same_law, shear_modulus

USUAL, SMALLEST = 5.0, 2.5  # radius of the domain in cells, and the least that gives a number
REACH = 8.0  # cells around a tip or the corner of a kink that an integral can want
SPREAD = (0.8, 1.2)  # further radii that are compared, in shares of the radius
BARE = 0.5  # a particle of another material nearer to the tip than this leaves no K (cells)
LEAK = 0.02  # part of the domain that may be empty: particles are a coarse quadrature


class Values(NamedTuple):
    """What a domain gives."""

    J: float  # J/m^2; of K where the domain holds a second material
    K_I: float  # Pa sqrt(m)
    K_II: float  # Pa sqrt(m)
    spoiled: str  # what spoils the domain; empty if nothing does
    mixed: bool  # it holds a second material
    corrected: bool  # a particle at least of another material counts, for which K is corrected


def domain_values(model, site, radius, inner=None) -> Values:
    """Return J, K_I, K_II of a domain, and what spoils it.

    inner: radius (m) within which the weight is 1; chosen if not given
    """
    inner = inner_radius(radius, model.lattice.width) if inner is None else inner
    sums, own, touched, known = _sum_parts(model, site, inner, radius)
    per_length = (2.0 if site.half else 1.0) / depth(model.geometry, site.frame.origin[0])
    J, K_I, K_II, filled = (per_length * sums).tolist()
    K_II = 0.0 if site.half else K_II
    rings = isinstance(model.geometry, Axisymmetric)
    if rings:
        K_I, K_II = intensities_of(J, K_I, K_II, site.hooke.stiffness)
    expected = integral_of_weight(inner, radius)
    mixed = abs(per_length * own / expected - 1.0) >= LEAK
    spoiled = ""
    if abs(filled / expected - 1.0) >= LEAK:
        spoiled = "the edge of the body"
    elif mixed and (rings or not known):
        spoiled = "another material"
    if mixed and not spoiled:
        J = (K_I**2 + K_II**2) / site.hooke.stiffness
    return Values(J, K_I, K_II, spoiled, mixed, touched and known and not rings)


def _sum_parts(model, site, inner, radius):
    """Return the integrals over all materials, how full the domain is of that at the tip.

    Last: whether there are others, and whether K can be found beside them, isotropic and not at the
    tip itself.
    """
    sums, own, touched, known = np.zeros(4), 0.0, False, True
    particles = site.cloud.particles
    for block, lo, hi in site.cloud.parts:
        where = (inner, radius, lo, hi)
        part = integrate_domain(particles, site.frame, site.hooke, site.gravity, *where)
        sums += part
        if isinstance(model.geometry, Axisymmetric):
            sums[0] += integrate_hoop(particles, site.frame, *where)
        if same_law(block.law, site.block.law):
            own += part[3]
        elif part[3] > 0.0:
            touched, other = True, hooke_of(block.law, model.geometry)
            known = known and not np.isnan(other.shear) and _is_clear(model, site, lo, hi)
            if known:
                sums[1:3] += add_difference(particles, site.frame, site.hooke, other, *where)
    return sums, own, touched, known


def _is_clear(model, site, lo, hi) -> bool:
    """Return whether particles lo..hi keep away from the tip: on an interface there is no K."""
    away = site.cloud.particles.origin[lo:hi] - site.frame.origin
    return float(np.hypot(*away.T).min()) > BARE * model.lattice.width


def hooke_of(law, geometry) -> Hooke:
    """Return the elastic constants of a law in the plane; nan if it has none, K is nan then."""
    shear, nu = shear_modulus(law), poisson_ratio(law)
    plane_nu = nu / (1.0 + nu) if is_plane_stress(geometry) else nu
    return Hooke(shear, 3.0 - 4.0 * plane_nu, plane_nu, 2.0 * shear / (1.0 - plane_nu))
