"""Normals beside a rigid body, of its own outline: it has one, so nothing need be fitted.

The outline is straight pieces with the body at their left. The normal at a node is that of the
piece next to it; where pieces stand for a curve it turns from one to the next without a jump, or a
roller would push aside what rests on the end of a piece. There is none within REACH of a corner,
where the surface of the other body decides how they touch: there it is fitted as between elastic
bodies.
"""

from math import inf, sqrt
from typing import NamedTuple

import numpy as np

from cramp_cli.contact.clouds import particle_of
from cramp_cli.numerics.kernel import kernel

REACH = 1.5  # cells; a node that sees both bodies is nearer to the surface
CORNER = np.cos(np.radians(20.0))  # of the angle by which an outline turns at a corner, or more


class Outlines(NamedTuple):
    """Straight pieces of the outlines of all rigid bodies, where they were at the start."""

    first: np.ndarray  # (groups + 1,) first piece of each contact group; elastic ones have none
    start: np.ndarray  # (pieces, 2) where a piece starts (m)
    along: np.ndarray  # (pieces, 2) unit vector along it
    length: np.ndarray  # (pieces,) m
    corner: np.ndarray  # (pieces,) 1 where the outline turns sharply at its start
    before: np.ndarray  # (pieces,) the piece that ends where it starts
    after: np.ndarray  # (pieces,) the piece that starts where it ends


def make_outlines(rings: list) -> Outlines:
    """Return the outlines of all contact groups.

    rings: for each group a list of closed lines (k + 1, 2) with the body at their left (m)
    """
    first = np.cumsum([0, *(sum(len(ring) - 1 for ring in group) for group in rings)])
    tables = [_pieces(np.asarray(ring)) for group in rings for ring in group]
    none = (np.zeros((0, 2)), np.zeros((0, 2)), np.zeros(0), np.zeros(0, dtype=np.int64))
    columns = [np.concatenate(column) for column in zip(none, *tables, strict=True)]
    return Outlines(first, *columns, *_neighbours([len(table[0]) for table in tables]))


def _pieces(ring):
    """Return start, unit vector, length and corner of the pieces of a closed line (k + 1, 2)."""
    edges = np.diff(ring, axis=0)
    length = np.hypot(*edges.T)
    along = edges / length[:, None]
    turns = (along * np.roll(along, 1, axis=0)).sum(axis=1) < CORNER
    return ring[:-1], along, length, turns.astype(np.int64)


def _neighbours(counts: list) -> tuple[np.ndarray, np.ndarray]:
    """Return the pieces before and after each piece of closed lines with these numbers of them."""
    before, after, start = [np.zeros(0, dtype=np.int64)], [np.zeros(0, dtype=np.int64)], 0
    for count in counts:
        own = np.arange(start, start + count)
        before.append(np.roll(own, 1))
        after.append(np.roll(own, -1))
        start += count
    return np.concatenate(before), np.concatenate(after)


@kernel
def way_along(outlines, s, x, y):
    """Return how far along piece s the point next to a place is (m), and its squared distance."""
    dx, dy = x - outlines.start[s, 0], y - outlines.start[s, 1]
    t = min(max(dx * outlines.along[s, 0] + dy * outlines.along[s, 1], 0.0), outlines.length[s])
    away = (dx - t * outlines.along[s, 0]) ** 2 + (dy - t * outlines.along[s, 1]) ** 2
    return t, away


@kernel
def nearest_piece(outlines, group, x, y, ox, oy):
    """Return the piece of a rigid body's outline next to a place, or -1, and how far along it.

    x, y: the place; ox, oy: of the other body beside it; both from where the rigid one was at the
    start (m). Pieces with the other body at their back do not count, however thin the rigid one is
    """
    nearest, found, along = inf, -1, 0.0
    for s in range(outlines.first[group], outlines.first[group + 1]):
        dx, dy = outlines.along[s, 0], outlines.along[s, 1]
        if (ox - outlines.start[s, 0]) * dy < (oy - outlines.start[s, 1]) * dx:
            continue
        t, away = way_along(outlines, s, x, y)
        if away < nearest:
            nearest, found, along = away, s, t
    return found, along


