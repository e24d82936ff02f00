"""Bodies that stick to each other where they have touched, up to a strength (law `adhesive`).

A pair of rows that is joined moves as one, whatever the passes of contact, until the stress that
this takes in the update of momenta exceeds the strength: with N pulling and S shearing,

    (max(N, 0)/strength)^2 + (S/shear_strength)^2 > 1,    N, S = momentum given/(area dt).

From then on it is a frictional pair. It is joined again when it touches again.

The area of a node is A = sqrt(2 V_min (V_a + V_b))/h, with the volumes of both rows (Nairn 2013,
CMES 92, 271-299). Along a flat face it adds up to the face, on a line of nodes or between two.

Rows last for a step only, so the state keeps a list of bonds: a pair takes the bond of its node, at
a node that is new to the two bodies that of a joined pair next to it, and else it is joined if the
bodies overlap.
"""

from math import sqrt

import numpy as np

from cramp_cli.cracks.contact import ADHESIVE, FRICTIONAL, GLUED, UPDATE
from cramp_cli.numerics.kernel import kernel
from cramp_cli.numerics.vector import dot

PARTED, JOINED, NEW = 0, 1, 2  # what is known of a pair
NODE, FIRST_GROUP, SECOND_GROUP, KNOWN = 0, 1, 2, 3  # columns of a list of bonds


def no_bonds() -> np.ndarray:
    """Return an empty list of bonds: (n, 4), node, both groups, PARTED or JOINED."""
    return np.zeros((0, 4), dtype=np.int64)


def bonds_of(pairs, laws) -> np.ndarray:
    """Return the bonds of all pairs with the law, as a list for the state."""
    used = pairs.used[0]
    group, columns = pairs.group[:used], (pairs.node[:used], *pairs.group[:used].T)
    listed = np.stack([*columns, pairs.bond[:used]], axis=1)
    return np.ascontiguousarray(listed[laws.kind[group[:, 0], group[:, 1]] == ADHESIVE])


@kernel
def recall_bonds(pairs, laws, bonds):
    """Set the bond of every pair from the list that the last step has left; gaps must be known."""
    of_node = pairs.of_node
    for k in range(len(bonds) - 1, -1, -1):
        of_node[bonds[k, NODE]] = k  # the first: those of a node follow each other
    for i in range(pairs.used[0]):
        pairs.bond[i] = _known(pairs, i, bonds)
    for k in range(len(bonds)):
        of_node[bonds[k, NODE]] = -1
    for i in range(pairs.used[0]):
        if pairs.bond[i] == NEW and _beside_joined(pairs, i):
            pairs.bond[i] = NEW + JOINED
    for i in range(pairs.used[0]):
        if pairs.bond[i] >= NEW:
            joined = pairs.bond[i] > NEW or pairs.gap[i] < 0.0
            pairs.bond[i] = JOINED if joined else PARTED


@kernel
def _known(pairs, i, bonds):
    node = pairs.node[i]
    k = pairs.of_node[node]
    while 0 <= k < len(bonds) and bonds[k, NODE] == node:
        a, b = bonds[k, FIRST_GROUP], bonds[k, SECOND_GROUP]
        if a == pairs.group[i, 0] and b == pairs.group[i, 1]:
            return bonds[k, KNOWN]
        k += 1
    return NEW


@kernel
def _beside_joined(pairs, i):
    found = False
    for w in range(pairs.around[i]):
        found = found or pairs.bond[pairs.window[i, w]] == JOINED
    return found


@kernel
def adhere(pairs, i, laws, clouds, dp, normal, width, dt, stage):
    """Return the law that an adhesive pair follows now; in the update, find whether it holds.

    dp: momentum that would bring both to their common velocity; normal: from the row that gets it
    to the other; width: of a cell (m)
    """
    ga, gb = pairs.group[i, 0], pairs.group[i, 1]
    if stage == UPDATE:
        pull = dot(dp, normal)
        if pairs.bond[i] == PARTED:
            pairs.bond[i] = JOINED if pairs.gap[i] < 0.0 and pull < 0.0 else PARTED
        else:
            full = contact_area(clouds, pairs.row[i, 0], pairs.row[i, 1], width) * dt
            shear = sqrt(max(dot(dp, dp) - pull * pull, 0.0)) / (full * laws.shear_strength[ga, gb])
            opening = max(pull, 0.0) / (full * laws.strength[ga, gb])
            if opening * opening + shear * shear > 1.0:
                pairs.bond[i] = PARTED
    return GLUED if pairs.bond[i] == JOINED else FRICTIONAL


@kernel
def contact_area(clouds, a, b, width):
    """Return the area over which rows a and b of a node touch (m^2)."""
    Va, Vb = clouds.volume[a], clouds.volume[b]
    return sqrt(2.0 * min(Va, Vb) * (Va + Vb)) / width
