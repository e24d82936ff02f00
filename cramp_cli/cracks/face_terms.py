"""What closed faces that rub add to the integrals around a tip.

The domain integral of free faces takes the work of friction for a load on the tip. The face term of
the interaction integral, the integral of t_i U_i,1 q over both faces, takes it out again. Faces of
the asymptotic field of sliding are (kappa + 1)/mu sqrt(r / (2 pi)) apart at r behind the tip, so

    K_II = (sum over the domain) - sqrt(2/pi) integral of tau(r) q(r) / sqrt(r) dr

with the shear stress tau that the faces carry. Pressure has a like term in K_I, which is zero on
closed faces anyway.
"""

from math import inf, pi, sqrt

import numpy as np

from cramp_cli.cracks.contact import FRICTIONAL
from cramp_cli.cracks.domain_integral import beside_crack, weight

POINTS = 201  # of the quadrature along the crack


def rubbed_off(model, site, crack, inner, radius) -> float:
    """Return what friction adds to the sum for K_II of a closed crack (Pa sqrt(m)).

    Shear stress and pressure are means over the particles within a cell of the faces, weighed as in
    the integral. A face carries no more shear than the law lets it; with `mu_static` above `mu` the
    law of sliding counts. Faces that stick carry all there is, and K_II is nothing.
    """
    sums, width = np.zeros(3), model.lattice.width
    for _, lo, hi in site.cloud.parts:
        sums += beside_crack(site.cloud.particles, site.frame, width, inner, radius, lo, hi)
    if not sums[0]:
        return 0.0
    shear, pressure = sums[1] / sums[0], max(-sums[2] / sums[0], 0.0)
    sliding = model.contact.kind[crack] == FRICTIONAL
    limit = model.contact.mu[crack] * pressure if sliding else inf
    return sqrt(2.0 / pi) * min(max(shear, -limit), limit) * _integral_of_root(inner, radius)


def _integral_of_root(inner, radius) -> float:
    """Return the integral of q(r) / sqrt(r) from the tip to the radius (sqrt(m)), with r = u^2."""
    u = np.linspace(0.0, sqrt(radius), POINTS)
    q = np.array([weight(r, inner, radius)[0] for r in (u**2).tolist()])
    return 2.0 * float(np.trapezoid(q, u))