@kernel
def nearest_beside(outlines, s, x, y):
    """Return the piece next to a place and how far along it, from piece s on to either side.

    The search ends where the distance grows again: it stays on the side of the body where it began
    """
    t, nearest = way_along(outlines, s, x, y)
    for neighbour in (outlines.after, outlines.before):
        k = neighbour[s]
        along, away = way_along(outlines, k, x, y)
        while away < nearest:
            s, t, nearest = k, along, away
            k = neighbour[s]
            along, away = way_along(outlines, k, x, y)
    return s, t


@kernel
def point_on(outlines, s, t):
    """Return the point at t along piece s (m)."""
    x = outlines.start[s, 0] + t * outlines.along[s, 0]
    return x, outlines.start[s, 1] + t * outlines.along[s, 1]


@kernel
def normal_on(outlines, s, t):
    """Return the unit normal at t along piece s (m), out of the body.

    At the end of two pieces that are no corner it is that of both; from there it turns to that of
    each within half the shorter one: on pieces of a circle it is the circle's.
    """
    length, dx, dy = outlines.length[s], outlines.along[s, 0], outlines.along[s, 1]
    before, after = outlines.before[s], outlines.after[s]
    start = t < 0.5 * length
    other, corner = (before, outlines.corner[s]) if start else (after, outlines.corner[after])
    turning, from_end = 0.5 * min(length, outlines.length[other]), t if start else length - t
    if not corner and from_end < turning:
        share = 0.5 * (1.0 - from_end / turning)
        dx += share * (outlines.along[other, 0] - dx)
        dy += share * (outlines.along[other, 1] - dy)
        size = sqrt(dx * dx + dy * dy)
        dx, dy = dx / size, dy / size
    return dy, -dx


@kernel
def beside_corner(outlines, group, x, y, reach):
    """Tell whether a corner of a rigid body's outline is nearer to a place than `reach` (m)."""
    for s in range(outlines.first[group], outlines.first[group + 1]):
        dx, dy = x - outlines.start[s, 0], y - outlines.start[s, 1]
        if outlines.corner[s] and dx * dx + dy * dy < reach * reach:
            return True
    return False


@kernel
def middle(clouds, stencil, position, row):
    """Return the mean of the places of a row's particles (m); the row must have some."""
    x, y, count, entry = 0.0, 0.0, 0, clouds.head[row]
    while entry >= 0:
        p = particle_of(stencil, entry)
        x, y, count = x + position[p, 0], y + position[p, 1], count + 1
        entry = clouds.link[entry]
    return x / count, y / count


@kernel
def piece_beside(clouds, stencil, position, pairs, i, place, width, rigid, outlines, way):
    """Return the piece of a rigid body's outline that pair i meets, or -1; the normal from a to b.

    place: of the node (m); width: of a cell (m); rigid: (groups,) 1 for rigid bodies;
    way: (groups, dim) which these have gone (m)
    """
    me, other, sign = (0, 1, 1.0) if rigid[pairs.group[i, 0]] else (1, 0, -1.0)
    group = pairs.group[i, me]
    if not rigid[group]:
        return -1, 0.0, 0.0
    ox, oy = middle(clouds, stencil, position, pairs.row[i, other])
    wx, wy = way[group, 0], way[group, 1]
    s, t = nearest_piece(outlines, group, place[0] - wx, place[1] - wy, ox - wx, oy - wy)
    if s < 0 or beside_corner(outlines, group, *point_on(outlines, s, t), REACH * width):
        return -1, 0.0, 0.0
    nx, ny = normal_on(outlines, s, t)
    return s, sign * nx, sign * ny
