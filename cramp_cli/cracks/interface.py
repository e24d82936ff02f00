"""What a tip does at an interface: it goes into the other material, or along it.

Of the ways open to it a crack takes that on which it releases most energy beside what the way
costs, G/Gamma (He and Hutchinson 1989): G of a short kink (kink.py), Gamma of the material it
enters, or of the interface. A crack along an interface runs in the material it came from, beside
the particles of the other one.
"""

from math import hypot, pi
from typing import NamedTuple

import numpy as np

from cramp_cli.cracks.criteria.directions import turned
from cramp_cli.cracks.kink import LARGEST, kinked

LOOK = 0.75  # how far ahead of a tip its way is looked at (cells)
CLEAR = 0.75  # a place nearer than this to a particle of another material lies in it (cells)
BESIDE = 0.5  # a place nearer than CLEAR and this is beside the interface (cells)
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
    away, other = _nearest(others, place + look * np.array(turned(heading, wanted)), width)
    enters, cost = away < CLEAR, model.propagation.toughness_of(own)
    along = model.propagation.toughness_between(own, other)
    if not enters and along >= cost:
        return Course(wanted, 0.0)
    ways = [(wanted, model.propagation.toughness_of(other) if enters else cost)]
    for angle in sorted(FAN, key=lambda angle: abs(angle - wanted)):
        away, _ = _nearest(others, place + look * np.array(turned(heading, angle)), width)
        if CLEAR <= away < CLEAR + BESIDE:
            ways.append((angle, along))
    turn, cost = max(ways, key=lambda way: released(load, way[0]) / way[1])
    return Course(turn, 0.0 if turn == wanted and not enters else cost)


def released(load, angle: float) -> float:
    """Return the energy that a short kink at an angle (rad) releases, times E' (Pa^2 m)."""
    k_I, k_II = kinked(load.K_I, load.K_II, min(max(angle, -LARGEST), LARGEST))
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
