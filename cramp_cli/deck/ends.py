"""What the ends of cracks are: what `auto` stands for, and words that contradict geometry.

An end on another crack is a junction; one at or beyond the surface of the body, or on a symmetry
plane that its crack meets, is an edge; one inside is a tip. From AT to DEEP inside the surface a
deck may call an end an edge or a tip; there `auto` decides at SURFACE, so that no word of its
choice would be a mistake. All functions want a deck whose sections are right by themselves.
"""

from collections.abc import Iterator
from math import hypot
from typing import Any, NamedTuple

from cramp_cli.deck.contact_groups import group_of_crack, groups_of_bodies
from cramp_cli.deck.line_checks import holds
from cramp_cli.schema.section import Wrong

MEETS = 0.1  # cells; an end this near to another crack lies on it
SURFACE = 0.5  # cells; a ligament shorter than this is none to `auto`
AT = 0.1  # cells; a `tip` nearer to the surface than this is at it
DEEP = 1.0  # cells; an `edge` further inside than this is not at the surface
ROUND_OFF = 1e-6
BESIDE = 0.5  # cells beside a plane of nodes; there a crack in the plane is looked at
KEYS = (("start", 0, 1), ("end", -1, -2))  # key, place of the end in the line, of the one before


class Spot(NamedTuple):
    """Where an end of a crack lies."""

    crack: str  # name of the crack on which it lies, or empty
    plane: str  # symmetry plane on which it lies and which its crack meets, or empty
    depth: float  # distance inside the surface of the body (m); negative outside


def choose_ends(deck: Any) -> Any:
    """Return a deck that says what every end is where it said `auto`."""
    solids, chosen = _Solids(deck), []
    for crack in deck.cracks:
        update = {
            key: _fitting(solids.spot(crack, at, behind), deck.grid.cell)
            for key, at, behind in KEYS
            if getattr(crack, key) == "auto"
        }
        chosen.append(crack.model_copy(update=update) if update else crack)
    return deck.model_copy(update={"cracks": tuple(chosen)})


def _fitting(spot: Spot, cell: float) -> str:
    if spot.crack:
        return "junction"
    return "edge" if spot.plane or spot.depth < SURFACE * cell else "tip"


def end_mistakes(deck: Any) -> Iterator[Wrong]:
    """Yield words for ends that contradict where the ends lie."""
    solids, cell = _Solids(deck), deck.grid.cell
    for place, crack in enumerate(deck.cracks):
        for key, at, behind in KEYS:
            word = getattr(crack, key)
            if word == "auto":
                continue
            trouble = _contradiction(word, solids.spot(crack, at, behind), cell)
            if trouble:
                yield ("cracks", place, key), trouble


def _contradiction(word: str, spot: Spot, cell: float) -> str:
    """Return what is wrong with a word for an end, or an empty text."""
    away = f"{abs(spot.depth):.4g} m"
    if spot.crack:
        fits = word in ("junction", "plain")
        return "" if fits else f"'{word}' lies on crack {spot.crack}; write 'junction' or 'auto'"
    if word == "junction":
        return f"'junction' lies on no other crack (within {MEETS:g} cells)"
    if spot.plane:
        fits = word == "edge"
        return "" if fits else f"'{word}' lies on the symmetry plane {spot.plane}; write 'edge'"
    if word == "edge" and spot.depth > (1.0 + ROUND_OFF) * DEEP * cell:
        return f"'edge' is {away} inside the body, and would cut on from there; write 'tip'"
    outside = spot.depth < -AT * cell
    if word != "edge" and spot.depth < AT * cell and (word == "tip" or not outside):
        where = "outside every body" if outside else "at the surface of the body"
        return f"'{word}' lies {where}; write 'edge'"
    return ""


def told_ends(deck: Any) -> dict[str, str]:
    """Return for every crack what its ends are, in words."""
    solids = _Solids(deck)
    return {
        f"crack {crack.name}": ", ".join(
            f"{key}: {_told(getattr(crack, key), solids.spot(crack, at, behind))}"
            for key, at, behind in KEYS
        )
        for crack in deck.cracks
    }


