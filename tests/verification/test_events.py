"""Loads and boundaries that an event holds or reverses: by reaction, by crack, through a resume."""

import numpy as np
import pytest
import yaml
from runs import Listener, Rows
from support import advance, build_deck, read
from verification.test_growing_cracks import PLATE

from cramp_cli.boundary.events import new_events
from cramp_cli.build import build
from cramp_cli.output.checkpoint import read_state, write_state
from cramp_cli.schema.curve import Ramp
from cramp_cli.schema.mistake import DeckError
from cramp_cli.scratch import make_scratch
from cramp_cli.simulation import simulate
from cramp_cli.state.signal import Signal

PULLED = {
    "cramp": 1,
    "analysis": "plane_stress",
    "grid": {"cell": 1.0},
    "materials": {"m": {"law": "elastic", "density": 1.0, "E": 1.0, "nu": 0.0}},
    "bodies": [
        {
            "name": "bar",
            "material": "m",
            "shape": {"type": "rectangle", "lower": [0, 0], "upper": [6, 2]},
        }
    ],
    "boundary": [
        {"name": "wall", "where": {"x": 0}, "fix": ["x"]},
        {"name": "grip", "where": {"x": 6}, "velocity": {"x": 1e-4}},
    ],
    "solver": {"end_time": 400.0, "damping": {"particle": 0.1}},
}
FORCE = 1e-3  # N: of a strain of 5e-4 in a bar of 2 m^2 and 1 Pa


def pulled(key, **event):
    """Return the deck of a bar whose grip waits for an event."""
    wall, grip = PULLED["boundary"]
    return PULLED | {"boundary": [wall, grip | {key: event or BY_FORCE}]}


BY_FORCE = {"reaction": "wall", "force": FORCE, "direction": "x"}
RAMP = {"in_time": {"type": "ramp", "until": 100.0}}


def follow(deck):
    """Run a deck; return the events as told, model, last state and summary."""
    deck = read(deck)
    model, state = build(deck)
    rows, listener, told = Rows(), Listener(), []
    listener.message = lambda level, text: told.append(text)
    summary = simulate(deck, model, state, rows, listener)
    return [text for text in told if "held" in text or "reversed" in text], model, state, summary


class State:
    """As much of a state as a signal asks for."""

    def __init__(self, time, event):
        self.time, self.events = time, np.array([event])


@pytest.mark.parametrize(("pace", "load", "speed", "gone"), [
    (0.0, [0.25, 0.5, 0.5, 0.5], [0.25, 0.5, 0.0, 0.0], [0.125, 0.5, 0.5, 0.5]),
    (-1.0, [0.25, 0.5, 0.25, 0.0], [0.25, 0.5, -0.25, 0.0], [0.125, 0.5, 0.125, 0.0]),
])  # fmt: skip
def test_a_clock_stands_still_or_runs_back(pace, load, speed, gone):
    """A ramp over 4 s; the event comes at 2 s."""
    signal = Signal(Ramp(until=4.0), 0, pace)
    before, after = np.inf, 2.0
    states = [State(1.0, before), State(2.0, before), State(3.0, after), State(4.5, after)]
    assert [signal.load(one) for one in states] == load
    assert [signal.speed(one) for one in states] == speed
    assert [signal.distance(one) for one in states] == gone


@pytest.mark.parametrize("key", ["hold_when", "reverse_when"])
def test_a_grip_waits_for_a_reaction(key):
    """The wall feels FORCE = E A u/L at u = 3 mm, after 30 s; a wave runs up and down in 12 s.

    In the end the bar is at rest, under the stress of the way that the grip has gone, or of none.
    """
    told, model, state, summary = follow(pulled(key))
    (event,) = summary.events
    assert len(told) == 1
    assert event["event"] in told[0]
    assert event["time"] == pytest.approx(30.0, abs=6.5)
    stress = 1e-4 * event["time"] / 6.0 if key == "hold_when" else 0.0
    nearly = 0.015 * FORCE / 2.0  # measured: 1.1 % in the particles at the grip
    np.testing.assert_allclose(state.particles.stress[:, 0], stress, atol=nearly)


