"""What a growing tip meets: the surface of the body, another crack, the end of the grid."""

from typing import NamedTuple

import numpy as np

from cramp_cli.cracks.extend import end_point, insert_point, move_end
from cramp_cli.state.failure import NumericalFailure
from cramp_cli.state.paths import TIP, Paths

AHEAD = 0.25  # a crack this near ahead of a tip (cells) is met
BESIDE = (
    0.5  # so is one that the tip would pass within this distance (cells): nothing could hold it
)
OUTSIDE = 1.05  # distance from the nearest particle, in half diagonals of it, beyond which is air
BEYOND = 0.5  # the last piece of a crack that has left the body is at least this long (cells)
SNAP = 0.04  # of BESIDE; a point of a crack nearer than this is met in the point itself
RECENT = 3  # pieces behind a tip that it can not run into


def has_left_body(model, cloud, place) -> bool:
    """Return whether no particle holds a place of the undeformed body; cloud: those around it."""
    if not cloud.parts:
        return True
    away = np.sum((cloud.particles.origin - place) ** 2, axis=1)
    nearest = int(np.argmin(away))
    if model.half is not None:
        half = model.half[cloud.particles.id[nearest]]
    else:
        half = next(block.shape.half for block, lo, hi in cloud.parts if lo <= nearest < hi)
    reach = OUTSIDE * model.lattice.width * np.hypot(*half)
    return bool(away[nearest] > reach * reach)


def leave_body(model, state, tip, heading, now) -> None:
    """Make the last piece so long that its continuation into free space parts the body.

    An edge is carried on by a multiple of its last piece (crossing.py).
    """
    rest = BEYOND * model.lattice.width - float(state.growth.piece[2 * tip.crack + tip.end])
    if rest > 0.0:
        move_end(state.paths, tip.crack, tip.end, rest * heading, rest * np.array(now))


def stay_on_grid(model, state, tip) -> None:
    """Raise NumericalFailure for a tip in the outermost cells."""
    lattice, place = model.lattice, state.paths.point[tip.points[0]]
    low = np.array(lattice.lower) + lattice.width
    high = np.array(lattice.lower) + lattice.width * (np.array(lattice.cells) - 1)
    if np.any(place < low) or np.any(place > high):
        name = model.crack_names[tip.crack]
        x, y = place
        raise NumericalFailure(
            f"step {state.step}, t = {state.time:.6g} s: crack {name} has grown to the border of "
            f"the grid at ({x:.6g}, {y:.6g}) m.\nMake the grid larger: two empty cells around all "
            "bodies at every moment"
        )


class Met(NamedTuple):
    """Where a tip ends on a crack."""

    before: np.ndarray  # way to there in the undeformed body (m)
    now: np.ndarray  # the same now (m)
    other: tuple | None  # crack and end of the tip that is met, if it is one
    crack: int  # the crack that is met
    piece: int  # number of the point before the place on it
    share: float  # of the way to the next point


def first_met(model, state, tip, now, step) -> Met | None:
    """Return what a tip meets in a step (m), or None.

    now: unit vector of the way. What it meets is the nearest crack ahead, or one that it would pass
    too closely: two tips that come to meet each other are hardly ever on one line.
    """
    paths, width, now = state.paths, model.lattice.width, np.array(now)
    at = end_point(paths, tip.crack, tip.end)
    nearest, found = np.inf, None
    for crack in range(paths.crack_count):
        points = np.arange(paths.start[crack], paths.start[crack + 1])
        if crack == tip.crack:
            points = points[: -RECENT - 1] if tip.end else points[RECENT + 1 :]
        if len(points) < 2:
            continue
        ends = paths.point[points] - paths.point[at]
        away, piece, share = _ahead(ends, now)
        limit = step + AHEAD * width
        if piece < 0:
            away, piece, share = _beside(ends, now)
            limit = BESIDE * width
        if away < min(limit, nearest):
            nearest = away
            found = _met(paths, at, crack, points[piece], share, BESIDE * width)
    return found


def _met(paths, at, crack, piece, share, near) -> Met:
    """Return how a crack is met in a piece of it, at a share of the piece's length.

    A tip that is near is met at its end, if that lies ahead, and a junction in its point.
    """
    place = (1.0 - share) * paths.point[piece] + share * paths.point[piece + 1]
    other = None
    for end in (0, 1):
        k = end_point(paths, crack, end)
        if paths.ends[crack, end] == TIP and np.hypot(*(paths.point[k] - place)) < near:
            other = (crack, end)
            ahead = (paths.point[k] - paths.point[at]) @ (place - paths.point[at]) > 0.0
            piece, share = (k - end, float(end)) if ahead else (piece, share)
    for k in range(paths.start[crack], paths.start[crack + 1]):
        away = np.hypot(*(paths.point[k] - place))
        if other is None and away < (0.5 if paths.joint[k] >= 0 else SNAP) * near:
            piece, share = (k - 1, 1.0) if k > paths.start[crack] else (k, 0.0)
    before, now = (
        (1.0 - share) * line[piece] + share * line[piece + 1] - line[at]
        for line in (paths.origin, paths.point)
    )
    return Met(before, now, other, crack, piece, share)


def join_met(paths, tip, met) -> Paths:
    """Return cracks with a junction where the end of a tip has come to lie on another crack.

    Of a crack that meets itself nothing is made: the junction would have one branch twice.
    """
    if met.crack == tip.crack:
        return paths
    k = met.piece + round(met.share)
    if 0.0 < met.share < 1.0:
        paths, k = insert_point(paths, met.crack, met.piece, met.share), met.piece + 1
    at = end_point(paths, tip.crack, tip.end)
    if paths.joint[k] < 0:
        paths.joint[k] = 1 + np.max(paths.joint)
    paths.joint[at] = paths.joint[k]
    paths.point[at] = paths.point[k]
    return paths


def _ahead(ends, way) -> tuple[float, int, float]:
    """Return how far ahead a polyline is cut, in which piece, and where; piece -1 if it is not.

    ends: (n, 2) points of the polyline from the place; way: unit vector
    """
    a, b = ends[:-1], ends[1:]
    side_a, side_b = (way[0] * p[:, 1] - way[1] * p[:, 0] for p in (a, b))
    cut = np.flatnonzero((side_a > 0.0) != (side_b > 0.0))
    share = side_a[cut] / (side_a[cut] - side_b[cut])
    along = (a[cut] + share[:, None] * (b[cut] - a[cut])) @ way
    cut, share, along = (values[along >= 0.0] for values in (cut, share, along))
    if not len(cut):
        return np.inf, -1, 0.0
    first = int(np.argmin(along))
    return float(along[first]), int(cut[first]), float(share[first])


def _beside(ends, way) -> tuple[float, int, float]:
    """Return how near a polyline is at its nearest point, and where; inf if that lies behind."""
    a, edge = ends[:-1], np.diff(ends, axis=0)
    share = np.clip(-np.sum(a * edge, axis=1) / np.sum(edge * edge, axis=1), 0.0, 1.0)
    there = a + share[:, None] * edge
    piece = int(np.argmin(np.sum(there * there, axis=1)))
    away = float(np.hypot(*there[piece])) if there[piece] @ way > 0.0 else np.inf
    return away, piece, float(share[piece])
