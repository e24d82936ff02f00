"""Parts of boxes too small to be particles go to their neighbours.

What is alone in a cell, over a share f of it, is a spring of stiffness f with a mass of f^2/2 for a
node: it asks for a time step in proportion to sqrt(f). From 0.3 on the cells themselves ask for
none that is longer (measured: usl- at cfl 0.5, usavg+ at 0.8).
"""

import numpy as np

from cramp_cli.build.coverage import Coverage, places_of

LEAST = 0.6  # of a full particle; a smaller part is a sliver
LEAST_WIDTH = 0.3  # cells; one particle along a cell may be smaller, or others would be too large
ALIKE = 1e-6  # neighbours whose shares differ by less are as full as each other
JOINED = 1e-6  # of a side; boxes with less of it in common are not of one piece
SIDES = np.array([[1, 0], [-1, 0], [0, 1], [0, -1]])  # as in Coverage
DIAGONALS = ((0, 2), (0, 3), (1, 2), (1, 3))  # one side after the other


def least_share(per_cell: int) -> float:
    """Return the share of a full particle from which on a part is one of its own."""
    return min(LEAST, LEAST_WIDTH * per_cell)


def without_slivers(parts: Coverage, least: float) -> tuple[Coverage, np.ndarray, np.ndarray]:
    """Return the boxes with what is less than `least` given to the fullest box beside it.

    Boxes as full as each other take equal parts. A sliver among slivers goes over a corner; one
    with nothing else around it stays.

    returns: and from where to where each reaches (n, 2), from its own corner, in boxes
    """
    sliver = np.flatnonzero(parts.area < least)
    low, high = np.zeros_like(parts.first), np.ones_like(parts.first)
    if not len(sliver):
        return parts, low, high
    giver, taker, share = _gifts(parts, sliver, least)
    way = parts.box[giver] - parts.box[taker]
    a, f, s = ((share * of[giver].T).T for of in parts[1:4])
    area, first, second = (of.copy() for of in parts[1:4])
    np.add.at(area, taker, a)
    np.add.at(first, taker, f + way * a[:, None])
    np.add.at(second, taker, s + 2.0 * way * f + way**2 * a[:, None])
    np.minimum.at(low, taker, way)
    np.maximum.at(high, taker, way + 1.0)
    kept = np.ones(len(area), dtype=bool)
    kept[giver] = False
    table = (parts.box, area, first, second, parts.side)
    return Coverage(*(one[kept] for one in table)), low[kept], high[kept]


def _gifts(parts, sliver, least) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return who gives which share to whom, (k,) each."""
    beside = _beside(parts, sliver)
    ways = [beside, _over_corners(parts, beside)]
    given = np.zeros(len(sliver), dtype=bool)
    gifts = []
    for place in ways:
        area = np.where(place >= 0, parts.area[place], 0.0)
        area[(area < least) | given[:, None]] = 0.0
        most = area.max(axis=1)
        takes = (area > 0.0) & (area > most[:, None] - ALIKE)
        given |= most > 0.0
        n, k = np.nonzero(takes)
        gifts.append((sliver[n], place[n, k], 1.0 / takes.sum(axis=1)[n]))
    return tuple(np.concatenate(column) for column in zip(*gifts, strict=True))


def _beside(parts, boxes) -> np.ndarray:
    """Return the box at each side of some boxes, (n, 4), -1 where no piece of the body joins it."""
    ways = [places_of(parts.box, parts.box[boxes] + way) for way in SIDES]
    return np.where(parts.side[boxes] > JOINED, np.stack(ways, axis=1), -1)


def _over_corners(parts, beside) -> np.ndarray:
    """Return the box over each corner, (n, 4), by way of one of the two boxes between, or -1."""
    found = []
    for one, two in DIAGONALS:
        there = np.full(len(beside), -1)
        for first, then in ((one, two), (two, one)):
            by = np.flatnonzero((there < 0) & (beside[:, first] >= 0))
            if len(by):
                there[by] = _beside(parts, beside[by, first])[:, then]
        found.append(there)
    return np.stack(found, axis=1)
