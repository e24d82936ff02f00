"""The particles of every row at nodes that several bodies see, and their volume gradient.

A cloud is a chain of entries of the stencil: entry e of line l stands as l * entries per line + e.
"""

from typing import NamedTuple

import numpy as np

from cramp_cli.numerics.kernel import inlined_kernel, kernel
from cramp_cli.shapes.shape import gradients, offsets, place_of, weights
from cramp_cli.transfer.rows import add, entry_gradient, first_line


class Clouds(NamedTuple):
    """Chains of the entries of the stencil, row by row."""

    head: np.ndarray  # (rows,) first entry of a row, or -1
    link: np.ndarray  # (listed * entries per line,) next entry of the same row, or -1
    volume: np.ndarray  # (rows,) sum of V S, from step.py's paragraph 3 on with images (m^3)
    slope: np.ndarray  # (rows, dim) sum of V grad S: the gradient of the volume (m^3 per cell)


def make_clouds(rows: int, stencil) -> Clouds:
    """Return empty chains for a number of rows and the lists of a stencil."""
    entries = stencil.table.size
    dim = stencil.local.shape[1]
    return Clouds(
        head=np.full(rows, -1, dtype=np.int64),
        link=np.zeros(entries, dtype=np.int64),
        volume=np.zeros(rows),
        slope=np.zeros((rows, dim)),
    )


@kernel
def clear_clouds(clouds, rows):
    """Empty the clouds of all rows of nodes with several rows.

    Volumes are emptied everywhere: symmetry planes add those of nodes that one body sees.
    """
    nodes = len(rows.first)
    clouds.volume[:] = 0.0
    for i in range(rows.count[1]):
        row = rows.shared[i]
        while row >= 0:
            clouds.head[row] = -1
            clouds.slope[row, :] = 0.0
            row = rows.first[row] if row < nodes else rows.next[row - nodes]


@kernel
def link_clouds(clouds, rows, stencil, volume, shape, strides, lo, hi):
    """Enter the particles lo..hi of one block that a node of several groups sees."""
    head, link, per_line = clouds.head, clouds.link, stencil.table.shape[1]
    lowest, highest, which = rows.lowest, rows.highest, stencil.which
    steps = offsets(strides, shape)
    for line in range(first_line(stencil, lo), first_line(stencil, hi)):
        p = stencil.listed[line]
        place = place_of(shape, strides, stencil, p)
        S, G = weights(place, shape), gradients(place, shape)
        for e in range(stencil.entries[line]):
            node = stencil.base[p] + steps[which[line, e]]
            if S[which[line, e]] > 0.0 and lowest[node] < highest[node]:
                row, entry = stencil.table[line, e], line * per_line + e
                link[entry], head[row] = head[row], entry
                gradient = entry_gradient(stencil, strides, line, e, S, G)
                w = stencil.share[line, e] * S[which[line, e]]
                clouds.volume[row] += volume[p] * w
                add(clouds.slope, row, volume[p], gradient)


@inlined_kernel
def particle_of(stencil, entry):
    """Return the particle of an entry of a cloud."""
    return stencil.listed[entry // stencil.table.shape[1]]
