"""Particles in bands of cells, so that threads can sum into the same grid and get the same bits.

The particles of a block are sorted by cell. A band holds those of HEIGHT rows of cells. Particles
of even bands never see a node that those of another even band see, nor do those of odd ones: so all
even bands are summed at the same time, then all odd ones, and at every node the order of the sums
is the same for any number of threads. A particle may stray from its band by STRAY rows; then all
are sorted again.
"""

from dataclasses import dataclass

import numpy as np

HEIGHT = 8  # rows of cells in a band
STRAY = 2  # rows by which a particle may leave its band: 2 STRAY + 3 rows of nodes < HEIGHT + 1


@dataclass(frozen=True)
class Bands:
    """The particles of a block, shared out: arrays of parts (first particle, last + 1, band).

    The parts of a group are worked on at the same time, each by one thread.
    """

    colours: tuple  # groups of parts for sums on the grid: even bands, then odd ones
    shares: tuple  # the group for work on the particles alone


def band_axis(cells) -> int:
    """Return the axis across which bands lie: the last of the longest ones."""
    return max(range(len(cells)), key=lambda d: (cells[d], d))


def band_count(cells) -> int:
    """Return the number of bands of a grid."""
    return -(-max(cells) // HEIGHT)


def sorted_by_cell(lattice, position) -> np.ndarray:
    """Return the order of particles (n, dim) by band, and by cell within a band."""
    cell = np.floor((position - lattice.lower) / lattice.width).astype(np.int64)
    last = band_axis(lattice.cells)
    axes = [d for d in range(len(lattice.cells)) if d != last] + [last]
    return np.lexsort([cell[:, d] for d in axes])


def band_starts(lattice, position) -> np.ndarray:
    """Return the first particle of every band, and the end, of particles sorted by cell."""
    axis = band_axis(lattice.cells)
    row = np.floor((position[:, axis] - lattice.lower[axis]) / lattice.width)
    edges = HEIGHT * np.arange(band_count(lattice.cells) + 1)
    return np.searchsorted(row, edges).astype(np.int64)


def runs_between(starts, low: int, high: int) -> list[tuple[int, int]]:
    """Return for each block the particles that may be in the rows of cells low to high - 1.

    starts: (blocks, bands + 1) as in State
    """
    last = starts.shape[1] - 2
    first = min(max((low - STRAY) // HEIGHT, 0), last)
    end = min(max((high - 1 + STRAY) // HEIGHT, 0), last)
    return [(int(block[first]), int(block[end + 1])) for block in starts]


def share_out(starts, workers: int) -> Bands:
    """Return the bands of a block for a number of threads; starts: (bands + 1,)."""
    parts = np.stack([starts[:-1], starts[1:], np.arange(len(starts) - 1)], axis=1)
    even, odd = parts[0::2], parts[1::2]
    if workers == 1:
        return Bands(((np.concatenate([even, odd]),),), (parts,))
    colours = tuple(tuple(c[w::workers] for w in range(workers)) for c in (even, odd))
    return Bands(colours, tuple(parts[w::workers] for w in range(workers)))
