"""When J and K of a tip cannot be trusted, told from what else is known around it.

Numbers that contradict each other, strain that is not elastic, a solid that turns fast. What is
nothing beside the strain energy around the tip is noise, and no doubt.
"""

from math import isnan, pi, sqrt

import numpy as np

from cramp_cli.cracks.cloud import chosen_from
from cramp_cli.cracks.straight_path import unstable_path
from cramp_cli.materials.geometry import Axisymmetric, is_plane_stress
from cramp_cli.materials.law import confined_modulus, poisson_ratio
from cramp_cli.state.measures import from_history
from cramp_cli.state.particles import DISSIPATED

AROUND = 5.0  # cells around a tip that are looked at
DIFFER = 0.2  # share by which two numbers for one J may differ
OTHER_MODE = 0.02  # share of K by which the mode by the opening may be off
BEHIND, BEHIND_CALM = 2.5, 2.0  # cells by which a running tip lags, with flip and other updates
LOW = 0.03  # share by which that may lower K without a word
NOISE = 0.01  # share of the strain energy around the tip that is no J
ROUND_OFF = 1e-12  # a strain that is none
TAKEN = 0.01  # share of the work around the tip that plastic and viscous strain may have taken
PURE = 0.05  # K of one mode as a share of the other's up to which a ring has one mode alone
LOCKED = 0.48  # Poisson's ratio from which J may be 5 % low; the deck warns from it on
COARSE = 0.25  # half side in cells of a particle that is one of two along each side of a cell
TURNING = 0.2  # share of K that the turning of the solid may make by itself


def doubts(model, site, row, run: tuple) -> list[str]:
    """Return what speaks against the J and K in a row.

    run: how far a running tip has run, and the length of its crack (m); empty of a tip at rest. J
    of a running tip has the kinetic energy in it and is not that of K.
    """
    away = np.hypot(*(site.cloud.particles.origin - site.frame.origin).T)
    near = np.flatnonzero(away < AROUND * model.lattice.width)
    particles = chosen_from(site.cloud.particles, near)
    found = [*_of_law(particles, site), *_of_rings(model, site, row), *_of_cells(model, site)]
    if run:
        return found + _of_running(model, row, run) + unstable_path(model, site, row)
    if not len(near):
        return found
    width, stiffness = model.lattice.width, site.hooke.stiffness
    noise = noise_around(model, site)
    if "closed" in row["status"]:
        return [*found, *_of_closed(row, stiffness, noise)]
    return [
        *found,
        *_contradictions(row, stiffness, noise),
        *_of_spin(particles, site, row, width, noise),
    ]


def noise_around(model, site) -> float:
    """Return the energy release rate (J/m^2) that is noise beside the strain energy at a tip."""
    particles, width = site.cloud.particles, model.lattice.width
    near = np.hypot(*(particles.origin - site.frame.origin).T) < AROUND * width
    energy = float(particles.work[near].mean()) if near.any() else 0.0
    return NOISE * AROUND * width * (energy + ROUND_OFF**2 * stiffness_at(site))


def stiffness_at(site) -> float:
    """Return E' at a tip (Pa); the modulus of uniaxial strain where the law has no K."""
    stiffness = site.hooke.stiffness
    return confined_modulus(site.block.law) if isnan(stiffness) else stiffness


def _of_running(model, row, run) -> list[str]:
    """Without the tractions of release.py, which need smooth tips, waves go round the tip.

    With them the faces hold on to each other up to three cells behind it: the tip acts from there,
    and K, as the root of the length of the crack, is that of a shorter one. Seen in cracks that
    expand at 0.2 to 0.6 c_R.
    """
    found = ["doubtful: J is negative"] if row["J"] < 0.0 else []
    if model.tip_nodes is None:
        found.append("doubtful: a sharp tip leaves in the solid what it releases")
        return found
    way, length = run
    lag = min(BEHIND if model.calm_tips else BEHIND_CALM, way / model.lattice.width)
    low = 0.5 * lag * model.lattice.width / length
    if low > LOW:
        text = "doubtful: a running tip acts {:.1f} cells behind its place, K is about {:.0f} % low"
        found.append(text.format(lag, 100.0 * low))
    return found


