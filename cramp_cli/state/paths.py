"""Cracks: lines of massless particles, each with a plane point and two surface points."""

from typing import NamedTuple

import numpy as np

PLAIN, EDGE, TIP = 0, 1, 2  # what an end of a crack is


class Paths(NamedTuple):
    """Points of all cracks, one crack after the other.

    Above is the left side when one walks from the first point of a crack to its last.
    """

    point: np.ndarray  # (points, dim) the plane of the crack, m
    origin: np.ndarray  # (points, dim) the same in the undeformed body, m
    above: np.ndarray  # (points, dim) upper surface, m
    below: np.ndarray  # (points, dim) lower surface, m
    above_velocity: np.ndarray  # (points, dim) m/s
    below_velocity: np.ndarray  # (points, dim) m/s
    law: np.ndarray  # (points,) number of the traction law of the faces here, -1 for none
    damage: np.ndarray  # (points,) what the faces have lost of it: 0 whole, 1 parted
    spent: np.ndarray  # (points, 2) energy dissipated in opening and in sliding, J/m^2
    joint: np.ndarray  # (points,) number of the junction at a point, -1 for none
    start: np.ndarray  # (cracks + 1,) first point of each crack
    ends: np.ndarray  # (cracks, 2) PLAIN, EDGE or TIP at first and last point
    fixed: np.ndarray  # (cracks,) 1 where the crack does not move
    mirror: np.ndarray  # (cracks, 2) axis normal to its symmetry plane or -1, side of the body

    @property
    def crack_count(self) -> int:
        """Number of cracks."""
        return len(self.start) - 1

    def crack(self, c: int) -> slice:
        """Return the points of crack `c` as a slice."""
        return slice(int(self.start[c]), int(self.start[c + 1]))


def make_paths(lines, ends, fixed, mirror, dim: int, joint=None) -> Paths:
    """Return closed cracks along `lines`, a list of (points, dim) arrays in metres.

    joint: (points,) of Paths; no junctions if not given
    """
    points = np.concatenate(
        [np.asarray(line, dtype=float) for line in lines] or [np.zeros((0, dim))]
    )
    return Paths(
        point=points,
        origin=points.copy(),
        above=points.copy(),
        below=points.copy(),
        above_velocity=np.zeros_like(points),
        below_velocity=np.zeros_like(points),
        law=np.full(len(points), -1, dtype=np.int64),
        damage=np.zeros(len(points)),
        spent=np.zeros((len(points), 2)),
        joint=np.array([-1] * len(points) if joint is None else joint, dtype=np.int64),
        start=np.cumsum([0, *(len(line) for line in lines)]),
        ends=np.array(ends, dtype=np.int64).reshape(len(lines), 2),
        fixed=np.array(fixed, dtype=np.int64),
        mirror=np.array(mirror, dtype=np.int64).reshape(len(lines), 2),
    )
