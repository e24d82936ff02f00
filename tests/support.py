"""What tests of several folders need: a deck becomes a model, a model takes steps."""

from contextlib import nullcontext
from pathlib import Path

import yaml

from cramp_cli.build import build
from cramp_cli.cracks.fields import find_rows, list_cracks
from cramp_cli.cracks.grow import grow
from cramp_cli.deck.deck import check_deck
from cramp_cli.schema.mistake import Source
from cramp_cli.scratch import make_scratch
from cramp_cli.step import step
from cramp_cli.transfer.sums import locate_particles


def read(deck, **overrides):
    """Return a checked deck from its text or its data; see `build_deck` for the overrides."""
    data = yaml.safe_load(deck) if isinstance(deck, str) else deck
    data = merged(data, overrides)
    return check_deck(Source("test", yaml.safe_dump(data), data), Path())


def build_deck(deck, **overrides):
    """Return model, state and scratch arrays of a deck, given as text or as data.

    Overrides replace sections, or keys within them: `solver={"shape": "linear"}` leaves the other
    keys of the solver as they are.
    """
    model, state = build(read(deck, **overrides))
    return model, state, make_scratch(model, state)


def advance(model, state, scratch, steps):
    """Take a number of time steps."""
    for _ in range(steps):
        step(model, state, scratch, lambda title: nullcontext())


def advance_growing(model, state, scratch, steps):
    """Take a number of time steps, after each of which the cracks may grow; return the events."""
    events = []
    for _ in range(steps):
        advance(model, state, scratch, 1)
        events += grow(model, state, scratch)
    return events


def locate(model, state, scratch):
    """Find the rows that every particle sees, as the first paragraphs of a step do."""
    list_cracks(model, state, scratch)
    locate_particles(model, state, scratch)
    find_rows(model, state, scratch)


def merged(data, changes):
    """Return nested dictionaries with those of `changes` written over them."""
    data = dict(data)
    for key, value in changes.items():
        both = isinstance(value, dict) and isinstance(data.get(key), dict)
        data[key] = merged(data[key], value) if both else value
    return data