def _contradictions(row, stiffness, noise) -> list[str]:
    """J that is not that of K: no crack has such a field. A contour far from a domain."""
    J, of_K = row["J_tip"], (row["K_I"] ** 2 + row["K_II"] ** 2) / stiffness
    texts = {
        "doubtful: J and that of K differ by {:.0f} %": (J, of_K),
        "contour doubtful: {:.0f} % from the domain": (J, row["J_contour"]),
    }
    found = []
    for text, (one, other) in texts.items():
        off, larger = abs(one - other), max(abs(one), abs(other))
        if off > max(DIFFER * larger, noise):
            found.append(text.format(100.0 * off / larger))
    return found + of_mode(row, J, noise)


def of_mode(row, J, noise) -> list[str]:
    """The mode by the opening of the faces is not that of the domain."""
    by_faces = np.array([row["K_I_contour"], row["K_II_contour"]])
    by_domain = np.array([row["K_I"], row["K_II"]])
    sizes = np.hypot(*by_faces), np.hypot(*by_domain)
    if not (abs(J) > noise and min(sizes) > 0.0):
        return []
    off = np.hypot(*(by_faces / sizes[0] - by_domain / sizes[1]))
    if not off > OTHER_MODE:
        return []
    return [f"contour doubtful: its mode is {100.0 * off:.0f} % of K from that of the domain"]


def _of_closed(row, stiffness, noise) -> list[str]:
    """J of closed faces holds the work of friction besides that of K_II: it can not be below it."""
    J, of_K = row["J_tip"], row["K_II"] ** 2 / stiffness
    lack = of_K - J
    if not lack > max(DIFFER * max(of_K, abs(J)), noise):
        return []
    return [f"doubtful: J is {J:.3g}, that of K_II alone {of_K:.3g} J/m^2"]


def _of_spin(particles, site, row, width, noise) -> list[str]:
    """A node at a border has the velocity of a place inside the solid, half a cell away.

    In a solid that turns the difference strains the cells at the faces of a crack like an impact:
    stress up to rho c |spin| h over a length h. K measured around tips in freely turning plates is
    0.1 to 0.8 times that.
    """
    spin = 0.5 * float((particles.L[:, 2] - particles.L[:, 1]).mean())
    impedance = sqrt(site.block.density * confined_modulus(site.block.law))
    made = impedance * abs(spin) * width * sqrt(pi * width)
    K = sqrt(row["K_I"] ** 2 + row["K_II"] ** 2)
    if not made > TURNING * K or made * made / site.hooke.stiffness <= noise:
        return []
    return [f"doubtful: the solid turns by {spin:.3g} rad/s, which alone may make K = {made:.2g}"]


def _of_rings(model, site, row) -> list[str]:
    """The auxiliary fields are those of a plane: with both modes their ratio is off in a ring."""
    K = sorted((abs(row["K_I"]), abs(row["K_II"])))
    if not (isinstance(model.geometry, Axisymmetric) and K[0] > PURE * K[1]):
        return []
    off = 100.0 * AROUND * model.lattice.width / site.frame.origin[0]
    return [f"doubtful: K_II/K_I is off by about {off:.0f} % where a ring has both modes; J stands"]


def _of_cells(model, site) -> list[str]:
    """Cells that lock, particles too few to carry the field of a tip: J is low, K less so.

    Six cells per half crack: with nu = 0.48 and 0.49 J is 5 and 9 % low, with one particle per
    cell 13 %; K_I 1, 2 and 4 %.
    """
    nu, found = poisson_ratio(site.block.law), []
    if nu > (1.0 - 1e-9) * LOCKED and not is_plane_stress(model.geometry):
        text = "doubtful: nearly incompressible (nu = {:.3g}): stresses lock, J is low"
        found.append(text.format(nu))
    if max(site.block.shape.half) > 1.01 * COARSE:
        found.append("doubtful: fewer than 2 particles along each side of a cell: J is low")
    return found


def _of_law(particles, site) -> list[str]:
    """What the law at the tip takes from J and K, which belong to an elastic solid."""
    taken = float(from_history(particles, DISSIPATED).sum())
    work, found = float(particles.work.sum()), []
    if isnan(site.hooke.shear):
        found.append("K invalid: the stiffness of the material depends on direction or time")
    if taken > TAKEN * work:
        text = "doubtful: plastic or viscous strain took {:.0f} % of the work around the tip"
        found.append(text.format(100.0 * taken / work))
    return found
