"""Regions of a deck as lines and places that a picture can show."""

from typing import NamedTuple

import numpy as np

from cramp_cli.deck.deck import Deck
from cramp_cli.deck.where import Where

THIN = 1e-3  # of a cell: how near a face lies to the plane that names it


class Region(NamedTuple):
    """Where a load or a boundary acts."""

    lines: list[np.ndarray]  # pieces of a plane on the body, each (2, 2) in m; none for an area
    area: object  # the part of the body in a box, a shapely geometry; None for a plane
    centre: np.ndarray  # of the region, or of all bodies if it meets none (m)
    body: object  # what it acts on, a shapely geometry

    def places(self, most: int, way: np.ndarray, apart: float) -> np.ndarray:
        """Return up to `most` places (n, 2) for arrows, the centre of an area (m).

        way: direction of the arrows; those along a line are at least `apart` (m)
        """
        if not self.lines:
            return self.centre[None, :]
        total = sum(map(_length, self.lines))
        parts = []
        for line in self.lines:
            along = abs((line[1] - line[0]) @ way) > 0.5 * _length(line) * np.hypot(*way)
            room = int(_length(line) / apart) if along else most
            count = max(1, min(room, round(most * _length(line) / total)))
            shares = (np.arange(count) + 0.5) / count
            parts.append(line[0] + shares[:, None] * (line[1] - line[0]))
        return np.vstack(parts)

    def inward(self) -> np.ndarray:
        """Return the unit vector from a face into the body."""
        from shapely import Point

        along = self.lines[0][1] - self.lines[0][0] if self.lines else np.array([1.0, 0.0])
        normal = np.array([-along[1], along[0]]) / np.hypot(*along)
        middle = self.lines[0].mean(axis=0) if self.lines else self.centre
        probe = middle + 1e-3 * np.hypot(*along) * normal
        return normal if self.body.covers(Point(*probe)) else -normal


def solid_outlines(deck: Deck) -> dict[int, object]:
    """Return what later bodies leave of each body that is no hole, as shapely geometries."""
    from shapely import STRtree, union_all

    outlines = [body.shape.outline() for body in deck.bodies]
    tree, left = STRtree(outlines), {}
    for number, body in enumerate(deck.bodies):
        later = [outlines[other] for other in tree.query(outlines[number]) if other > number]
        if not body.hole:
            left[number] = outlines[number] - union_all(later)
    return left


def exteriors(geometry) -> list[tuple[np.ndarray, list[np.ndarray]]]:
    """Return outer ring and holes of each piece of a geometry, as (n, 2) points (m)."""
    pieces = getattr(geometry, "geoms", [geometry])
    return [
        (np.array(piece.exterior.coords), [np.array(ring.coords) for ring in piece.interiors])
        for piece in pieces
        if piece.geom_type == "Polygon" and not piece.is_empty
    ]


def region_of(where: Where, body, cell: float) -> Region:
    """Return the part of a body that a `where` of the deck names.

    cell: width of a cell (m); a plane that passes the body at less than a cell shows as its part
    beside the body
    """
    from shapely import LineString, box

    x0, y0, x1, y1 = body.bounds
    low, high = np.array([x0, y0]) - cell, np.array([x1, y1]) + cell
    for axis in range(2):
        span = where.span(axis)
        if span:
            low[axis], high[axis] = max(low[axis], span[0]), min(high[axis], span[1])
    if not where.planes:
        part = body & box(*np.minimum(low, high), *np.maximum(low, high))
        found = part if not part.is_empty else body
        return Region([], found, np.array(found.centroid.coords[0]), body)
    for near in (THIN, 0.51, 1.01):
        part = body.buffer(near * cell, join_style="mitre") & LineString([low, high])
        pieces = [p for p in getattr(part, "geoms", [part]) if p.length > 0.0]
        if pieces:
            break
    lines = [np.array(piece.coords)[[0, -1]] for piece in pieces]
    return Region(lines, None, np.array(body.centroid.coords[0]), body)


def _length(line: np.ndarray) -> float:
    return float(np.hypot(*(line[1] - line[0])))
