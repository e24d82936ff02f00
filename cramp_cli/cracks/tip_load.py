"""J, K_I and K_II of a tip that may have kinked and may move.

A tip is resolved by its own domain. A kink shorter than that is not: the old faces, no longer
parallel to the new direction, enter every integral around its end, and J would come out negative.
While a kink is short its load is that of the crack it left, found around the corner with the kink
inside the part of the domain where nothing counts, carried to its end by the functions of a small
kink (kink.py). Later the own domain takes over, small enough to leave the corner outside.
"""

from math import atan2, inf, sqrt
from typing import Any, NamedTuple

import numpy as np

from cramp_cli.cracks.domain import SMALLEST, USUAL, domain_values
from cramp_cli.cracks.domain_integral import inner_radius
from cramp_cli.cracks.face_terms import drawn, rubbed_off
from cramp_cli.cracks.kink import LARGEST, kinked
from cramp_cli.cracks.moving_tip import integrate_flux, mean_velocity
from cramp_cli.cracks.rayleigh import rayleigh_speed, release_factors, wave_speeds
from cramp_cli.cracks.room import find_room
from cramp_cli.cracks.site import site_at
from cramp_cli.cracks.speed import ALMOST
from cramp_cli.cracks.tip_domain import is_closed
from cramp_cli.cracks.tips import Tip
from cramp_cli.state.growth import BLEND, BLIND, HELD, KINK, MIXED, OWN

SHORT, LONG = 2.0, 3.0  # lengths of a kink between which its own domain takes over (cells)
AROUND, FALL = 0.5, 4.0  # R0 beyond the end of a kink, and R1 beyond R0 (cells)
MOST_BENT = 0.5  # rad by which a crack may turn within the domain of a tip that grows
LEAST_FALL = 1.5  # R1 beyond R0 at the least (cells)


class TipLoad(NamedTuple):
    """What drives a tip."""

    J: float  # J/m^2
    K_I: float  # Pa sqrt(m)
    K_II: float  # Pa sqrt(m)
    stage: int  # where it was found
    reach: float  # radius of the domain (m)
    site: Any  # the place of the tip, with its axes of before and now


def line_of(tip) -> int:
    """Return the line of a tip in the arrays of growth."""
    return 2 * tip.crack + tip.end


def load_on(model, state, scratch, tip: Tip) -> TipLoad:
    """Return the load on a tip; the last one where no domain fits (HELD), or none yet (BLIND)."""
    growth, k, width = state.growth, line_of(tip), model.lattice.width
    place = state.paths.origin[tip.points[0]]
    site = site_at(model, state, scratch, tip, place, tuple(growth.heading[k].tolist()))
    kink = float(growth.kink[k])
    late = min(max((kink / width - SHORT) / (LONG - SHORT), 0.0), 1.0)
    own = _own_load(model, state, scratch, tip, site, kink) if late > 0.0 else None
    old = _parent_load(model, state, scratch, tip, site, kink) if late < 1.0 else None
    if own is not None and old is not None:
        J, K_I, K_II, reach = (late * np.array(own[1:]) + (1.0 - late) * np.array(old)).tolist()
        return TipLoad(J, K_I, K_II, BLEND, reach, site)
    if own is not None:
        stage, *found, reach = own
        return TipLoad(*found, stage, reach, site)
    if old is not None:
        *found, reach = old
        return TipLoad(*found, KINK, reach, site)
    stage = BLIND if growth.stage[k] == BLIND else HELD
    return TipLoad(*growth.load[k].tolist(), stage, float(growth.reach[k]), site)


def _own_load(model, state, scratch, tip, site, kink):
    """Return stage, J, K_I, K_II, radius of the tip's own domain, or None without room."""
    width, radii = model.lattice.width, model.fracture.radii
    room, _ = find_room(model, state.paths, tip, site.frame.origin, inf)
    straight, _ = find_room(model, state.paths, tip, site.frame.origin, MOST_BENT)
    wanted = min(radii[0] if radii else USUAL * width, max(straight, SMALLEST * width))
    radius = min(wanted, kink, room)
    least = (1.0 - 1e-9) * min(SMALLEST * width, kink)
    while radius >= least:
        J, K_I, K_II, spoiled, mixed, _ = domain_values(model, site, radius)
        if not spoiled:
            inner = inner_radius(radius, width)
            held = drawn(model, state, tip, site.frame, inner, radius)
            J, K_I, K_II = (np.array([J, K_I, K_II]) - held).tolist()
            here = state.paths.point[tip.points[0]]
            if is_closed(model, scratch, tip.crack, here, radius, K_I):
                K_I, K_II = 0.0, K_II - rubbed_off(model, site, tip.crack, inner, radius)
            found = (J, K_I, K_II, float(held[0]), mixed)
            load = _running_load(model, state, tip, site, radius, *found)
            return (MIXED if mixed else OWN, *load, radius)
        radius *= 0.9
    return None


