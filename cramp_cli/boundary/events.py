"""What a load or a boundary may wait for: a crack of a length, a reaction of a size."""

from dataclasses import dataclass
from math import hypot

import numpy as np

from cramp_cli.cracks.tips import crack_length


@dataclass(frozen=True)
class CrackReaches:
    """A crack is at least so long."""

    crack: int
    length: float  # m
    told: str  # what happens then

    def reached(self, state) -> bool:
        """Return whether it has happened."""
        return crack_length(state.paths, self.crack) >= self.length


@dataclass(frozen=True)
class ReactionReaches:
    """The reaction of a boundary, or a component of it, is at least so large; either sign."""

    boundary: int
    axis: int | None  # 0, 1; None: the size of the vector
    force: float  # N
    told: str  # what happens then

    def reached(self, state) -> bool:
        """Return whether it has happened in the last step."""
        reaction = state.reactions[self.boundary].tolist()
        size = hypot(*reaction) if self.axis is None else abs(reaction[self.axis])
        return size >= self.force


def new_events(model, state) -> list[str]:
    """Note the time of all events that have just happened; return what they do."""
    told = []
    for number, event in enumerate(model.events):
        if np.isinf(state.events[number]) and event.reached(state):
            state.events[number] = state.time
            told.append(event.told)
    return told


def past_events(model, state) -> list[dict]:
    """Return time (s) and text of all events that have happened, the first one first."""
    happened = [
        {"time": float(time), "event": event.told}
        for time, event in zip(state.events, model.events, strict=True)
        if not np.isinf(time)
    ]
    return sorted(happened, key=lambda one: one["time"])
