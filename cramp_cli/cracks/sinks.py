"""Energy that is taken beside a running tip where its domain does not count all of it.

J of a domain with the weight q counts what is taken at a place behind the tip (closing tractions,
filters) by q there. All of it has flowed into the tip: the rest, 1 - q, is added to J.
"""

from math import exp

import numpy as np

from cramp_cli.cracks.domain_integral import fill_weights, inner_radius

OF_LATE = 1.0  # cells on the way of which a tip forgets what was taken
LAG = 0.55  # cells that a tip must go on until the solid has lost what the tip has released


def note_taken(growth, tip, distance, energy, width) -> None:
    """Note energies (n,) taken at distances (n,) from a tip (J, m); width: of a cell (m)."""
    if not (reach := float(growth.reach[tip])):
        return
    q = np.zeros(len(distance))
    fill_weights(q, distance, inner_radius(reach, width), reach)
    growth.taken[tip] += float((1.0 - q) @ energy)


def spread_over_way(growth, tip, way, thickness, width) -> None:
    """Bring what was taken since the last move to the area of the way of this one (m)."""
    late = 1.0 - exp(-way / (OF_LATE * width))
    growth.beside[tip] += late * (growth.taken[tip] / (thickness * way) - growth.beside[tip])
    growth.taken[tip] = 0.0


def lose(growth, tip, released, way, width) -> float:
    """Return the energy (J) that the solid loses on a way (m) on which a tip releases `released`.

    Closing tractions hold the faces just behind a running tip: a crack that begins to run must
    first stretch them.
    """
    growth.ahead[tip] += released
    lost = growth.ahead[tip] * (1.0 - exp(-way / (LAG * width)))
    growth.ahead[tip] -= lost
    return float(lost)


def lose_the_rest(growth, tip) -> float:
    """Return what the solid loses (J) when a tip ends or comes to rest."""
    rest = float(growth.ahead[tip])
    growth.ahead[tip] = 0.0
    return rest
