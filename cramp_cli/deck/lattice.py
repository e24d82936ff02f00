"""The box of grid cells: given by the deck, or around all bodies."""

from collections.abc import Iterable
from math import ceil, floor
from typing import NamedTuple

from cramp_cli.deck.bodies import FIT, GridSection


class Box(NamedTuple):
    """Corners (m) and number of cells along each axis."""

    lower: tuple[float, ...]
    upper: tuple[float, ...]
    cells: tuple[int, ...]


def lattice_box(grid: GridSection, bounds: Iterable[tuple]) -> Box:
    """Return the box of the grid; `bounds` are lower and upper corner (m) of each body.

    Without a box in the deck grid lines are multiples of the cell, so that coordinate 0 is a line.
    """
    cell = grid.cell
    if grid.lower is not None:
        cells = tuple(round((b - a) / cell) for a, b in zip(grid.lower, grid.upper, strict=True))
        return Box(grid.lower, grid.upper, cells)
    lowers, uppers = zip(*bounds, strict=True)
    first = [floor(min(low) / cell + FIT) - grid.margin for low in zip(*lowers, strict=True)]
    last = [ceil(max(high) / cell - FIT) + grid.margin for high in zip(*uppers, strict=True)]
    cells = tuple(b - a for a, b in zip(first, last, strict=True))
    return Box(tuple(cell * line for line in first), tuple(cell * line for line in last), cells)


def nearest_lines(box: Box, cell: float, axis: int, coordinate: float) -> tuple[float, ...]:
    """Return the grid line (m) at a coordinate, or the two lines next to it."""
    place = (coordinate - box.lower[axis]) / cell
    if abs(place - round(place)) <= FIT:
        return (box.lower[axis] + round(place) * cell,)
    return tuple(box.lower[axis] + line * cell for line in (floor(place), floor(place) + 1))
