"""Where a prescribed velocity acts: on a line of nodes that goes with the face it moves.

Nodes stand still and the face that they push or pull does not. A line held for good would lose a
face that it pushes on by more than a cell, without a word, and the sooner the finer the grid; one
that draws would hold other parts of the solid than its face. So the line goes on with the face, and
with it those outside, which the outermost particles still see. A face that has been pushed by
less than half a cell, or drawn by less than one, is held by its first line alone.
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

    def cells(self, gone: float) -> int:
        """Return by how many lines the line to hold has moved on; gone: way of the face (m).

        A face that is pushed leaves its line outside, and the nearest line is held: half a cell
        from it the outermost particles still see that line. A face that is drawn takes the solid
        along across its line: the last one within the solid is held, for one outside lets go of it.
        """
        moved = gone / self.width
        return int(moved) if moved * self.outside > 0.0 else floor(moved + 0.5)

    def lines(self, cells: int, outer: int) -> list[int]:
        """Return the lines of nodes that hold a face on line `cells`, with so many outside it."""
        wanted = {cells + n * self.outside for n in range(outer + 1)}
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
        self._had_mass = False

    def _room(self) -> np.ndarray:
        return np.zeros(3 * len(self.held.node) + 8, dtype=np.int64)

    def follow(self, state) -> bool:
        """Go on to the line of nodes nearest to the face; return whether that is another one."""
        hold, travel = self.hold, self.hold.travel
        if travel is None:
            return False
        cells = travel.cells(travel.speed * hold.signal.distance(state))
        if cells == self.cells:
            return False
        self.cells, self.beyond = cells, None if cells else hold.beyond
        outer = 0 if not cells else 1 if hold.beyond is None else 2
        steps = [line * travel.stride for line in travel.lines(cells, outer)]
        self.held = hold.held._replace(
            node=np.concatenate([hold.held.node + step for step in steps] or [hold.held.node[:0]]),
            inside=np.tile(hold.held.inside, len(steps)),
        )
        self.rows = self._room()
        return True

    def has_let_go(self, mass) -> bool:
        """Return whether its rows have had mass, at an earlier question, and have none now."""
        has_mass = bool(mass[self.rows[: self.count]].any())
        self._had_mass = self._had_mass or has_mass
        return self._had_mass and not has_mass

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
