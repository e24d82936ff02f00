"""Tractions on faces of particles, spread with linear functions from the ends of the face."""

from typing import NamedTuple

import numpy as np

from cramp_cli.numerics.kernel import kernel
from cramp_cli.numerics.tensor import dot, plus, vector
from cramp_cli.shapes.shape import offsets, point_weights


class Faces(NamedTuple):
    """Corners of loaded particle faces and the force that each carries under unit load."""

    particle: np.ndarray  # (n,)
    corner: np.ndarray  # (n, dim) from the particle's centre, in cells
    force: np.ndarray  # (n, dim) traction times the corner's share of the face, N


@kernel
def add_traction(grid, stencil, faces, shape, strides, factor):
    """Add factor times the face forces to the grid.

    The corner of a particle lies among the nodes of the particle, so its rows are the particle's.
    """
    force = grid.force
    base, local, near, table = stencil.base, stencil.local, stencil.near, stencil.table
    particle, corner, load = faces.particle, faces.corner, faces.force
    steps = offsets(strides, shape)
    for c in range(len(particle)):
        p = particle[c]
        S = point_weights(plus(vector(strides, local, p), 1.0, vector(strides, corner, c)), shape)
        first, line = base[p], near[p]
        for k in range(len(steps)):
            row = first + steps[k] if line < 0 else table[line, k]
            for d in range(len(strides)):
                force[row, d] += factor * S[k] * load[c, d]


@kernel
def traction_power(grid, stencil, faces, shape, strides):
    """Return the power of the face forces under unit load with the momenta of the grid (W)."""
    momentum, mass = grid.momentum, grid.mass
    base, local, near, table = stencil.base, stencil.local, stencil.near, stencil.table
    particle, corner, load = faces.particle, faces.corner, faces.force
    steps = offsets(strides, shape)
    power = 0.0
    for c in range(len(particle)):
        p = particle[c]
        S = point_weights(plus(vector(strides, local, p), 1.0, vector(strides, corner, c)), shape)
        first, line = base[p], near[p]
        for k in range(len(steps)):
            row = first + steps[k] if line < 0 else table[line, k]
            if mass[row] > 0.0:
                p_dot_f = dot(vector(strides, momentum, row), vector(strides, load, c))
                power += S[k] * p_dot_f / mass[row]
    return power
