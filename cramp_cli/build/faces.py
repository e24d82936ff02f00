"""Particles in a region of the deck, and the faces of those that lie on a plane."""

from collections.abc import Iterator
from math import nan, sqrt

import numpy as np

from cramp_cli.boundary.traction import Faces
from cramp_cli.materials.geometry import PlaneStress, depth
from cramp_cli.materials.law import confined_modulus, shear_modulus
from cramp_cli.shapes.linear import Linear

ON_FACE = 0.1  # of half a particle: how near to its face a plane must lie


class Surface:
    """Finds what conditions on a part of the bodies act on."""

    def __init__(self, deck, lattice, geometry, particles, blocks):
        self.bodies, self.width, self.geometry = deck.bodies, lattice.width, geometry
        self.particles, self.blocks = particles, blocks

    def all_particles(self, where) -> np.ndarray:
        """Return the particles of all bodies that particles in a region may belong to."""
        solid = [n for n, body in enumerate(self.bodies) if not (body.hole or body.rigid)]
        return np.concatenate([self.particles_of(body, where) for body in solid])

    def particles_of(self, body, where) -> np.ndarray:
        """Return the particles of a body in a region; on a plane, those whose box touches it."""
        half = 0.5 * self.width / self.bodies[body].particles_per_cell
        inside, planes = self.particles.body == body, {axis for axis, _ in where.planes}
        for d in range(2):
            low, high = span(where, d, 0.0)
            grown = (half if d in planes else 0.0) + 1e-6 * self.width
            x = self.particles.origin[:, d]
            inside &= (x >= low - grown) & (x <= high + grown)
        return np.flatnonzero(inside)

    def faces_at(self, candidates, axis, at) -> Iterator[tuple]:
        """Yield block, particles and signs of the outward normals of faces on a plane."""
        for block in self.blocks:
            mine = candidates[(candidates >= block.lo) & (candidates < block.hi)]
            offset = at - self.particles.origin[mine, axis]
            half = block.shape.half[axis] * self.width
            on_face = np.abs(np.abs(offset) - half) <= ON_FACE * half
            if on_face.any():
                yield block, mine[on_face], np.sign(offset[on_face])

    def corners(self, block, chosen, axis, sign, stress) -> Faces:
        """Return both corners of a face of each particle, with stress times their areas."""
        half, width, other = block.shape.half, self.width, 1 - axis
        corners = np.zeros((2, 2))
        corners[:, axis] = sign * half[axis]
        corners[:, other] = half[other], -half[other]
        # Along a radius a corner's share of the face is that of the ring a third of the way out.
        out = corners[:, 0] if axis == 0 else corners[:, 0] / 3.0
        radius = self.particles.origin[chosen, 0][:, None] + width * out
        if isinstance(getattr(block.shape, "plain", block.shape), Linear):
            corners[:] = 0.0  # a point sees no node beyond its own cell
        share = half[other] * width * depth(self.geometry, radius)
        return Faces(
            particle=np.repeat(chosen, 2),
            corner=np.tile(corners, (len(chosen), 1)),
            force=stress * share.reshape(-1, 1),
        )


def impedances(block, geometry) -> tuple[float, float]:
    """Return density times the speeds of plane waves along and across their way (Pa s/m).

    In plane stress the plate is free to become thinner: M' = M - lambda^2/M. Both are nan where
    the law has no speeds that are the same in all directions.
    """
    modulus, shear = confined_modulus(block.law), shear_modulus(block.law)
    if np.isnan(shear):
        return nan, nan
    if isinstance(geometry, PlaneStress):
        modulus -= (modulus - 2.0 * shear) ** 2 / modulus
    return sqrt(block.density * modulus), sqrt(block.density * shear)


def span(where, axis, tolerance) -> tuple[float, float]:
    """Return the limits of a region along an axis (m), infinite where it has none."""
    limits = where.span(axis)
    return (-np.inf, np.inf) if limits is None else (limits[0] - tolerance, limits[1] + tolerance)