def _told(word: str, spot: Spot) -> str:
    if spot.crack:
        return f"junction with {spot.crack}"
    return f"edge on the symmetry plane {spot.plane}" if spot.plane else word


class _Solids:
    """The solid that each crack cuts, and where its ends lie in it."""

    def __init__(self, deck: Any) -> None:
        self._deck, self._cell = deck, deck.grid.cell
        together = deck.contact.bodies is None
        self._group = {
            crack.name: 0 if together else group_of_crack(deck, crack) for crack in deck.cracks
        }
        self._solid: dict[int, Any] = {}

    def spot(self, crack: Any, at: int, behind: int) -> Spot:
        """Return where the end of a crack lies; at, behind: the end in its line, the one before."""
        point, before = crack.corners[at], crack.corners[behind]
        near = MEETS * self._cell
        crosses, along = self._planes(point, before)
        plane = crosses[0] if crosses else ""
        return Spot(self._met(crack, point, near), plane, self._depth(crack, point, along))

    def _met(self, crack: Any, point, near: float) -> str:
        """Return the name of another crack of the same solid on which a point lies."""
        for other in self._deck.cracks:
            same = self._group[other.name] == self._group[crack.name]
            if other.name != crack.name and same and distance(point, other.corners) <= near:
                return other.name
        return ""

    def _planes(self, point, before) -> tuple[list[str], list[int]]:
        """Return the symmetry planes through a point that a crack meets, and axes of the others.

        A crack along a plane that is held is one as well: half of a body, its ligament held as
        with finite elements. Its end is a tip, and is told of symmetry (line_checks.py).
        """
        crosses, along = [], []
        for boundary in self._deck.boundary:
            for axis, place in boundary.where.planes:
                if abs(point[axis] - place) > AT * self._cell:
                    continue
                if abs(before[axis] - place) <= AT * abs(before[1 - axis] - point[1 - axis]):
                    along += [axis] if boundary.symmetry or holds(boundary, axis) else []
                elif boundary.symmetry:
                    crosses.append(f"{'xy'[axis]} = {place:g} m")
        return crosses, along

    def _depth(self, crack: Any, point, along: list[int]) -> float:
        """Return how far inside the solid a point is (m); along: axes of planes its crack is in."""
        import shapely

        solid = self._solid_of(self._group[crack.name])
        depths = []
        for x, y in _beside(point, along, BESIDE * self._cell):
            spot = shapely.Point(x, y)
            inside = bool(shapely.covers(solid, spot))
            away = shapely.distance(shapely.boundary(solid), spot)
            depths.append(float(away if inside else -away))
        return max(depths)

    def _solid_of(self, group: int) -> Any:
        """Return what is filled with bodies of a contact group that are not rigid."""
        import shapely

        if group not in self._solid:
            solid = shapely.Polygon()
            groups = groups_of_bodies(self._deck)
            for body, own in zip(self._deck.bodies, groups, strict=True):
                outline = shapely.buffer(body.shape.outline(), 0.0)
                mine = own == group and not body.hole and not body.rigid
                solid = solid | outline if mine else solid - outline
            self._solid[group] = solid
        return self._solid[group]


def _beside(point, along: list[int], off: float) -> list[tuple[float, float]]:
    """Return a point; where its crack lies in a plane of nodes, places on both sides of it."""
    if not along:
        return [point]
    dx, dy = (off, 0.0) if along[0] == 0 else (0.0, off)
    return [(point[0] + dx, point[1] + dy), (point[0] - dx, point[1] - dy)]


def distance(point, line) -> float:
    """Return the distance of a point from a polyline (m)."""
    return min(_to_piece(point, a, b) for a, b in zip(line, line[1:], strict=False))


def _to_piece(point, a, b) -> float:
    (px, py), (ax, ay), (bx, by) = point, a, b
    dx, dy = bx - ax, by - ay
    share = ((px - ax) * dx + (py - ay) * dy) / (dx * dx + dy * dy)
    share = min(max(share, 0.0), 1.0)
    return hypot(px - ax - share * dx, py - ay - share * dy)
