"""What the stresses on the faces of a crack add to the integrals around its tip.

The integrals over the domain take all that acts on the faces for a load on the tip. The face terms,
integrals along both faces, take it out again:

    J      = (sum over the domain) - integral of q T_i d(gap_i)
    K_I    = (sum) - sqrt(2/pi) integral of sigma(r) q(r) / sqrt(r) dr
    K_II   = (sum) - sqrt(2/pi) integral of tau(r) q(r) / sqrt(r) dr

T, sigma, tau: what the faces give each other, positive where they draw each other back. In K the
gap is that of the asymptotic field of its mode, (kappa + 1)/mu sqrt(r / (2 pi)) at r behind the
tip. Rubbing faces have no term in K_I, which is zero there, and none in J, which keeps the work of
friction.
"""

from math import inf, pi, sqrt

import numpy as np

from cramp_cli.cracks.cohesion import tractions_now
from cramp_cli.cracks.contact import FRICTIONAL
from cramp_cli.cracks.domain_integral import beside_crack, fill_weights

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
    stress = min(max(shear, -limit), limit)
    return _singular_integral(np.array([0.0, radius]), np.array([stress]), inner, radius)


def drawn(model, state, tip, frame, inner, radius) -> np.ndarray:
    """Return what traction laws add to the sums for J, K_I and K_II of a tip, seen in its frame."""
    if model.cohesion is None:
        return np.zeros(3)
    way, step, traction = _pieces(model, state, tip)
    middle = 0.5 * (way[1:] + way[:-1])
    q = np.zeros(len(middle))
    fill_weights(q, middle, inner, radius)
    J = float(q @ np.sum(traction * step, axis=1))
    (ex, ey), side = frame.now, 2 * tip.end - 1
    c, s = np.cos(frame.bend * middle), -np.sin(frame.bend * middle)  # the way goes back
    ahead = np.stack([c * ex - s * ey, s * ex + c * ey], axis=1)
    along = side * np.sum(traction * ahead, axis=1)
    normal = side * (traction[:, 1] * ahead[:, 0] - traction[:, 0] * ahead[:, 1])
    return np.array(
        [J, *(_singular_integral(way, stress, inner, radius) for stress in (normal, along))]
    )


def zone_energy(model, state, tip) -> float:
    """Return J of the cohesive zone of a tip: the integral of T_i d(gap_i) behind it (J/m^2).

    It reaches to the largest opening: beyond, a zone belongs to the other tip. Pressures have none.
    """
    if model.cohesion is None:
        return 0.0
    _, step, traction = _pieces(model, state, tip, pressures=False)
    widest = int(np.argmax(np.hypot(*np.cumsum(step, axis=0).T))) + 1
    return float(np.sum(traction[:widest] * step[:widest]))


def _pieces(model, state, tip, *, pressures=True):
    """Return the pieces of a crack as they follow each other from its tip.

    The tip is closed: the part of a cell ahead of it in which a smooth tip opens counts behind it.

    pressures: whether they count as tractions
    returns: distances of their ends from the tip (n + 1,), m; step of the gap from end to end
    (n, 2), m; mean traction (n, 2), Pa, none where a law covers not both ends
    """
    paths, points = state.paths, tip.points
    lengths = np.hypot(*np.diff(paths.origin[points], axis=0).T)
    gap = (paths.above - paths.below)[points]
    gap[0] = 0.0
    counts = (paths.law >= 0) & (pressures | ~model.cohesion.presses(paths))
    counts = counts[points]
    stress = tractions_now(model, state)[points]
    mean = 0.5 * (stress[1:] + stress[:-1]) * (counts[1:] & counts[:-1])[:, None]
    return np.concatenate([[0.0], np.cumsum(lengths)]), np.diff(gap, axis=0), mean


def _singular_integral(way, stress, inner, radius) -> float:
    """Return sqrt(2/pi) times the integral of stress q/sqrt(r) over pieces of a crack; r = u^2.

    way: distances of their ends from the tip (n + 1,), m; stress: of each piece (n,), Pa
    """
    u = np.linspace(0.0, sqrt(radius), POINTS)
    q = np.zeros(POINTS)
    fill_weights(q, u**2, inner, radius)
    area = np.concatenate([[0.0], np.cumsum(0.5 * (q[1:] + q[:-1]) * np.diff(u))])
    share = np.diff(np.interp(np.sqrt(way), u, area))
    return sqrt(2.0 / pi) * 2.0 * float(stress @ share)
