"""How much of each box of a lattice lies in a region, without error: area, centre, extent.

By Green's theorem the integral of f over the part of a region inside a box is that of F dy along
the pieces of the outline inside the box, F = int f dx from the left side of the box, and of F at
its right side along the pieces that lie further right in the same row of boxes. So every edge is
cut once where it passes from box to box, and a sum along each row does the rest; rasterizers of
fonts find the grey of a pixel in this way. All is in boxes: the box (i, j) reaches from i to i + 1.
"""

from typing import NamedTuple

import numpy as np

SNAP = 2e-6  # boxes; corners of an outline nearer than this to a line of the lattice lie on it
NOTHING = 1e-9  # of a box; less is round-off
GAUSS = 0.5 - np.sqrt(1.0 / 12.0), 0.5 + np.sqrt(1.0 / 12.0)  # exact for cubics
FULL = (1.0, 0.5, 0.5, 1.0 / 3.0, 1.0 / 3.0, 1.0, 1.0, 1.0, 1.0)


class Coverage(NamedTuple):
    """What lies in the boxes that a region touches; n of them, row by row from below."""

    box: np.ndarray  # (n, 2) column and row
    area: np.ndarray  # (n,) share of the box, exactly 1 where it is full
    first: np.ndarray  # (n, 2) integrals of x and y from the lower left corner of the box
    second: np.ndarray  # (n, 2) integrals of x^2 and y^2 from there
    side: np.ndarray  # (n, 4) lengths of its sides inside: right, left, upper and lower one


def coverage(rings: list) -> Coverage:
    """Return what lies in each box.

    rings: closed lines (k + 1, 2) with the region at their left, in boxes
    """
    start, end = _pieces(rings)
    box, table, run = _along_rows(start, end)
    across, other, _ = _along_rows(end[:, ::-1], start[:, ::-1])  # the same with x and y exchanged
    order = np.lexsort(box.T)
    found = places_of(box[order], across[:, ::-1])
    sides = np.zeros((len(box), 2))
    sides[order[found[found >= 0]]] = other[found >= 0, 5:]
    return _joined(box, np.c_[table, sides], run)


def places_of(boxes, wanted) -> np.ndarray:
    """Return which of the boxes (n, 2), row by row, each of those wanted (m, 2) is, or -1."""
    low = np.minimum(boxes.min(axis=0), wanted.min(axis=0, initial=0))
    wide = max(boxes[:, 0].max(), wanted[:, 0].max(initial=0)) - low[0] + 1
    codes, code = ((one - low) @ [1, wide] for one in (boxes, wanted))
    found = np.minimum(np.searchsorted(codes, code), len(codes) - 1)
    return np.where(codes[found] == code, found, -1)


