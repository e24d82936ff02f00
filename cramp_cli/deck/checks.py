"""Mistakes between the sections of a deck: names that lead nowhere, things outside the grid."""

from collections.abc import Iterator

from cramp_cli.deck.assembly import MOST_PIECES
from cramp_cli.deck.bodies import FIT
from cramp_cli.deck.crack_checks import crack_mistakes
from cramp_cli.deck.lattice import Box, nearest_lines
from cramp_cli.deck.line_checks import line_mistakes
from cramp_cli.deck.parts import Parts
from cramp_cli.deck.where import AXES
from cramp_cli.schema.section import Wrong, unknown
from cramp_cli.schema.units import shown

SIDES = (("left", "right"), ("bottom", "top"))


def name_mistakes(data: dict) -> Iterator[Wrong]:
    """Yield names given twice and names that nothing has; on raw data, so that none is missed."""
    materials = data.get("materials")
    materials = list(materials) if isinstance(materials, dict) else []
    for place, body in _sections(data, "bodies"):
        name = body.get("material")
        if materials and isinstance(name, str) and name not in materials:
            yield ("bodies", place, "material"), unknown("material", name, materials)
    for key in ("bodies", "cracks", "boundary", "loads"):
        yield from _names_given_twice(data, key)
    yield from _bodies_of_loads(data)


def _sections(data: dict, key: str) -> list[tuple[int, dict]]:
    entries = data.get(key)
    entries = entries if isinstance(entries, list) else []
    return [(place, entry) for place, entry in enumerate(entries) if isinstance(entry, dict)]


def _names_given_twice(data: dict, key: str) -> Iterator[Wrong]:
    taken: set[str] = set()
    for place, entry in _sections(data, key):
        name = entry.get("name")
        if isinstance(name, str) and name in taken:
            yield (key, place, "name"), f"{shown(name)} is taken already in {key}"
        if isinstance(name, str):
            taken.add(name)


def _bodies_of_loads(data: dict) -> Iterator[Wrong]:
    bodies = [entry for _, entry in _sections(data, "bodies") if isinstance(entry.get("name"), str)]
    holes = [entry["name"] for entry in bodies if entry.get("hole") is True]
    solid = list(dict.fromkeys(one["name"] for one in bodies if one.get("hole") is not True))
    for place, load in _sections(data, "loads") if bodies else ():
        name = load.get("body")
        if not isinstance(name, str) or name in solid:
            continue
        message = f"{shown(name)} is a hole" if name in holes else unknown("body", name, solid)
        yield ("loads", place, "body"), message


def too_many_mistakes(parts: Parts) -> Iterator[Wrong]:
    """Yield what would take minutes to make only to find out that it is too much.

    Nothing is made here: pieces of shapes are counted, not copied.
    """
    total = 0
    for place, body in parts.bodies:
        total += body.shape.count_pieces()
        if total > MOST_PIECES:
            message = f"the shapes of all bodies have {total} pieces up to this one"
            yield ("bodies", place, "shape"), f"{message}; at most {MOST_PIECES} are possible"
            return


def geometry_mistakes(parts: Parts) -> Iterator[Wrong]:
    """Yield bodies and planes that do not fit the grid, and cracks that do not fit the bodies."""
    box = parts.box()
    if box is not None:
        yield from _bodies_in_grid(parts, box)
        yield from _planes_on_lines(parts, box)
    yield from line_mistakes(parts)
    yield from crack_mistakes(parts)


def _bodies_in_grid(parts: Parts, box: Box) -> Iterator[Wrong]:
    """Yield each side of a body that leaves no empty layer of cells."""
    cell = parts.grid.cell
    for place, body in parts.solids:
        lower, upper = body.shape.bounds()
        for axis, name in enumerate(AXES):
            gaps = (lower[axis] - box.lower[axis], box.upper[axis] - upper[axis])
            for side, edge, gap in zip(SIDES[axis], (lower, upper), gaps, strict=True):
                if gap < cell * (1.0 - FIT):
                    where = f"its {side} side ({name} = {edge[axis]:.9g} m)"
                    yield ("bodies", place, "shape"), f"{where} {_lack(gap, cell)}"


def _lack(gap: float, cell: float) -> str:
    if gap < -FIT * cell:
        return f"is outside the grid by {-gap:.6g} m; leave one empty layer of cells as well"
    lack = f"{cell - gap:.6g} m more is needed"
    return f"leaves no empty layer of cells to the border of the grid; {lack}"


def _planes_on_lines(parts: Parts, box: Box) -> Iterator[Wrong]:
    cell = parts.grid.cell
    for place, boundary in parts.boundary:
        for axis, at in boundary.where.planes:
            path = ("boundary", place, "where", AXES[axis])
            here = f"{AXES[axis]} = {at:.9g} m"
            low, high = box.lower[axis], box.upper[axis]
            if not low - FIT * cell <= at <= high + FIT * cell:
                yield path, f"{here} is outside the grid ({low:.9g} m to {high:.9g} m)"
                continue
            lines = nearest_lines(box, cell, axis, at)
            if len(lines) == 2:
                near = f"nearest are {lines[0]:.9g} m and {lines[1]:.9g} m"
                yield path, f"{here} is not on a grid line; {near}"
