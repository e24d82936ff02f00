"""Mistakes and doubts about cracks: where they lie and how finely they are cut."""

from collections.abc import Iterator
from math import hypot
from typing import Any

from cramp_cli.deck.bodies import BodySection
from cramp_cli.deck.cracks import CrackSection
from cramp_cli.deck.parts import Parts
from cramp_cli.schema.section import Wrong

MOST_PIECES = 1_000_000
SHORTEST, LONGEST = 0.1, 2.0  # cells; usual length of a crack's pieces


def crack_mistakes(parts: Parts) -> Iterator[Wrong]:
    """Yield cracks outside all bodies and cracks cut into too many pieces."""
    total = 0.0
    for place, crack in parts.cracks:
        longest = crack.segment or (parts.grid.cell / 2 if parts.grid else crack.length)
        pieces = crack.length / longest
        total += pieces
        if total > MOST_PIECES:
            key, total = ("segment",) if crack.segment else (), 0.0
            of_all = "" if pieces > MOST_PIECES else ", all cracks together"
            message = f"would be cut into {pieces:.3g} pieces (at most {MOST_PIECES}{of_all})"
            yield ("cracks", place, *key), message
    if parts.all_bodies and parts.solids:
        regions = _regions(parts)
        for place, crack in parts.cracks:
            if _length_inside(crack, regions) <= 1e-9 * crack.length:
                yield ("cracks", place), "lies wholly outside every body"


def _regions(parts: Parts) -> list[tuple]:
    """Return bounds, outline and whether it is a hole for each body, in the order of the deck."""
    if not parts.cracks:
        return []
    return [(*_flat(body), body.shape.outline(), body.hole) for _, body in parts.bodies]


def _flat(body: BodySection) -> tuple[float, float, float, float]:
    lower, upper = body.shape.bounds()
    return (*lower, *upper)


def _near(regions: list[tuple], line: Any) -> list[tuple]:
    """Return outline and hole of those regions whose bounds touch those of a line."""
    a, b, c, d = line.bounds
    return [
        (outline, hole)
        for x0, y0, x1, y1, outline, hole in regions
        if x0 <= c and x1 >= a and y0 <= d and y1 >= b
    ]


def _length_inside(crack: CrackSection, regions: list[tuple]) -> float:
    """Return how much of a crack (m) lies in bodies and not in later holes."""
    import shapely

    line, inside = shapely.LineString(crack.corners), shapely.LineString()
    try:
        for outline, hole in _near(regions, line):
            inside = inside - outline if hole else inside | (line & outline)
    except shapely.errors.ShapelyError:  # shapes too odd to compute with: nothing is claimed
        return crack.length
    return inside.length


def _is_outside(point: tuple[float, float], regions: list[tuple]) -> bool:
    """Return whether a point is in no body, or in a later hole."""
    import shapely

    spot = shapely.Point(point)
    holes = [hole for outline, hole in _near(regions, spot) if outline.intersects(spot)]
    return not holes or holes[-1]


def _ahead(point, before, distance: float) -> tuple[float, float]:
    """Return the place at a distance (m) out of a crack that ends at a point."""
    size = hypot(point[0] - before[0], point[1] - before[1]) or 1.0
    x, y = (p + distance * (p - b) / size for p, b in zip(point, before, strict=True))
    return x, y


def crack_warnings(parts: Parts) -> Iterator[Wrong]:
    """Yield what is possible but seldom meant: coarse particles, odd pieces, tips in the air."""
    cell, regions = parts.grid.cell, _regions(parts)
    for place, crack in parts.cracks:
        path = ("cracks", place)
        if crack.segment and not SHORTEST * cell <= crack.segment <= LONGEST * cell:
            share = crack.segment / cell
            usual = f"usual are {SHORTEST:g} to {LONGEST:g}"
            yield (*path, "segment"), f"is {share:.3g} cells; {usual}"
        for key, point, before in (("start", *crack.corners[:2]), ("end", *crack.corners[:-3:-1])):
            if getattr(crack, key) != "tip":
                continue
            if _is_outside(_ahead(point, before, cell), regions):
                yield (*path, key), "is a tip within a cell of free space; 'edge' may be meant"
        yield from _coarse_bodies(parts, crack)


def _coarse_bodies(parts: Parts, crack: CrackSection) -> Iterator[Wrong]:
    for place, body in parts.solids:
        if body.particles_per_cell > 1:
            continue
        if _length_inside(crack, [(*_flat(body), body.shape.outline(), False)]) > 0.0:
            message = f"fewer than 2 along each side of a cell, but crack {crack.name} runs here"
            yield ("bodies", place, "particles_per_cell"), message