def _along_rows(start, end) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the boxes with pieces (n, 2), what is in them, how many full ones are at their left.

    start, end: of pieces of the outline with the region at their left, each in one box

    returns: second area, x, y, x^2, y^2, right and left side (n, 7)
    """
    column, row = np.floor(0.5 * (start + end)).astype(np.int64).T
    corner = np.stack([column, row], axis=1)
    inside, beyond = _integrals(start - corner, end - corner)
    keys, which = np.unique(np.stack([row, -column], 1), axis=0, return_inverse=True)
    inside, beyond = (_summed(which.ravel(), len(keys), table) for table in (inside, beyond))
    row, column = keys[:, 0], -keys[:, 1]  # each row from the right
    last = np.append(row[1:] != row[:-1], True)
    before = np.vstack([np.zeros((1, 3)), np.cumsum(beyond, axis=0)[:-1]])
    firsts = np.flatnonzero(np.append(True, last[:-1]))
    before -= np.repeat(before[firsts], np.diff(np.append(firsts, len(row))), axis=0)
    g0, g1, g2 = before.T
    inside += np.stack([g0, 0.5 * g0, g1, g0 / 3.0, g2], axis=1)
    left = (before + beyond)[:, 0]
    gap = np.where(last, 0, column - np.append(column[1:], 0) - 1)
    return np.stack([column, row], 1), np.c_[inside, g0, left], gap * (left > 0.5)


def _joined(box, table, run) -> Coverage:
    """Return boxes with edges and the full ones between them; run: how many at the left of each."""
    table[np.abs(table[:, 0] - 1.0) < NOTHING, :5] = FULL[:5]
    some = table[:, 0] >= NOTHING
    back = np.arange(run.sum()) - np.repeat(np.cumsum(run) - run, run)
    between = np.repeat(box, run, axis=0)
    between[:, 0] -= back + 1
    box = np.concatenate([box[some], between])
    table = np.concatenate([table[some], np.tile(FULL, (len(between), 1))])
    order = np.lexsort(box.T)
    table = table[order]
    return Coverage(box[order], table[:, 0], table[:, 1:3], table[:, 3:5], table[:, 5:])


def _pieces(rings) -> tuple[np.ndarray, np.ndarray]:
    """Return starts and ends (n, 2) of all edges, cut where they cross lines of the lattice."""
    lines = [snapped(np.asarray(ring, dtype=float)) for ring in rings]
    start = np.concatenate([line[:-1] for line in lines])
    end = np.concatenate([line[1:] for line in lines])
    edge, share, axis, line = _crossings(start, end)
    order = np.lexsort((share, edge))
    edge, axis, line = edge[order], axis[order], line[order]
    at = start[edge] + share[order, None] * (end - start)[edge]
    cut = np.flatnonzero(axis >= 0)
    at[cut, axis[cut]] = line[cut]  # without round-off
    at[axis == -2] = end
    same = np.flatnonzero(edge[1:] == edge[:-1])
    return at[same], at[same + 1]


def _crossings(start, end):
    """Return edge, share of its length, axis and line of all crossings, and of both ends.

    The axis of a start is -1, that of an end -2.
    """
    n = len(start)
    found = [(np.arange(n), np.full(n, float(e)), np.full(n, -1 - e), np.zeros(n)) for e in (0, 1)]
    for d in range(2):
        low, high = np.minimum(start[:, d], end[:, d]), np.maximum(start[:, d], end[:, d])
        first = np.floor(low) + 1.0
        count = np.maximum(np.ceil(high) - first, 0.0).astype(np.int64)
        edge = np.repeat(np.arange(n), count)
        line = first[edge] + np.arange(len(edge)) - np.repeat(np.cumsum(count) - count, count)
        share = (line - start[edge, d]) / (end - start)[edge, d]
        found.append((edge, share, np.full(len(edge), d), line))
    return tuple(np.concatenate(column) for column in zip(*found, strict=True))


def snapped(points):
    """Return points (in boxes) with coordinates on lines of the lattice where they nearly are."""
    near = np.round(points)
    return np.where(np.abs(points - near) <= SNAP, near, points)


def _integrals(start, end) -> tuple[np.ndarray, np.ndarray]:
    """Return what pieces add to their own box (n, 5) and to those at its left (n, 3).

    start, end: from the corner of their box. The five are area, x, y, x^2 and y^2, the three 1, y
    and y^2 along the piece.
    """
    rise = 0.5 * (end - start)[:, 1]
    inside, beyond = np.zeros((len(start), 5)), np.zeros((len(start), 3))
    for share in GAUSS:
        x, y = (start + share * (end - start)).T
        inside += rise[:, None] * np.stack([x, x**2 / 2.0, x * y, x**3 / 3.0, x * y**2], axis=1)
        beyond += rise[:, None] * np.stack([np.ones(len(x)), y, y**2], axis=1)
    return inside, beyond


def _summed(which, count, table) -> np.ndarray:
    """Return the sums of the rows of a table that belong to the same of `count` boxes."""
    return np.stack([np.bincount(which, column, count) for column in table.T], axis=1)