WEIGHT = {
    "name": "weight",
    "type": "gravity",
    "acceleration": [1.0e-9, 0],
    "hold_when": {"crack": "flat", "length": 8},
    "in_time": {"type": "ramp", "until": 16},
}


def test_a_load_waits_for_a_crack():
    """It grows from 6 to 8 m at 0.25 m/s: 8 s, when the ramp is at one half."""
    (told,), model, state, summary = follow(
        yaml.safe_load(PLATE) | {"loads": [WEIGHT], "solver": {"end_time": 12}}
    )
    assert told.endswith("crack flat is 8 m long: load weight is held")
    assert summary.events[0]["time"] == pytest.approx(8.0, abs=1.5 * model.dt)
    a, dt = 1e-9, model.dt
    speed = sum(a * min(n * dt, summary.events[0]["time"]) / 16.0 * dt for n in range(state.step))
    assert state.particles.velocity[:, 0].mean() == pytest.approx(speed, rel=1e-6)


def test_a_resumed_run_remembers_its_events(tmp_path):
    """Bit for bit: the time of the event is part of the state."""
    deck = pulled("reverse_when")
    model, state, scratch = build_deck(deck)

    def go(state, scratch, steps):
        for _ in range(steps):
            advance(model, state, scratch, 1)
            new_events(model, state)

    go(state, scratch, 90)
    assert np.isfinite(state.events).all()
    write_state(tmp_path / "s.h5", state, {})
    again = read_state(tmp_path / "s.h5", build(read(deck))[1]).state
    go(state, scratch, 20)
    go(again, make_scratch(model, again), 20)
    assert again.particles.velocity.tobytes() == state.particles.velocity.tobytes()
    assert again.events.tobytes() == state.events.tobytes()


@pytest.mark.parametrize(("event", "told"), [
    ({"reaction": "walls", "force": 1}, "reaction: unknown boundary 'walls'; did you mean 'wall'?"),
    ({"crack": "c", "length": 1}, "crack: unknown crack 'c' (known: none)"),
    ({"crack": "c"}, "length: is missing; it goes with crack"),
    ({"reaction": "wall"}, "force: is missing; it goes with reaction"),
    ({"crack": "c", "length": 1, "force": 1}, "force: goes with reaction"),
    ({}, "give one of crack, reaction"),
])  # fmt: skip
def test_events_that_can_not_happen_are_told(event, told):
    with pytest.raises(DeckError) as caught:
        read(PULLED, boundary=[PULLED["boundary"][0] | {"velocity": {"x": 1}, "fix": None,
                                                        "hold_when": event}])  # fmt: skip
    assert told in str(caught.value)


def test_a_crack_must_grow_to_a_length_that_it_has_not():
    crack = {"name": "c", "points": [[0, 1], [2, 1]], "start": "edge", "end": "tip"}
    load = {"type": "traction", "body": "bar", "where": {"y": 2}, "traction": [0, 1]} | RAMP
    other = {"propagation": {"criterion": "critical_J", "cracks": ["d"]}}
    both = {"cracks": [crack, crack | {"name": "d", "points": [[4, 1], [6, 1]]}]}
    for length, more, told in (
        (3.0, {}, "crack: 'c' does not grow: the deck has no `propagation`"),
        (3.0, other | both, "crack: 'c' does not grow: name it in propagation"),
        (1.5, {"propagation": {"criterion": "critical_J"}}, "at the start, 2 m (got 1.5 m)"),
    ):
        waits = load | {"hold_when": {"crack": "c", "length": length}}
        with pytest.raises(DeckError) as caught:
            read(PULLED | {"cracks": [crack], "loads": [waits]} | more)
        assert told in str(caught.value)


@pytest.mark.parametrize("key", ["hold_when", "reverse_when"])
@pytest.mark.parametrize("curve", [{}, {"in_time": "constant"}, {"in_time": "step"}])
def test_a_load_that_is_the_same_at_all_times_can_not_wait(key, curve):
    """Its clock may stand or run back: the load would stay as it is, without a word."""
    load = {"type": "force", "body": "bar", "where": {"x": 6}, "total": [1, 0], key: BY_FORCE}
    with pytest.raises(DeckError, match=f"loads.0.{key}: .*give it `in_time`"):
        read(PULLED, loads=[load | curve])
    read(PULLED, loads=[load | RAMP])
