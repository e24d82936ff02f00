"""Which rows a particle sees."""

from typing import NamedTuple

import numpy as np


class Stencil(NamedTuple):
    """Place of every particle in the grid at the start of the step, kept for the whole step."""

    base: np.ndarray  # (n,) lowest node of the particle's nodes
    local: np.ndarray  # (n, dim) position from the base node, in cells
    near: np.ndarray  # (n,) line of `table`, or -1 where the rows are the nodes themselves
    table: np.ndarray  # (listed, nodes per particle) rows of a particle near a crack
    listed: np.ndarray  # (n,) particles near a crack
    around: np.ndarray  # (n,) particles that may see a node with more than one row
    count: np.ndarray  # (2,) how many of `listed` and `around` are in use


def make_stencil(n: int, dim: int, nodes_per_particle: int, listed: int) -> Stencil:
    """Return an empty stencil for `n` particles of which `listed` may lie near cracks."""
    return Stencil(
        base=np.zeros(n, dtype=np.int64),
        local=np.zeros((n, dim)),
        near=np.full(n, -1, dtype=np.int64),
        table=np.zeros((listed, nodes_per_particle), dtype=np.int64),
        listed=np.zeros(n, dtype=np.int64),
        around=np.zeros(n, dtype=np.int64),
        count=np.zeros(2, dtype=np.int64),
    )
