"""Factors of loads and prescribed velocities over time, which an event may hold or turn back.

Every condition has a clock of its own. It shows the time t of the run, until the event that the
condition waits for happens at t_e. From then on it shows

    held:      t_e,           as if time stood still
    reversed:  2 t_e - t,     as if time ran back, until it is 0

A load is what its curve says at the time of the clock. A prescribed velocity is what brings the
boundary to where it was at that time: nothing while the clock stands, and the opposite of what its
curve says while it runs back.
"""

from dataclasses import dataclass
from math import isinf
from typing import Any, NamedTuple

NONE = -1  # the number of no event


class Clock(NamedTuple):
    """What a condition knows of the time."""

    time: float  # s
    pace: float  # seconds of it per second: 1, 0 or -1


@dataclass(frozen=True)
class Signal:
    """A curve over time, and what an event makes of it."""

    curve: Any  # .value(t), .integral(t)
    event: int = NONE  # number of the event after which the clock goes at another pace
    pace: float = 1.0  # 0: held, -1: reversed

    def clock(self, state) -> Clock:
        """Return the clock of the condition in a state."""
        now = state.time
        since = state.events[self.event] if self.event != NONE else now
        if self.event == NONE or isinf(since):
            return Clock(now, 1.0)
        time = since + self.pace * (now - since)
        return Clock(time, self.pace) if time > 0.0 else Clock(0.0, 0.0)

    def load(self, state) -> float:
        """Return what a load is multiplied by."""
        return self.curve.value(self.clock(state).time)

    def speed(self, state) -> float:
        """Return what a prescribed velocity is multiplied by."""
        time, pace = self.clock(state)
        return pace * self.curve.value(time) if pace else 0.0

    def distance(self, state) -> float:
        """Return how far a prescribed velocity of 1 has gone: where the clock was last (s)."""
        return self.curve.integral(self.clock(state).time)
