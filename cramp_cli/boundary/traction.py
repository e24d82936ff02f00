"""Tractions on faces of particles, spread from the ends of the face.

The functions are linear, or the splines: a node outside the body then carries what it must.
"""

from typing import NamedTuple

import numpy as np

from cramp_cli.numerics.kernel import kernel
from cramp_cli.numerics.vector import dot, times, vector
from cramp_cli.shapes.shape import offsets, own_shape, place_of, point_weights
from cramp_cli.state.particles import DELETED
from cramp_cli.transfer.rows import add, row_and_weight, rows_seen


class Faces(NamedTuple):
    """Corners of loaded particle faces and the force that each carries under unit load."""

    particle: np.ndarray  # (n,) numbers of particles
    corner: np.ndarray  # (n, dim) from the particle's centre at the start, in cells
    force: np.ndarray  # (n, dim) traction times the corner's share of the face, N


@kernel
def add_traction(field, stencil, index, faces, shape, strides, factor):
    """Add factor times the face forces to a field (rows, dim) of the grid.

    index: where the particle of a number is. The corner of a particle lies among the nodes of the
    particle, so its rows are the particle's.
    """
    particle, corner, load = faces.particle, faces.corner, faces.force
    steps = offsets(strides, shape)
    for c in range(len(particle)):
        p = index[particle[c]]
        if p == DELETED:
            continue
        place = place_of(shape, strides, stencil, p)
        S = point_weights(place, own_shape(shape, stencil, p), vector(strides, corner, c))
        f = times(vector(strides, load, c), factor)
        for e in range(rows_seen(stencil, p, steps)):
            row, w = row_and_weight(stencil, p, e, steps, S)
            add(field, row, w, f)


@kernel
def traction_power(grid, stencil, index, faces, shape, strides):
    """Return the power of the face forces under unit load with the momenta of the grid (W)."""
    particle, corner, load = faces.particle, faces.corner, faces.force
    steps = offsets(strides, shape)
    power = 0.0
    for c in range(len(particle)):
        p = index[particle[c]]
        if p == DELETED:
            continue
        place = place_of(shape, strides, stencil, p)
        S = point_weights(place, own_shape(shape, stencil, p), vector(strides, corner, c))
        f = vector(strides, load, c)
        for e in range(rows_seen(stencil, p, steps)):
            row, w = row_and_weight(stencil, p, e, steps, S)
            power += w * dot(row_velocity(strides, grid, row), f)
    return power


@kernel
def row_velocity(like, grid, row):
    """Return p/m of a row, zero without mass."""
    mass = grid.mass[row]
    return times(vector(like, grid.momentum, row), 1.0 / mass if mass > 0.0 else 0.0)
