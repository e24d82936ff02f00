"""G of a kink of 90 degrees along an interface over G of a crack that goes on through it.

The problem of He and Hutchinson (1989): a long crack meets the plane between two solids squarely.
Prints alpha of Dundurs and the ratio: `python deflection.py -0.5 -0.25 0 0.25 0.5 0.75`, minutes.
"""

import sys

import numpy as np
from finite_elements import Grid, hooke

NU, CELLS, GROWING, FAR = 0.3, 6, 1.25, 1e5  # the kink has six elements, the body is far larger


def lines():
    """Return element borders: equal around 0, then ever larger."""
    out, step = [2.0 * CELLS], 1.0
    while out[-1] < FAR:
        step *= GROWING
        out.append(out[-1] + step)
    fine = np.arange(-2 * CELLS, 2 * CELLS + 1, dtype=float)
    return np.concatenate([-np.array(out[:0:-1]), fine, out[1:]])


def energy(ahead, deflected, length):
    """Return the energy at given displacements of the far edges with a kink of so many elements."""
    x = lines()
    grid, o = Grid(x, x), int(np.flatnonzero(x == 0.0)[0])
    end = o if deflected else o + length
    row = 2 * o * grid.nx
    cut = {row + i for i in range(2 * end + (1 if deflected else 0))}
    grid.part(cut, (grid.j == o) & (grid.i < end))
    if deflected:
        cut = {2 * o + j * grid.nx for j in range(2 * o + 1, 2 * (o + length))}
        grid.part(cut, (grid.i == o - 1) & (grid.j >= o) & (grid.j < o + length))
    K = grid.stiffness(hooke(1.0, NU), np.where(grid.i >= o, ahead, 1.0))
    held = {2 * (row + grid.nx - 1): 0.0}
    for j, value in ((0, -1.0), (grid.ny - 1, 1.0)):
        held |= {2 * (i + j * grid.nx) + 1: value for i in range(grid.nx)}
    u = grid.solve(K, held)
    return 0.5 * u @ (K @ u)


def ratio(alpha):
    """Return G along the interface over G through it."""
    ahead = (1 + alpha) / (1 - alpha)
    G = [energy(ahead, d, CELLS - 1) - energy(ahead, d, CELLS + 1) for d in (True, False)]
    return G[0] / G[1]


if __name__ == "__main__":
    for alpha in map(float, sys.argv[1:]):
        print(alpha, round(ratio(alpha), 4), flush=True)
