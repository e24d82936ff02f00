"""Normals beside a rigid body, of its own outline: it has one, so nothing need be fitted.

The outline is straight pieces with the body at their left. The normal at a node is that of the
piece next to it. There is none within REACH of a corner, where the surface of the other body
decides how they touch: there it is fitted as between elastic bodies.
"""

from math import inf
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


def make_outlines(rings: list) -> Outlines:
    """Return the outlines of all contact groups.

    rings: for each group a list of closed lines (k + 1, 2) with the body at their left (m)
    """
    first = np.cumsum([0, *(sum(len(ring) - 1 for ring in group) for group in rings)])
    tables = [_pieces(np.asarray(ring)) for group in rings for ring in group]
    none = (np.zeros((0, 2)), np.zeros((0, 2)), np.zeros(0), np.zeros(0, dtype=np.int64))
    return Outlines(first, *(np.concatenate(column) for column in zip(none, *tables, strict=True)))


def _pieces(ring):
    """Return start, unit vector, length and corner of the pieces of a closed line (k + 1, 2)."""
    edges = np.diff(ring, axis=0)
    length = np.hypot(*edges.T)
    along = edges / length[:, None]
    turns = (along * np.roll(along, 1, axis=0)).sum(axis=1) < CORNER
    return ring[:-1], along, length, turns.astype(np.int64)


@kernel
def nearest_piece(outlines, group, x, y, ox, oy):
    """Return the piece of a rigid body's outline next to a place, and its point there; or -1.

    x, y: the place; ox, oy: of the other body beside it; both from where the rigid one was at the
    start (m). Pieces with the other body at their back do not count, however thin the rigid one is
    """
    nearest, found, fx, fy = inf, -1, 0.0, 0.0
    for s in range(outlines.first[group], outlines.first[group + 1]):
        dx, dy = outlines.along[s, 0], outlines.along[s, 1]
        x0, y0 = outlines.start[s, 0], outlines.start[s, 1]
        if (ox - x0) * dy < (oy - y0) * dx:
            continue
        t = min(max((x - x0) * dx + (y - y0) * dy, 0.0), outlines.length[s])
        px, py = x0 + t * dx, y0 + t * dy
        away = (x - px) ** 2 + (y - py) ** 2
        if away < nearest:
            nearest, found, fx, fy = away, s, px, py
    return found, fx, fy


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
def outline_normal(clouds, stencil, position, pairs, i, place, width, rigid, outlines, way):
    """Return the unit normal from body a to body b of pair i, or (0, 0) where no outline tells it.

    place: of the node (m); width: of a cell (m); rigid: (groups,) 1 for rigid bodies;
    way: (groups, dim) which these have gone (m)
    """
    me, other, sign = (0, 1, 1.0) if rigid[pairs.group[i, 0]] else (1, 0, -1.0)
    group = pairs.group[i, me]
    if not rigid[group]:
        return 0.0, 0.0
    ox, oy = middle(clouds, stencil, position, pairs.row[i, other])
    wx, wy = way[group, 0], way[group, 1]
    s, fx, fy = nearest_piece(outlines, group, place[0] - wx, place[1] - wy, ox - wx, oy - wy)
    if s < 0 or beside_corner(outlines, group, fx, fy, REACH * width):
        return 0.0, 0.0
    return sign * outlines.along[s, 1], -sign * outlines.along[s, 0]
