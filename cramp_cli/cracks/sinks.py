"""Energy that is taken beside a running tip where its domain does not count all of it.

J of a domain with the weight q counts what is taken at a place behind the tip (closing tractions,
filters) by q there. All of it has flowed into the tip: the rest, 1 - q, is added to J.
"""

from math import exp

import numpy as np

from cramp_cli.cracks.domain_integral import fill_weights, inner_radius

OF_LATE = 1.0  # cells on the way of which a tip forgets what was taken


def note_taken(growth, tip, distance, energy, width) -> None:
    """Note energies (n,) taken at distances (n,) from a tip (J, m); width: of a cell (m)."""
    growth.sunk[tip] += float(energy.sum())
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
