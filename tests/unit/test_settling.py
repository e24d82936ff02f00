"""Whether K has come to rest, and the drag that lets it (docs/theory/rest.md)."""

from math import exp, pi, sqrt

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support import build_deck, read

from cramp_cli.deck.deck import DeckError
from cramp_cli.settling import SETTLED, change_over
from cramp_cli.state.rest import CRITICAL, near_critical, stretch_of, swing

BAR = """
cramp: 1
analysis: plane_stress
grid: {cell: 0.1}
materials: {m: {law: elastic, density: 1, E: 1, nu: 0}}
bodies: [{name: bar, material: m, shape: {type: rectangle, lower: [0, 0], upper: [2, 0.2]}}]
boundary: [{where: {x: 0}, fix: [x]}]
solver: {end_time: 1000, damping: auto}
"""


def settled(values, times=None):
    """Return the change of a single amount over a stretch of 1 that ends with the last value."""
    times = np.linspace(-1.0, 0.0, len(values)) if times is None else times
    return change_over(np.asarray(times), np.asarray(values, dtype=float)[:, None], 1.0, 0.0)


def test_what_stands_has_no_change_and_what_has_just_come_changes_by_all():
    assert settled([2.0] * 9) == 0.0
    assert settled([0.0] * 8 + [2.0]) == 1.0


@given(size=st.floats(1e-3, 1e6), sway=st.floats(0.02, 0.9), phase=st.floats(0.0, 2.0 * pi))
def test_a_swing_shows_its_range_at_any_moment_of_it(size, sway, phase):
    """At its mean it stands still for a moment only to the eye; K is off by as much as it sways."""
    t = np.linspace(-1.0, 0.0, 33)
    found = settled(size * (1.0 + sway * np.sin(2.0 * pi * t + phase)), t)
    assert found > 0.99 * 2.0 * sway / (1.0 + sway)


@given(left=st.floats(0.01, 0.9), rate=st.floats(0.3, 6.0))
def test_a_creep_is_called_settled_only_if_no_more_than_that_is_left(left, rate):
    """K = 1 - left exp(-rate t): with one end time for all 58 % were left under good verdicts.

    rate: 0.3 in a stretch is slower than the stretch (stretch_of) lets any creep be.
    """
    t = np.linspace(-1.0, 0.0, 33)
    values = 1.0 - left * np.exp(-rate * t)
    if left / values[-1] > 1.01 * SETTLED:
        assert settled(values, t) > SETTLED


def test_a_swing_about_nothing_is_not_judged():
    noise = np.array([[1e-3], [-1e-3], [1e-3]])
    assert change_over(np.array([0.0, 0.5, 1.0]), noise, 1.0, 2e-3) == 0.0


@given(frequency=st.floats(1e-3, 1e6), ratio=st.floats(0.0, 100.0))
def test_a_stretch_is_a_period_or_the_time_of_a_creep(frequency, ratio):
    """Over a stretch what is left of any motion falls by the factor e at least, or swings once."""
    stretch = stretch_of(frequency, 2.0 * ratio * frequency)
    assert stretch >= 0.999 * 2.0 * pi / frequency
    slow = ratio - sqrt(ratio * ratio - 1.0) if ratio > 1.0 else ratio
    assert exp(-slow * frequency * stretch) <= exp(-0.999) or ratio <= 1.0


def test_the_frequency_of_a_stretched_bar_is_that_of_rayleigh():
    """u = x e: omega^2 = E/rho * 3/L^2, where the slowest mode has (pi/2L)^2; 10 % more."""
    model, state, _ = build_deck(BAR)
    p, strain = state.particles, 1e-4
    p.position[:, 0] = p.origin[:, 0] * (1.0 + strain)
    p.work[:] = 0.5 * strain**2
    assert swing(model, state).frequency == pytest.approx(sqrt(3.0) / 2.0, rel=1e-3)
    assert near_critical(2.0) == 4.0 * CRITICAL


def test_a_body_far_away_at_rest_changes_no_bit_of_the_frequency():
    far = {"name": "far", "material": "m", "shape": {"type": "disk", "center": [9, 9], "radius": 1}}
    bodies = read(BAR).model_dump()["bodies"]
    found = []
    for more in ((), (far,)):
        data = {"bodies": [dict(bodies[0], shape=bodies[0]["shape"]), *more]}
        del data["bodies"][0]["rigid"], data["bodies"][0]["each"]
        model, state, _ = build_deck(BAR, **data)
        p = state.particles
        near = p.body == 0
        p.position[near, 0] = p.origin[near, 0] * (1.0 + 1e-4 * np.sin(p.origin[near, 0]))
        p.work[near] = p.origin[near, 1]
        found.append(swing(model, state).frequency)
    assert found[0] == found[1]


@pytest.mark.parametrize(
    ("settings", "told"),
    [
        ({"damping": {}, "stop_when": "at_rest"}, "solver.stop_when: nothing comes to rest"),
        ({"damping": "atuo"}, "solver.damping: must be auto, or a section such as"),
        ({"damping": {"partcle": 1}}, "solver.damping.partcle: unknown key"),
        ({"stop_when": "rest"}, "solver.stop_when: must be one of end_time, at_rest"),
    ],
)
def test_mistakes_of_a_deck_that_is_to_rest(settings, told):
    with pytest.raises(DeckError) as refused:
        read(BAR.replace(", damping: auto", ""), solver=settings)
    assert told in str(refused.value)


def test_a_load_without_end_lets_nothing_come_to_rest():
    load = {"type": "gravity", "acceleration": [0, -1], "in_time": {"type": "sine", "frequency": 1}}
    with pytest.raises(DeckError, match="cycles: is missing: a load that never ends"):
        read(BAR, loads=[load], solver={"stop_when": "at_rest"})
