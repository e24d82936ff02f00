"""What particles give to their rows: those near cracks have lists of entries (state/stencil.py).

Few particles, as loaded ones, ask for their rows one by one; sums over all do not: to_grid.py.
"""

from cramp_cli.numerics.kernel import kernel
from cramp_cli.numerics.vector import (
    pick,
    plus,
    times,
    vector_of,
)


@kernel
def add(field, row, s, v):
    """Add s v to a row of a (rows, dim) array."""
    for d in range(len(v)):
        field[row, d] += s * v[d]


@kernel
def rows_seen(stencil, p, steps):
    """Return how many rows a particle sees, listed or not; steps: to its nodes."""
    line = stencil.near[p]
    return len(steps) if line < 0 else stencil.entries[line]


@kernel
def row_and_weight(stencil, p, e, steps, S):
    """Return row `e` of those that a particle sees, and its weight; S: weights at its nodes."""
    line = stencil.near[p]
    if line < 0:
        return stencil.base[p] + steps[e], S[e]
    return stencil.table[line, e], stencil.share[line, e] * S[stencil.which[line, e]]


@kernel
def entry_gradient(stencil, like, line, e, S, G):
    """Return the gradient of the weight of entry `e`, that of its share included (per cell).

    S, G: weights and gradients of the particle at its nodes
    """
    k, share = stencil.which[line, e], stencil.share[line, e]
    return plus(times(pick(G, k), share), S[k], vector_of(like, stencil.bend, line, e))


@kernel
def first_line(stencil, p):
    """Return the first line of the lists that belongs to particle `p` or a later one."""
    low, high = 0, stencil.count[0]
    while low < high:
        middle = (low + high) // 2
        if stencil.listed[middle] < p:
            low = middle + 1
        else:
            high = middle
    return low
