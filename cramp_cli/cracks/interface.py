"""What a tip does at an interface: it goes into the other material, or along it.

Of the ways open to it a crack takes that on which it releases most energy beside what the way
costs, G/Gamma (He and Hutchinson 1989): G of a short kink (kink.py) in the direction of the
interface, whatever curve leads into it, and Gamma of the material it enters, or of the interface. A
crack along an interface runs in the material it came from, beside the particles of the other one.
"""

from math import atan2, hypot, pi
from typing import NamedTuple

import numpy as np

from cramp_cli.cracks.criteria.directions import turned
from cramp_cli.cracks.domain import hooke_of
from cramp_cli.cracks.kink import kinked

LOOK = 0.75  # how far ahead of a tip its way is looked at (cells)
CLEAR = 0.75  # a place nearer than this to a particle of another material lies in it (cells)
BESIDE = 0.5  # a place nearer than CLEAR and this is beside the interface (cells)
WINDOW = 2.5  # cells around a place in which the normal of an interface is found
SQUARE = 0.5 * pi  # rad; there the series of kink.py give 0.259, He and Hutchinson 0.26
LEAN = pi / 6  # a way that leads to an interface at less than this angle (rad) runs beside it
# G of a kink of 90 degrees along an interface over G of a crack that goes on through it, by the
# parameter alpha of Dundurs, positive where the material ahead is the stiffer one; nu = 0.3 on
# both sides (our own finite elements, tests/verification/reference/deflection.py; He and Hutchinson
# 1989, fig. 3, of which the value for equal solids is 0.26)
DUNDURS = (-0.5, -0.25, 0.0, 0.25, 0.5, 0.75)
DEFLECTED = (0.286, 0.245, 0.255, 0.308, 0.421, 0.69)
FAN = np.linspace(-0.6 * pi, 0.6 * pi, 433).tolist()  # ways that are compared (rad)


class Course(NamedTuple):
    """The way a tip takes."""

    turn: float  # rad, left positive
    cost: float  # toughness of the interface or of the other material (J/m^2); 0 on a free way


def choose_course(model, site, place, heading, load, wanted: float) -> Course:
    """Return how a tip goes on that would turn by `wanted` (rad) if there were no interface.

    place, heading: of the tip in the undeformed body (m, unit vector)
    """
    others, look = _others(site, place, model.lattice.width), LOOK * model.lattice.width
    if not others:
        return Course(wanted, 0.0)
    width, own = model.lattice.width, site.block.material
    straight = place + look * np.array(turned(heading, wanted))
    away, other = _nearest(others, straight, width)
    enters, cost = away < CLEAR, model.propagation.toughness_of(own)
    along = model.propagation.toughness_between(own, other)
    right, left = _along_interface(site, straight, heading, own, width)
    meets = min(abs(right - wanted), abs(left - wanted)) > LEAN
    if not enters and (along >= cost or meets):  # it will be asked again where it has come there
        return Course(wanted, 0.0)
    ahead = model.propagation.toughness_of(other) if enters else cost
    ways = [(wanted, released(load, wanted) / ahead, ahead)]
    factor = _of_mismatch(model, site, other) if enters else 1.0
    for angle in sorted(angle for angle in (right, left) if abs(angle) <= FAN[-1]):
        turn = _free_way(others, place, heading, angle, width)
        if turn is not None:
            ways.append((turn, factor * released(load, angle) / along, along))
    turn, _, cost = max(ways, key=lambda way: way[1])
    return Course(turn, 0.0 if turn == wanted and not enters else cost)


def _of_mismatch(model, site, other) -> float:
    """Return by what factor a step in stiffness raises G along an interface beside G through it."""
    law = next(block.law for block, _, _ in site.cloud.parts if block.material == other)
    own, ahead = site.hooke.stiffness, hooke_of(law, model.geometry).stiffness
    alpha = (ahead - own) / (ahead + own)
    return float(np.interp(alpha, DUNDURS, DEFLECTED)) / DEFLECTED[DUNDURS.index(0.0)]


def _along_interface(site, place, heading, own, width) -> tuple:
    """Return by what angles (rad) a tip would turn into the interface near a place, both ways.

    Its normal is that in which the other material lies; a crack that meets it squarely releases
    along it what a kink of 90 degrees does, however it curves into it.
    """
    nx, ny = 0.0, 0.0
    for block, lo, hi in site.cloud.parts:
        away = site.cloud.particles.origin[lo:hi] - place
        near = np.maximum(1.0 - np.sum(away**2, axis=1) / (WINDOW * width) ** 2, 0.0) ** 2
        volume = site.cloud.particles.volume[lo:hi] * (1.0 if block.material != own else -1.0)
        x, y = (near * volume) @ away
        nx, ny = nx + x, ny + y
    ex, ey = heading
    right = atan2(-ex * nx - ey * ny, ex * ny - ey * nx)  # to (ny, -nx)
    return right, right + pi if right <= 0.0 else right - pi


def _free_way(others, place, heading, angle, width):
    """Return the turn (rad) nearest to an angle that keeps clear of others and beside them."""
    for turn in sorted(FAN, key=lambda turn: abs(turn - angle)):
        ahead = place + LOOK * width * np.array(turned(heading, turn))
        if CLEAR <= _nearest(others, ahead, width)[0] < CLEAR + BESIDE:
            return turn
    return None


def released(load, angle: float) -> float:
    """Return the energy that a short kink at an angle (rad) releases, times E' (Pa^2 m)."""
    k_I, k_II = kinked(load.K_I, load.K_II, min(max(angle, -SQUARE), SQUARE))
    return hypot(k_I, k_II) ** 2 if k_I > 0.0 else 0.0


def _others(site, place, width) -> list:
    """Return name and places of the particles of each other material that a way can meet."""
    found, reach = [], (LOOK + CLEAR + BESIDE) * width
    for block, lo, hi in site.cloud.parts:
        places = site.cloud.particles.origin[lo:hi]
        near = np.hypot(*(places - place).T) < reach
        if block.material != site.block.material and near.any():
            found.append((block.material, places[near]))
    return found


def _nearest(others, place, width) -> tuple[float, str]:
    """Return the distance of a place from the nearest other material (cells), and its name."""
    return min(
        (float(np.hypot(*(places - place).T).min()) / width, name) for name, places in others
    )