def _running_load(model, state, tip, site, radius, J, K_I, K_II, held, mixed):
    """Return J of a tip that has grown by the flow into it, with K_I, K_II of that size.

    The flow through a domain with a second material is that into the tip where the interface runs
    along the crack: nothing changes from one place to the next. A tip at rest has the J of its K.

    held: J that the faces carry (J/m^2)
    """
    growth, k = state.growth, line_of(tip)
    speed = float(growth.speed[k])
    if growth.length[k] == 0.0 or (mixed and speed == 0.0):
        return J, K_I, K_II
    J = flux_into_tip(model, site, inner_radius(radius, model.lattice.width), radius) - held
    J += float(growth.beside[k])
    return (J, *sized(J, K_I, K_II, speed, site)) if speed > 0.0 else (J, K_I, K_II)


def _parent_load(model, state, scratch, tip, site, kink):
    """Return J, K_I, K_II at the end of a short kink, and the radius around its corner.

    None where the corner has no room.
    """
    width, growth, k = model.lattice.width, state.growth, line_of(tip)
    before = tuple(growth.parent[k].tolist())
    corner = site_at(model, state, scratch, tip, growth.corner[k], before)
    room, _ = find_room(model, state.paths, tip, corner.frame.origin, inf)
    inner = max(kink + AROUND * width, width)
    radius = min(inner + FALL * width, room)
    while radius >= inner + LEAST_FALL * width:
        values = domain_values(model, corner, radius, inner)
        if not values.spoiled:
            K_I, K_II = values.K_I, values.K_II
            here = state.paths.point[tip.points[0]]
            if is_closed(model, scratch, tip.crack, here, radius, K_I):
                K_I, K_II = 0.0, K_II - rubbed_off(model, corner, tip.crack, inner, radius)
            (ax, ay), (bx, by) = before, growth.heading[k]
            phi = min(max(atan2(ax * by - ay * bx, ax * bx + ay * by), -LARGEST), LARGEST)
            return (*kink_load(state, k, site, *kinked(K_I, K_II, phi)), radius)
        radius *= 0.9
    return None


def kink_load(state, k, site, k_I, k_II):
    """Return J, K_I, K_II of a short kink, from those it would have at rest.

    One that runs gets the share g(v) = 1 - v/c_R of the energy (Freund 1990, eq. 7.4.5). The speed
    is that of the last step and hangs on the load: taking the load half from the step before lets
    both settle within a few steps; taken at once they would swing.
    """
    speed, J = float(state.growth.speed[k]), (k_I**2 + k_II**2) / site.hooke.stiffness
    if speed == 0.0:
        return J, k_I, k_II
    J *= max(1.0 - speed / rayleigh_speed(*_waves(site)), 0.0)
    new = np.array([J, *sized(J, k_I, k_II, speed, site)])
    return (0.5 * (new + state.growth.load[k])).tolist()


def _waves(site) -> tuple[float, float]:
    """Return the speeds of waves at a tip (m/s), dilational and shear."""
    return wave_speeds(site.hooke.shear, site.hooke.kappa, site.block.density)


def sized(J, K_I, K_II, speed, site) -> tuple[float, float]:
    """Return K_I, K_II with their ratio kept and the size that belongs to J at a speed (m/s).

    J = (A_I K_I^2 + A_II K_II^2)/(2 mu) (Freund 1990, eq. 5.3.10). The interaction integral knows
    the field of a tip at rest only, and sees the tractions behind a running one (release.py).
    """
    fast, slow = _waves(site)
    A_I, A_II = release_factors(min(speed, ALMOST * rayleigh_speed(fast, slow)), fast, slow)
    found = (A_I * K_I**2 + A_II * K_II**2) / (2.0 * site.hooke.shear)
    size = sqrt(max(J, 0.0) / found) if found > 0.0 else 0.0
    return size * K_I, size * K_II


def flux_into_tip(model, site, inner, radius) -> float:
    """Return the J of a moving tip (J/m^2) from the domain between both radii (m)."""
    particles, parts, sums = site.cloud.particles, site.cloud.parts, np.zeros(3)
    for _, lo, hi in parts:
        sums += mean_velocity(particles, site.frame, inner, radius, lo, hi)
    drift = (sums[1] / sums[0], sums[2] / sums[0])
    if site.half:  # the image moves the other way along the normal of the plane
        (ex, ey), along = site.frame.now, sums[1:] @ site.frame.now / sums[0]
        drift = (along * ex, along * ey)
    J = sum(
        integrate_flux(particles, site.frame, tuple(site.gravity), drift, inner, radius, lo, hi)
        for _, lo, hi in parts
    )
    return (2.0 if site.half else 1.0) / model.geometry.thickness * J
