"""Normals beside a rigid body, of its own outline: it has one, so nothing need be fitted.

Pieces of the outlines of all rigid bodies are listed one after the other, with the body at their
left. The normal at a node is that of the nearest piece, or points away from the nearest corner.
"""

from math import inf, sqrt
from typing import NamedTuple

import numpy as np

from cramp_cli.numerics.kernel import kernel


class Outlines(NamedTuple):
    """Straight pieces of the outlines of the rigid bodies, as they were at the start."""

    first: np.ndarray  # (groups + 1,) first piece of each contact group; none of an elastic one
    ends: np.ndarray  # (pieces, 4) x and y of both ends (m)


def make_outlines(pieces: list) -> Outlines:
    """Return the outlines of all contact groups; pieces: for each group an array (k, 4)."""
    first = np.cumsum([0, *map(len, pieces)])
    return Outlines(first, np.concatenate([np.zeros((0, 4)), *pieces]))


@kernel
def outward_normal(outlines, group, x, y):
    """Return the outward unit normal of a rigid body next to a place.

    x, y: where the place was for the body at the start (m)
    """
    nearest, nx, ny = inf, 0.0, 0.0
    for s in range(outlines.first[group], outlines.first[group + 1]):
        x0, y0 = outlines.ends[s, 0], outlines.ends[s, 1]
        dx, dy = outlines.ends[s, 2] - x0, outlines.ends[s, 3] - y0
        length = sqrt(dx * dx + dy * dy)
        along = min(max(((x - x0) * dx + (y - y0) * dy) / length**2, 0.0), 1.0)
        ox, oy = x - x0 - along * dx, y - y0 - along * dy
        away = sqrt(ox * ox + oy * oy)
        if away < nearest:
            nearest, nx, ny = away, dy / length, -dx / length
            if (along == 0.0 or along == 1.0) and away > 0.0:  # of a corner
                side = 1.0 if ox * nx + oy * ny >= 0.0 else -1.0
                nx, ny = side * ox / away, side * oy / away
    return nx, ny


@kernel
def normal_beside_rigid(pairs, i, place, rigid, outlines, way):
    """Return the normal from row a to row b of pair i, of which one body is rigid.

    place: of the node (m); rigid: (groups,) 1 for rigid ones; way: (groups, dim) gone so far (m)
    """
    ga, gb = pairs.group[i, 0], pairs.group[i, 1]
    group, sign = (ga, 1.0) if rigid[ga] else (gb, -1.0)
    nx, ny = outward_normal(outlines, group, place[0] - way[group, 0], place[1] - way[group, 1])
    return sign * nx, sign * ny
