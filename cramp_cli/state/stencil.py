"""Which rows a particle sees, and with what share of its weight."""

from typing import NamedTuple

import numpy as np

# `near` of a particle without a list: no crack about; nodes with several rows about; to be listed
FAR, AROUND, CLOSE = -1, -2, -3


class Stencil(NamedTuple):
    """Place of every particle in the grid at the start of the step, kept for the whole step.

    Far from cracks the rows of a particle are its nodes. A particle near a crack has a list of
    entries:
    a node, the row of that node, and the share of the weight that goes to this row: 1, except for a
    particle that a tip is passing, which is part cut, part whole (tip_nodes.py). The share of such
    a particle changes from place to place, which adds S * bend to the gradient of the
    weight.
    """

    base: np.ndarray  # (n,) lowest node of the particle's nodes
    local: np.ndarray  # (n, dim) position from the base node, in cells
    half: np.ndarray  # (n, dim) half size at the start, in cells; only of particles of many sizes
    sides: np.ndarray  # (n, dim*dim) half sides of its domain, one by one, in cells; of cpdi only
    near: np.ndarray  # (n,) line of the lists of entries; FAR or AROUND: the nodes are the rows
    entries: np.ndarray  # (listed,) number of entries of a listed particle
    which: np.ndarray  # (listed, 2 * nodes per particle) node of an entry, in the particle's order
    table: np.ndarray  # (listed, 2 * nodes per particle) row of an entry
    share: np.ndarray  # (listed, 2 * nodes per particle) share of the weight that the row takes
    bend: np.ndarray  # (listed, 2 * nodes per particle, dim) gradient of the share, per cell
    listed: np.ndarray  # (n,) particles near a crack
    around: np.ndarray  # (n,) particles that may see a node with more than one row
    count: np.ndarray  # (2,) how many of `listed` and `around` are in use


def make_stencil(
    n: int,
    dim: int,
    nodes_per_particle: int,
    listed: int,
    *,
    domains: bool = False,
    sized: bool = False,
) -> Stencil:
    """Return an empty stencil for `n` particles of which `listed` may lie near cracks.

    domains: whether particles have domains that are strained with them; sized: whether each has a
    size of its own
    """
    return Stencil(
        base=np.zeros(n, dtype=np.int32),
        local=np.zeros((n, dim)),
        half=np.zeros((n if sized else 0, dim)),
        sides=np.zeros((n if domains else 0, dim * dim)),
        near=np.full(n, FAR, dtype=np.int32),
        listed=np.zeros(n, dtype=np.int32),
        around=np.zeros(n, dtype=np.int32),
        count=np.zeros(2, dtype=np.int64),
        **make_lists(nodes_per_particle, dim, listed),
    )


def make_lists(nodes_per_particle: int, dim: int, listed: int) -> dict:
    """Return empty lists of entries for `listed` particles."""
    return {
        "entries": np.zeros(listed, dtype=np.int64),
        "which": np.zeros((listed, 2 * nodes_per_particle), dtype=np.int64),
        "table": np.zeros((listed, 2 * nodes_per_particle), dtype=np.int64),
        "share": np.ones((listed, 2 * nodes_per_particle)),
        "bend": np.zeros((listed, 2 * nodes_per_particle, dim)),
    }
