"""Events of a deck, and the signals of the conditions that wait for them."""

from cramp_cli.boundary.events import CrackReaches, ReactionReaches
from cramp_cli.deck.events import boundary_names, event_of
from cramp_cli.deck.where import AXES
from cramp_cli.state.signal import Signal

WORDS = {"hold_when": ("is held", 0.0), "reverse_when": ("is reversed", -1.0)}


class EventList:
    """Collects the events of a model, in the order of those who wait for them."""

    def __init__(self, deck):
        self.deck, self.events = deck, []

    def signal(self, section, name: str) -> Signal:
        """Return the signal of a load, a boundary or a rigid motion; name: of it, for the log."""
        found = event_of(section)
        if found is None:
            return Signal(section.in_time)
        key, event = found
        words, pace = WORDS[key]
        self.events.append(self._event(event, f"{name} {words}"))
        return Signal(section.in_time, len(self.events) - 1, pace)

    def _event(self, event, what):
        if event.crack is not None:
            crack = [one.name for one in self.deck.cracks].index(event.crack)
            told = f"crack {event.crack} is {event.length:.6g} m long: {what}"
            return CrackReaches(crack, event.length, told)
        boundary = boundary_names(self.deck).index(event.reaction)
        axis = AXES.index(event.direction) if event.direction else None
        told = f"reaction of {event.reaction} is {event.force:.6g} N: {what}"
        return ReactionReaches(boundary, axis, event.force, told)
