"""Mistakes and doubts about cracks: where they lie and how finely they are cut."""

from collections.abc import Iterator
from typing import Any

from cramp_cli.deck.cracks import CrackSection
from cramp_cli.deck.parts import Parts
from cramp_cli.schema.section import Wrong

MOST_PIECES = 1_000_000
SHORTEST, LONGEST = 0.1, 2.0  # cells; usual length of a crack's pieces


def crack_mistakes(parts: Parts) -> Iterator[Wrong]:
    """Yield cracks outside all bodies and cracks cut into too many pieces."""
    for place, crack in parts.cracks:
        longest = crack.segment or (parts.grid.cell / 2 if parts.grid else crack.length)
        pieces = crack.length / longest
        if pieces > MOST_PIECES:
            key = ("segment",) if crack.segment else ()
            message = f"would be cut into {pieces:.3g} pieces (at most {MOST_PIECES})"
            yield ("cracks", place, *key), message
    if not parts.all_bodies or not parts.solids or not parts.cracks:
        return
    solid = solid_region(parts)
    for place, crack in parts.cracks:
        if solid is not None and _length_inside(crack, solid) <= 1e-9 * crack.length:
            yield ("cracks", place), "lies wholly outside every body"


def solid_region(parts: Parts) -> Any:
    """Return all bodies without holes as one shapely geometry; None if that cannot be computed."""
    import shapely

    region = shapely.Polygon()
    try:
        for _, body in parts.bodies:
            outline = body.shape.outline()
            region = region - outline if body.hole else region | outline
    except shapely.errors.ShapelyError:
        return None
    return region


def _length_inside(crack: CrackSection, solid: Any) -> float:
    import shapely

    try:
        return shapely.LineString(crack.corners).intersection(solid).length
    except shapely.errors.ShapelyError:
        return crack.length


def crack_warnings(parts: Parts) -> Iterator[Wrong]:
    """Yield what is possible but seldom meant: coarse particles, odd pieces, tips in the air."""
    if not parts.cracks:
        return
    import shapely

    cell, solid = parts.grid.cell, solid_region(parts)
    for place, crack in parts.cracks:
        path = ("cracks", place)
        if crack.segment and not SHORTEST * cell <= crack.segment <= LONGEST * cell:
            share = crack.segment / cell
            usual = f"usual are {SHORTEST:g} to {LONGEST:g}"
            yield (*path, "segment"), f"is {share:.3g} cells; {usual}"
        for key, point in (("start", crack.corners[0]), ("end", crack.corners[-1])):
            in_the_air = solid is not None and not solid.intersects(shapely.Point(point))
            if getattr(crack, key) == "tip" and in_the_air:
                yield (*path, key), "is a tip outside every body; 'edge' may be meant"
        yield from _coarse_bodies(parts, crack)


def _coarse_bodies(parts: Parts, crack: CrackSection) -> Iterator[Wrong]:
    for place, body in parts.solids:
        if body.particles_per_cell < 2 and _length_inside(crack, body.shape.outline()) > 0.0:
            message = f"fewer than 2 along each side of a cell, but crack {crack.name} runs here"
            yield ("bodies", place, "particles_per_cell"), message
