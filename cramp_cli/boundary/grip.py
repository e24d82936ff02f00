"""Where a prescribed velocity acts: on a line of nodes that goes with the face it moves.

Nodes stand still and the face that they push or pull does not. A line held for good would lose a
face that moves on by more than a cell, without a word, and the sooner the finer the grid. So once a
face has moved on by half a cell the next line of nodes, now the nearest, is held in its place, and
with it the one outside, which the outermost particles still see. A face that has moved on by less
is held by its first line alone.
"""

from dataclasses import dataclass
from math import floor
from typing import NamedTuple

import numpy as np

from cramp_cli.boundary.beyond import Beyond
from cramp_cli.boundary.velocity import Held, find_held_rows
from cramp_cli.state.signal import Signal


class Travel(NamedTuple):
    """How the plane of a prescribed velocity moves along its normal."""

    speed: float  # m/s, to be multiplied by the signal
    width: float  # of a cell (m)
    stride: int  # from a node to the next along the normal
    before: int  # lines of nodes before the plane's own
    after: int  # lines of nodes after it
    outside: int  # -1 or 1: side of the plane on which no body lies; 0: bodies on both

    def lines(self, cells: int) -> list[int]:
        """Return the lines of nodes that hold a face which has moved on by so many cells."""
        wanted = {cells, cells + self.outside} if cells else {0}
        return sorted(line for line in wanted if -self.before <= line <= self.after)


@dataclass(frozen=True)
class Hold:
    """A prescribed velocity component: value times signal."""

    held: Held
    value: float  # m/s
    signal: Signal
    boundary: int  # number of the boundary that books the reaction
    beyond: Beyond | None = None  # nodes behind it that have to follow
    travel: Travel | None = None  # None: the plane stays where it is


class Grip:
    """Where a hold acts now: found anew from the time of the run whenever that is needed."""

    def __init__(self, hold: Hold):
        self.hold, self.cells = hold, 0
        self.held, self.beyond = hold.held, hold.beyond
        self.rows, self.count = self._room(), 0

    def _room(self) -> np.ndarray:
        return np.zeros(3 * len(self.held.node) + 8, dtype=np.int64)

    def follow(self, state) -> bool:
        """Go on to the line of nodes nearest to the face; return whether that is another one."""
        hold, travel = self.hold, self.hold.travel
        if travel is None:
            return False
        gone = travel.speed * hold.signal.distance(state)
        cells = floor(gone / travel.width + 0.5)
        if cells == self.cells:
            return False
        self.cells = cells
        steps = [line * travel.stride for line in travel.lines(cells)]
        if hold.beyond is not None:
            steps = [cells * travel.stride]
            self.beyond = hold.beyond._replace(
                node=hold.beyond.node + steps[0], image=hold.beyond.image + steps[0]
            )
        self.held = hold.held._replace(
            node=np.concatenate([hold.held.node + step for step in steps] or [hold.held.node[:0]]),
            inside=np.tile(hold.held.inside, len(steps)),
        )
        self.rows = self._room()
        return True

    def speed(self, state) -> float:
        """Return the prescribed velocity now (m/s)."""
        return self.hold.value * self.hold.signal.speed(state)

    def find_rows(self, rows, mass) -> None:
        """Find the rows that are held in this step."""
        one = self.held
        places = (one.node, one.inside, one.lower, one.upper)
        self.count = find_held_rows(self.rows, rows, mass, *places)

    def give_way(self, later: "Grip") -> None:
        """Leave rows that both hold to the later one: two reactions would book no work."""
        rows = self.rows[: self.count]
        kept = rows[~np.isin(rows, later.rows[: later.count])]
        self.rows[: len(kept)] = kept
        self.count = len(kept)


def follow_faces(grips, contested, state) -> list:
    """Let all grips go with their faces; return the pairs that may hold the same rows.

    contested: the pairs of before, None at the start
    """
    moved = [grip.follow(state) for grip in grips]
    return _contested(grips) if contested is None or any(moved) else contested


def _contested(grips) -> list:
    """Return the pairs (earlier, later) that give a node different velocities: the later counts."""
    return [
        (one, other)
        for n, one in enumerate(grips)
        for other in grips[n + 1 :]
        if one.held.axis == other.held.axis
        and (one.hold.value, one.hold.signal) != (other.hold.value, other.hold.signal)
        and len(np.intersect1d(one.held.node, other.held.node))
    ]
