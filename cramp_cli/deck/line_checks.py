"""Mistakes of the line of a crack: points beyond the grid, a way back over itself."""

from collections.abc import Iterator
from math import cos, hypot, radians

from cramp_cli.deck.bodies import FIT
from cramp_cli.deck.cracks import CrackSection
from cramp_cli.deck.lattice import Box
from cramp_cli.deck.parts import Parts
from cramp_cli.deck.where import AXES
from cramp_cli.schema.section import Wrong

SHARPEST = 170.0  # degrees by which a line may turn at a corner
SHORT = 0.1  # cells: noise of shorter pieces is forgiven its angles
NEAR = 0.5  # cells: so near to a plane a crack lies on it
COVERED = 1e-6  # share of its length over which a line may run twice


def line_mistakes(parts: Parts) -> Iterator[Wrong]:
    """Yield cracks that leave the grid, and cracks that run back over themselves."""
    box = parts.box()
    for place, crack in parts.cracks:
        if box is not None:
            yield from _outside(place, crack, box, parts.grid.cell)
        shortest = SHORT * parts.grid.cell if parts.grid else 0.0
        yield from _folded(place, crack, shortest)


def _outside(place: int, crack: CrackSection, box: Box, cell: float) -> Iterator[Wrong]:
    """Yield the first point of a crack that lies outside the grid."""
    for number, point in enumerate(crack.points or crack.corners):
        reach = [
            max(low - x, x - high) for x, low, high in zip(point, box.lower, box.upper, strict=True)
        ]
        if max(reach) > FIT * cell:
            key = ("points", number) if crack.points else ("arc",) if crack.arc else ()
            where = f"({point[0]:.6g}, {point[1]:.6g}) m is outside the grid by {max(reach):.6g} m"
            yield ("cracks", place, *key), f"{where}; a crack ends in a body or just beyond it"
            return


def _folded(place: int, crack: CrackSection, shortest: float) -> Iterator[Wrong]:
    """Yield a corner at which a crack turns back, or that it runs twice over the same way."""
    if crack.arc is not None:
        return
    path = ("cracks", place, *(("points",) if crack.points else ()))
    corners = crack.corners
    for a, b, c in zip(corners, corners[1:], corners[2:], strict=False):
        if _turns_back(a, b, c, shortest):
            where = f"({b[0]:.6g}, {b[1]:.6g}) m"
            yield path, f"turns back at {where}, by more than {SHARPEST:g} degrees"
            return
    if len(corners) > 2 and _covered_twice(corners):
        yield path, "runs twice over the same way; of two crack faces only one pair can be there"


def _turns_back(a, b, c, shortest: float) -> bool:
    ux, uy, vx, vy = b[0] - a[0], b[1] - a[1], c[0] - b[0], c[1] - b[1]
    u, v = hypot(ux, uy), hypot(vx, vy)
    return min(u, v) > shortest and ux * vx + uy * vy < cos(radians(SHARPEST)) * u * v


def _covered_twice(corners) -> bool:
    import shapely

    line = shapely.LineString(corners)
    try:
        return shapely.unary_union(line).length < (1.0 - COVERED) * line.length
    except shapely.errors.ShapelyError:  # too odd to compute with: nothing is claimed
        return False


def ligament_warnings(parts: Parts) -> Iterator[Wrong]:
    """Yield planes that hold the ligament ahead of a tip, as finite elements model half a body.

    There are no particles on the other side for the integrals to go around the tip; a symmetry
    plane supplies them by reflection.
    """
    near = NEAR * parts.grid.cell
    for number, plane in parts.boundary:
        for axis, at in plane.where.planes:
            if not holds(plane, axis):
                continue
            names = [crack.name for _, crack in parts.cracks if _ends_on(crack, axis, at, near)]
            if names:
                message = f"holds the ligament of crack {names[0]}, whose J and K stay unknown so"
                remedy = "for half of a body say symmetry: true instead"
                yield ("boundary", number), f"{message}; {remedy}"


def holds(plane, axis: int) -> bool:
    """Return whether a boundary says how nodes move along an axis, other than by symmetry."""
    drawn = plane.velocity is not None and getattr(plane.velocity, AXES[axis]) is not None
    return drawn or AXES[axis] in (plane.fix or ())


def _ends_on(crack: CrackSection, axis: int, at: float, near: float) -> bool:
    """Return whether the last piece before a tip lies on a plane."""
    ends = ((crack.start, crack.corners[:2]), (crack.end, crack.corners[-2:]))
    tips = [piece for word, piece in ends if word in ("tip", "auto")]
    return any(all(abs(point[axis] - at) <= near for point in piece) for piece in tips)
