"""Where the particles of a body are at the start, and how much of it each one carries.

Cells are cut into equal boxes. A box inside the body makes a particle at its centre. One that the
border of the body passes makes a particle of the part inside: with its area, at its centroid. So
mass and first moment of a body are those of its shape, wherever it lies in the grid.
"""

from typing import NamedTuple

import numpy as np
from shapely.errors import ShapelyError

from cramp_cli.build.coverage import Coverage, coverage
from cramp_cli.build.slivers import least_share, without_slivers
from cramp_cli.build.surface import outline_of, rings_of, settled, with_images
from cramp_cli.deck.deck import DeckError
from cramp_cli.deck.regions import Regions

ON_PLANE = 1e-6  # cells
BOX = 1e-3  # a part whose area differs by less from that of its box is one
WIDEST = 0.5  # cells; half size of a particle at most, or it would see nodes that no function has


class Seeds(NamedTuple):
    """The particles of a body at the start."""

    position: np.ndarray  # (n, 2) m
    share: np.ndarray  # (n,) volume, by that of a full particle at the same place
    half: np.ndarray  # (n, 2) half size along each axis, in cells
    reach: np.ndarray  # (n, 2) half axes of the ellipse that touches other bodies, in cells


def seed_bodies(deck, lattice) -> list[Seeds]:
    """Return the particles of every body; those of a rigid one lie along its outline.

    What a later body covers is left to that body.

    Raises DeckError for a body without particles.
    """
    regions = Regions(deck.bodies)
    return [_of_body(deck, lattice, regions, number) for number in range(len(deck.bodies))]


def _of_body(deck, lattice, regions, number) -> Seeds:
    body, place = deck.bodies[number], ("bodies", number, "shape")
    if body.hole:
        return _none()
    if body.rigid:
        seeds = _of_rigid(deck, lattice, number)
    else:
        try:
            seeds = _of_solid(deck, lattice, regions.left(number), body.particles_per_cell)
        except ShapelyError as problem:  # shapes too odd to compute with
            raise DeckError([deck.mistake(place, f"cannot be filled: {problem}")]) from None
    if not len(seeds.position):
        message = "holds no particle: it is smaller than a cell, or later bodies cover it"
        raise DeckError([deck.mistake(place, message)])
    return seeds


def _of_solid(deck, lattice, region, per_cell) -> Seeds:
    box = lattice.width / per_cell
    rings = rings_of(region)
    if not rings:
        return _none()
    seeds = gathered(coverage([(ring - lattice.lower) / box for ring in rings]), lattice, per_cell)
    if deck.contact.bodies is None:
        return seeds
    outline = with_images(region, deck, ON_PLANE * lattice.width).boundary
    return _touching(seeds, outline, lattice.width, per_cell)


def _none() -> Seeds:
    return Seeds(np.zeros((0, 2)), np.zeros(0), np.zeros((0, 2)), np.zeros((0, 2)))


def are_sized(seeds) -> bool:
    """Return whether some particle is not full, or has a sliver beside it."""
    return any(np.any(one.share != 1.0) or np.any(one.half != one.half[:1]) for one in seeds)


def _touching(seeds: Seeds, outline, width: float, per_cell: int) -> Seeds:
    """Return particles of which those that are no boxes touch others with a circle.

    It is inscribed in the outline, which so lies where it is.

    outline: with that of the image behind symmetry planes, where there is no surface; width: of a
    cell (m)
    """
    import shapely

    boxes = 4.0 * per_cell**2 * seeds.half.prod(axis=1)
    odd = np.flatnonzero(np.abs(boxes - seeds.share) > BOX)
    reach = seeds.reach.copy()
    shapely.prepare(outline)
    away = shapely.distance(outline, shapely.points(seeds.position[odd])) / width
    reach[odd] = np.maximum(away, ON_PLANE)[:, None]
    return seeds._replace(reach=reach)


def gathered(parts: Coverage, lattice, per_cell: int) -> Seeds:
    """Return a particle for every box, but none for those that hold next to nothing."""
    parts, low, high = without_slivers(parts, least_share(per_cell))
    centre = parts.first / parts.area[:, None]
    spread = np.maximum(parts.second / parts.area[:, None] - centre**2, 0.0)
    # The box with the same second moment; the part itself, if it is a box. It keeps to the boxes
    # it comes from: within a cell the mean slope of a function is then that over the part.
    half = np.minimum(np.sqrt(3.0 * spread), np.minimum(centre - low, high - centre))
    half = np.clip(half / per_cell, ON_PLANE, WIDEST)
    whole = (parts.area == 1.0) & np.all(high - low == 1.0, axis=1)
    half[whole] = 0.5 / per_cell
    position = lattice.lower + lattice.width / per_cell * (parts.box + centre)
    return Seeds(position, parts.area, half, half)


def _of_rigid(deck, lattice, number) -> Seeds:
    """Return the centres of the boxes inside, those at the border moved to touch the outline."""
    body, width = deck.bodies[number], lattice.width
    per_cell = body.particles_per_cell
    low, high = (np.asarray(corner) for corner in body.shape.bounds())
    first = np.floor((low - lattice.lower) / width - ON_PLANE).astype(int)
    last = np.ceil((high - lattice.lower) / width + ON_PLANE).astype(int)
    axes = [
        lattice.lower[d]
        + width / per_cell * (np.arange(per_cell * first[d], per_cell * last[d]) + 0.5)
        for d in range(2)
    ]
    points = np.stack([m.ravel() for m in np.meshgrid(*axes)], axis=1)
    points = points[body.shape.contains(points)]
    for later in deck.bodies[number + 1 :]:
        points = points[~later.shape.contains(points)]
    points = settled(points, outline_of(deck, number, width), 0.5 * width / per_cell)
    half = np.full((len(points), 2), 0.5 / per_cell)
    return Seeds(points, np.ones(len(points)), half, half)
