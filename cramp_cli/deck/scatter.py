"""Random places for disks, one after the other: random sequential addition (Widom 1966).

Equal disks jam at 0.547 of the plane (Feder 1980), near 0.5 in a box. Random numbers are those of
Python's Mersenne Twister, of which Python promises that a seed always gives the same.
"""

from collections.abc import Sequence
from random import Random

TRIALS = 20_000  # throws for one disk before there is no room
MOST_TRIALS = 2_000_000  # for all disks: within half a minute


def scatter(
    inside, radii: Sequence[float], gap: float, random: Random
) -> list[tuple[float, float, float]]:
    """Return x, y and radius (m) of disks in a region, none nearer than `gap` (m) to another.

    inside: a shapely geometry that holds each disk whole; radii: in the order of placing (m)
    returns: fewer than `radii` if one finds no room, or all have taken too many throws
    """
    floor = _Floor(2.0 * max(radii) + gap)
    rooms = {}
    for radius in radii:
        if radius not in rooms:
            rooms = {radius: _room(inside, radius + gap)}
        place = _throw(rooms[radius], floor, radius, gap, random)
        if place is None:
            break
        floor.put(*place, radius)
    return floor.disks


def _room(inside, margin: float):
    """Return where centres may lie, ready to be asked often; its circles are of 256 pieces."""
    from shapely import prepare

    room = inside.buffer(-margin, quad_segs=64)
    prepare(room)
    return room


def _throw(room, floor: "_Floor", radius, gap, random) -> tuple[float, float] | None:
    from shapely import contains_xy

    if room.is_empty:
        return None
    x0, y0, x1, y1 = room.bounds
    for _ in range(min(TRIALS, MOST_TRIALS - floor.thrown)):
        floor.thrown += 1
        x, y = x0 + (x1 - x0) * random.random(), y0 + (y1 - y0) * random.random()
        if floor.is_free(x, y, radius + gap) and contains_xy(room, x, y):
            return x, y
    return None


class _Floor:
    """Disks on square tiles as wide as two of them, so that neighbours lie on nine tiles."""

    def __init__(self, tile: float):
        self.tile, self.thrown = tile, 0
        self.disks: list[tuple[float, float, float]] = []
        self.on_tile: dict[tuple[int, int], list[tuple[float, float, float]]] = {}

    def put(self, x: float, y: float, radius: float) -> None:
        self.disks.append((x, y, radius))
        self.on_tile.setdefault(self._tile(x, y), []).append((x, y, radius))

    def is_free(self, x: float, y: float, reach: float) -> bool:
        """Return whether no disk comes nearer than `reach` (m)."""
        column, row = self._tile(x, y)
        return not any(
            (x - a) ** 2 + (y - b) ** 2 < (reach + radius) ** 2
            for i in (column - 1, column, column + 1)
            for j in (row - 1, row, row + 1)
            for a, b, radius in self.on_tile.get((i, j), ())
        )

    def _tile(self, x: float, y: float) -> tuple[int, int]:
        return int(x // self.tile), int(y // self.tile)
