"""What a deck says about events: when a load or a prescribed motion is held or reversed."""

from collections.abc import Iterator
from typing import Any, Literal

from pydantic import Field

from cramp_cli.schema.curve import Constant, Step
from cramp_cli.schema.section import Name, Section, Wrong, only_one, unknown
from cramp_cli.schema.units import Force, Length

KEYS = ("hold_when", "reverse_when")
HOLD = "event from which on it stays as it is: a load keeps its size, a boundary stands still"
REVERSE = "event from which on it goes back the way it came, until it is as at time 0"
GOES_WITH = {"length": "crack", "force": "reaction", "direction": "reaction"}


class EventSection(Section):
    """What is waited for: a crack reaches a length, or a reaction a force."""

    crack: Name | None = Field(None, description="a crack that grows; with `length`")
    length: Length | None = Field(None, gt=0, description="length of the whole crack")
    reaction: Name | None = Field(None, description="a boundary; with `force`")
    force: Force | None = Field(
        None, gt=0, description="size of its reaction in one step, whatever its sign"
    )
    direction: Literal["x", "y"] | None = Field(
        None, description="component of the reaction; the size of the vector if not given"
    )

    @classmethod
    def wrong_keys(cls, keys: set[str]) -> Iterator[Wrong]:
        """One kind of event, and how much of it."""
        yield from only_one(keys, ("crack", "reaction"))
        for key, of in GOES_WITH.items():
            if key in keys and of not in keys:
                yield (key,), f"goes with {of}"
        for of, key in (("crack", "length"), ("reaction", "force")):
            if of in keys and key not in keys:
                yield (key,), f"is missing; it goes with {of}"


def event_of(section: Any) -> tuple[str, EventSection] | None:
    """Return the key and the event that a load or a boundary waits for, None if for nothing."""
    given = ((key, getattr(section, key, None)) for key in KEYS)
    return next(((key, event) for key, event in given if event is not None), None)


def boundary_names(deck: Any) -> list[str]:
    """Return the names of all boundaries; those without one are called by their number."""
    return [one.name or f"boundary_{number}" for number, one in enumerate(deck.boundary, 1)]


def event_mistakes(deck: Any) -> Iterator[Wrong]:
    """Yield events that can not happen; deck: right in its sections by themselves."""
    for path, section in _waiting(deck):
        found = event_of(section)
        if found is None:
            continue
        key, event = found
        if path[0] == "loads" and isinstance(section.in_time, Constant | Step):
            message = "a load that does not change in time has nothing to hold or to go back to"
            yield (*path, key), f"{message}: give it `in_time`, a ramp for instance"
        if event.crack is not None:
            yield from _crack_mistakes(deck, (*path, key), event)
        elif event.reaction not in boundary_names(deck):
            names = boundary_names(deck)
            yield (*path, key, "reaction"), unknown("boundary", event.reaction, names)


def _waiting(deck) -> Iterator[tuple]:
    """Yield path and section of all that may wait for an event."""
    for place, boundary in enumerate(deck.boundary):
        yield ("boundary", place), boundary
    for place, load in enumerate(deck.loads):
        yield ("loads", place), load
    for place, body in enumerate(deck.bodies):
        if body.rigid:
            yield ("bodies", place, "rigid"), body.rigid


def _crack_mistakes(deck, path, event) -> Iterator[Wrong]:
    crack = next((one for one in deck.cracks if one.name == event.crack), None)
    growth = deck.propagation
    if crack is None:
        yield (*path, "crack"), unknown("crack", event.crack, [one.name for one in deck.cracks])
    elif growth is None:
        yield (*path, "crack"), f"'{event.crack}' does not grow: the deck has no `propagation`"
    elif event.crack not in (growth.cracks or (event.crack,)):
        yield (*path, "crack"), f"'{event.crack}' does not grow: name it in propagation"
    elif crack.length >= event.length:
        message = f"must be more than the crack has at the start, {crack.length:.6g} m"
        yield (*path, "length"), f"{message} (got {event.length:.6g} m)"
