"""The background grid: equal cells between a lower corner and an upper one."""

from itertools import accumulate
from operator import mul
from typing import NamedTuple

import numpy as np


class Lattice(NamedTuple):
    """A grid of square or cubic cells; nodes are numbered along x first."""

    cells: tuple  # number of cells along each axis; its length is the dimension
    width: float  # edge of a cell (m)
    lower: tuple  # lower corner (m)

    @property
    def nodes(self) -> tuple:
        """Number of nodes along each axis."""
        return tuple(n + 1 for n in self.cells)

    @property
    def node_count(self) -> int:
        """Number of nodes."""
        return int(np.prod(self.nodes))

    @property
    def strides(self) -> tuple:
        """Steps in node number to the next node along each axis."""
        return tuple(accumulate(self.nodes[:-1], mul, initial=1))

    def node_positions(self) -> np.ndarray:
        """Return the positions of all nodes, shape (nodes, dimension), in metres."""
        axes = [
            low + self.width * np.arange(n) for low, n in zip(self.lower, self.nodes, strict=True)
        ]
        mesh = np.meshgrid(*axes, indexing="ij")
        return np.stack([m.ravel(order="F") for m in mesh], axis=1)
