"""Eight-node elements on a tensor grid with slits: references that know nothing of the program.

Plane strain, small strain; nodes of a slit are doubled. Our own.
"""

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import splu

CORNERS = [(-1, -1), (1, -1), (1, 1), (-1, 1), (0, -1), (1, 0), (0, 1), (-1, 0)]
GAUSS = [(-np.sqrt(0.6), 5 / 9), (0.0, 8 / 9), (np.sqrt(0.6), 5 / 9)]


def hooke(E, nu):
    """Return the stiffness of plane strain, (3, 3)."""
    rest = 0.5 * (1 - 2 * nu)
    return (
        E / ((1 + nu) * (1 - 2 * nu)) * np.array([[1 - nu, nu, 0], [nu, 1 - nu, 0], [0, 0, rest]])
    )


def slopes(r, s):
    """Return the derivatives of the eight shape functions by r and s, (8, 2)."""
    found = []
    for a, b in CORNERS:
        if a and b:
            t = a * r + b * s
            found.append(
                (0.25 * a * (1 + b * s) * (t + a * r), 0.25 * b * (1 + a * r) * (t + b * s))
            )
        elif a == 0:
            found.append((-r * (1 + b * s), 0.5 * b * (1 - r * r)))
        else:
            found.append((0.5 * a * (1 - s * s), -s * (1 + a * r)))
    return np.array(found)


class Grid:
    """Elements between lines x and y (m); node (i, j) counts in half elements."""

    def __init__(self, x, y):
        self.x, self.y = np.asarray(x, float), np.asarray(y, float)
        self.nx, self.ny = 2 * len(x) - 1, 2 * len(y) - 1
        self.i, self.j = (v.ravel() for v in np.meshgrid(range(len(x) - 1), range(len(y) - 1)))
        places = [(2 * self.i + 1 + a) + (2 * self.j + 1 + b) * self.nx for a, b in CORNERS]
        self.nodes = np.stack(places, axis=1)
        self.count = self.nx * self.ny

    def part(self, nodes, elements):
        """Give some elements copies of some nodes of their own: a slit."""
        new = {n: self.count + k for k, n in enumerate(sorted(nodes))}
        self.count += len(new)
        for e in np.flatnonzero(elements):
            self.nodes[e] = [new.get(n, n) for n in self.nodes[e]]

    def stiffness(self, C, factor):
        """Return the matrix for a stiffness C times a factor of each element."""
        hx, hy = np.diff(self.x)[self.i], np.diff(self.y)[self.j]
        K = np.zeros((len(hx), 16, 16))
        for r, wr in GAUSS:
            for s, ws in GAUSS:
                d, B = slopes(r, s), np.zeros((len(hx), 3, 16))
                B[:, 0, 0::2] = B[:, 2, 1::2] = 2 * d[:, 0] / hx[:, None]
                B[:, 1, 1::2] = B[:, 2, 0::2] = 2 * d[:, 1] / hy[:, None]
                weight = 0.25 * wr * ws * hx * hy * factor
                K += np.einsum("eki,kl,elj->eij", B, C, B, optimize=True) * weight[:, None, None]
        dof = np.stack([2 * self.nodes, 2 * self.nodes + 1], axis=2).reshape(len(hx), 16)
        where = (np.repeat(dof, 16, axis=1).ravel(), np.tile(dof, (1, 16)).ravel())
        return coo_matrix((K.ravel(), where), shape=(2 * self.count,) * 2).tocsr()

    def solve(self, K, prescribed):
        """Return displacements (2 * nodes,); prescribed: value by number of displacement."""
        fixed = np.ones(2 * self.count, dtype=bool)
        for axis in (0, 1):
            fixed[2 * self.nodes.ravel() + axis] = False
        u = np.zeros(2 * self.count)
        for n, value in prescribed.items():
            fixed[n], u[n] = True, value
        free = np.flatnonzero(~fixed)
        u[free] = splu(K[free][:, free].tocsc()).solve(-(K @ u)[free])
        return u
