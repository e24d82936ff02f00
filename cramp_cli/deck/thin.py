"""Bodies so thin that the grid does not bend or stretch them as it should."""

from collections.abc import Iterator

from cramp_cli.deck.plausible import FEWEST, longest
from cramp_cli.deck.regions import Regions
from cramp_cli.schema.section import Wrong

CELLS = 2.0  # a body wants to be at least this thick
SLACK = 1e-6  # of that
MOST_CORNERS = 200_000  # of the outline of a body that is looked at
HALVINGS = 12  # until the thickness is known well enough to be told


def thin_warnings(deck) -> Iterator[Wrong]:
    """Yield each solid body with a piece that no disk of two cells fits into.

    Bodies that are short as well are told that by plausible.py, which says more.
    """
    regions, cell = Regions(deck.bodies), deck.grid.cell
    from shapely.errors import ShapelyError

    for number, body in enumerate(deck.bodies):
        if body.hole or body.rigid or longest(body) < FEWEST * cell:
            continue
        try:
            cells = thinnest(regions.left(number), CELLS * cell) / cell
        except ShapelyError:  # shapes too odd to compute with
            continue
        if cells < CELLS:
            message = f"is {cells:.2g} cells thick: too few for stresses across it"
            yield ("bodies", number, "shape"), f"{message}; {CELLS:g} at least, 6 if it bends"


def thinnest(region, enough: float) -> float:
    """Return how thick the thinnest piece of a region is, inf if all have `enough` (m).

    The thickness of a piece is the diameter of the largest disk in it.
    """
    import numpy as np
    import shapely

    parts = shapely.get_parts(region)
    parts = parts[shapely.area(parts) > 0.0]
    if not len(parts) or shapely.get_num_coordinates(parts).sum() > MOST_CORNERS:
        return np.inf
    parts = parts[shapely.is_empty(shapely.buffer(parts, -0.5 * enough * (1.0 - SLACK)))]
    low, high = np.zeros(len(parts)), np.full(len(parts), enough)
    for _ in range(HALVINGS if len(parts) else 0):
        middle = 0.5 * (low + high)
        gone = shapely.is_empty(shapely.buffer(parts, -0.5 * middle))
        low, high = np.where(gone, low, middle), np.where(gone, middle, high)
    return float(np.min(high, initial=np.inf))
