"""The particles in a region of the deck, and the faces of bodies that lie on a plane.

A face is where the outline of a body runs along the plane, so it ends where shape and deck say. It
is cut where particles meet; each piece belongs to the particle behind it.
"""

from collections.abc import Iterator
from functools import cached_property
from math import nan, sqrt
from typing import NamedTuple

import numpy as np

from cramp_cli.boundary.traction import Faces
from cramp_cli.build.coverage import snapped
from cramp_cli.build.surface import rings_of
from cramp_cli.deck.regions import Regions
from cramp_cli.materials.geometry import PlaneStress, depth
from cramp_cli.materials.law import confined_modulus, shear_modulus
from cramp_cli.shapes.linear import Linear

ON_FACE = 0.1  # of half a particle: how near to a plane a face must lie
SAME = 1e-6  # cells
MOST_PAIRS = 1_000_000  # of pieces and particles compared at a time


class Pieces(NamedTuple):
    """Pieces of faces on a plane, n of them."""

    particle: np.ndarray  # (n,)
    low: np.ndarray  # (n,) where it begins along the plane (m)
    high: np.ndarray  # (n,) where it ends
    sign: np.ndarray  # (n,) of the outward normal


class Surface:
    """Finds what conditions on a part of the bodies act on."""

    def __init__(self, deck, lattice, geometry, particles, blocks, half):
        self.bodies, self.lattice = deck.bodies, lattice
        self.width, self.geometry = lattice.width, geometry
        self.particles, self.blocks, self.half = particles, blocks, half
        full = np.concatenate([np.full(b.hi - b.lo, b.shape.half[0] * 2.0) for b in blocks])
        deep = depth(geometry, particles.origin[:, 0])
        self.share = particles.volume / ((full * lattice.width) ** 2 * deep)  # of a full particle
        self.share[np.abs(self.share - 1.0) < SAME] = 1.0
        self._regions, self._rings = Regions(deck.bodies), {}

    @cached_property
    def solids(self) -> list[int]:
        """Numbers of the bodies that have a stress."""
        return [n for n, body in enumerate(self.bodies) if not (body.hole or body.rigid)]

    def all_particles(self, where) -> np.ndarray:
        """Return the particles of all bodies that particles in a region may belong to."""
        return np.concatenate([self.particles_of(body, where) for body in self.solids])

    def particles_of(self, body, where) -> np.ndarray:
        """Return the particles of a body in a region; on a plane, those whose box touches it."""
        inside, planes = self.particles.body == body, {axis for axis, _ in where.planes}
        for d in range(2):
            low, high = span(where, d, 0.0)
            grown = (self.half[:, d] if d in planes else 0.0) * self.width + SAME * self.width
            x = self.particles.origin[:, d]
            inside &= (x >= low - grown) & (x <= high + grown)
        return np.flatnonzero(inside)

    def shares_of(self, body, where) -> tuple[np.ndarray, np.ndarray]:
        """Return the particles of a body with something in a region, and which share that is."""
        mine, planes = np.flatnonzero(self.particles.body == body), {a for a, _ in where.planes}
        share = np.ones(len(mine))
        for d in range(2):
            low, high = span(where, d, 0.0)
            x, half = self.particles.origin[mine, d], self.half[mine, d] * self.width
            if d in planes:
                share *= np.abs(x - low) <= half + SAME * self.width
            else:
                within = np.minimum(x + half, high) - np.maximum(x - half, low)
                share *= np.clip(within / (2.0 * half), 0.0, 1.0)
        share[share > 1.0 - SAME] = 1.0
        some = share > SAME
        return mine[some], share[some]

    def faces_of(self, bodies, where) -> Iterator[tuple]:
        """Yield block and pieces of the faces of some bodies on the plane of a region."""
        found = [self._faces(body, where) for body in bodies]
        pieces = Pieces(*(np.concatenate(column) for column in zip(*found, strict=True)))
        pieces = Pieces(*(column[np.lexsort((pieces.low, pieces.particle))] for column in pieces))
        for block in self.blocks:
            mine = (pieces.particle >= block.lo) & (pieces.particle < block.hi)
            if mine.any():
                yield block, Pieces(*(column[mine] for column in pieces))

    def _faces(self, body, where) -> Pieces:
        """Return the pieces of a body's faces on the plane of a region."""
        (axis, at), box = where.planes[0], self.width / self.bodies[body].particles_per_cell
        low, high, sign = flat_edges(self.rings(body), axis, at, 0.5 * ON_FACE * box)
        limits = span(where, 1 - axis, 0.0)
        low, high = np.maximum(low, limits[0]), np.minimum(high, limits[1])
        kept = high - low > SAME * self.width
        low, high, sign = low[kept], high[kept], sign[kept]
        origin = self.lattice.lower[1 - axis]
        cut = [_cut((a - origin) / box, (b - origin) / box) for a, b in zip(low, high, strict=True)]
        sign = np.repeat(sign, np.array([len(lines) - 1 for lines in cut], dtype=int))
        low = origin + box * np.concatenate([lines[:-1] for lines in cut] or [np.zeros(0)])
        high = origin + box * np.concatenate([lines[1:] for lines in cut] or [np.zeros(0)])
        middle = np.full((len(low), 2), at)
        middle[:, 1 - axis] = 0.5 * (low + high)
        return Pieces(self._owners(body, middle), low, high, sign)

    def rings(self, body) -> list:
        """Return the outline of a body without what later ones cover: closed lines."""
        if body not in self._rings:
            self._rings[body] = rings_of(self._regions.left(body))
        return self._rings[body]

    def _owners(self, body, places) -> np.ndarray:
        """Return the particle of a body whose box is nearest to each place (n, 2), m."""
        if not len(places):
            return np.zeros(0, dtype=np.int64)
        mine = np.flatnonzero(self.particles.body == body)
        x, half = self.particles.origin[mine], self.half[mine] * self.width
        low, high = places.min(axis=0) - 2.0 * self.width, places.max(axis=0) + 2.0 * self.width
        near = np.all((x >= low) & (x <= high), axis=1)
        mine, x, half = mine[near], x[near], half[near]
        chunk = max(MOST_PAIRS // len(mine), 1)
        return np.concatenate([
            mine[_nearest(places[n : n + chunk], x, half)] for n in range(0, len(places), chunk)
        ])  # fmt: skip

    def corners(self, block, pieces, axis, at, stress) -> Faces:
        """Return both ends of every piece of a face on a plane, with stress times their areas."""
        particle, width, other = np.repeat(pieces.particle, 2), self.width, 1 - axis
        corner, half = np.empty((len(particle), 2)), self.half[particle]
        corner[:, axis] = (at - self.particles.origin[particle, axis]) / width
        ends = np.stack([pieces.high, pieces.low], axis=1).ravel()
        corner[:, other] = (ends - self.particles.origin[particle, other]) / width
        corner = np.where(np.abs(np.abs(corner) - half) < SAME, np.copysign(half, corner), corner)
        length = np.repeat(corner[0::2, other] - corner[1::2, other], 2)
        # Along a radius an end's share of the face is that of the ring a third of the way out.
        middle = np.repeat(0.5 * (corner[0::2, 0] + corner[1::2, 0]), 2)
        out = corner[:, 0] if axis == 0 else middle + (corner[:, 0] - middle) / 3.0
        radius = self.particles.origin[particle, 0] + width * out
        force = stress * (0.5 * length * width * depth(self.geometry, radius)).reshape(-1, 1)
        corner = np.clip(corner, -half, half)  # beyond its box a particle may see no node
        if isinstance(getattr(block.shape, "plain", block.shape), Linear):
            corner[:] = 0.0  # a point sees no node beyond its own cell
        return Faces(particle, corner, force)


def flat_edges(rings, axis, at, tolerance) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return where edges that lie on a plane begin and end along it (m), and their normals' signs.

    rings: closed lines with the body at their left; tolerance: how far off the plane ends may be
    """
    start = np.concatenate([ring[:-1] for ring in rings])
    end = np.concatenate([ring[1:] for ring in rings])
    flat = np.all(np.abs(np.stack([start, end])[:, :, axis] - at) <= tolerance, axis=0)
    a, b = start[flat, 1 - axis], end[flat, 1 - axis]
    sign = np.sign(b - a) * (1.0 if axis == 0 else -1.0)
    return np.minimum(a, b), np.maximum(a, b), sign


def _cut(low, high) -> np.ndarray:
    """Return the ends of a stretch and the whole numbers between them, in order."""
    low, high = snapped(np.array([low, high]))
    return np.array([low, *np.arange(np.floor(low) + 1.0, np.ceil(high)), high])


def _nearest(places, x, half) -> np.ndarray:
    """Return which box is nearest to each place; of those that hold it, that of nearest centre.

    places: (n, 2); x, half: (m, 2) centres and half sizes of the boxes
    """
    away = np.abs(places[:, None, :] - x)
    beyond = np.sum(np.maximum(away - half, 0.0) ** 2, axis=2)
    return np.argmin(beyond + SAME**2 * np.sum(away**2, axis=2), axis=1)


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
