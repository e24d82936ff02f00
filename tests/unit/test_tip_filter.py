"""What an update filters beside a running tip is J, and no damping."""

import numpy as np
import pytest
from support import advance, build_deck

DECK = """
cramp: 1
analysis: plane_strain
grid: {cell: 1}
materials: {m: {law: elastic, density: 1.0, E: 1.0, nu: 0.3}}
bodies: [{name: b, material: m, shape: {type: rectangle, lower: [0, 0], upper: [16, 9]}}]
cracks: [{name: c, points: [[0, 4.2], [7.5, 4.2]], start: edge, contact: {law: ignore}}]
solver: {end_time: 1.0}
"""
TIP = (7.5, 4.2)


@pytest.fixture(autouse=True)
def the_update_alone(monkeypatch):
    """Leave the update alone with the energy: no tractions, no nodes that follow tips at rest."""
    monkeypatch.setattr("cramp_cli.step.resist_opening", lambda model, state, scratch: None)
    for module in ("step", "grid_velocity", "cracks.tip_filter"):
        name = f"cramp_cli.{module}.follow_behind_tips"
        monkeypatch.setattr(name, lambda model, scratch, field: None)


def moved(update, *, running, damping=0.0):
    """Return what damping has booked in a step (J), and what the particles have lost, by place.

    They begin with random velocities; strained last (USL) they have no stress: only the update
    takes energy.
    """
    solver = {"update": update, "strain": "usl-", "damping": {"grid": damping}}
    model, state, scratch = build_deck(DECK, solver=solver)
    particles = state.particles
    particles.velocity[:] = np.random.default_rng(1).normal(size=particles.velocity.shape)
    state.growth.running[1] = running
    before = np.sum(particles.velocity**2, axis=1)
    advance(model, state, scratch, 1)
    lost = 0.5 * particles.mass * (before - np.sum(particles.velocity**2, axis=1))
    return float(state.books.damping[0]), lost, np.hypot(*(particles.origin - TIP).T)


@pytest.mark.parametrize("update", ["fmpm(2)", "xpic(2)"])
def test_only_what_is_filtered_away_from_a_running_tip_is_damping(update):
    at_rest, lost, away = moved(update, running=0)
    running = moved(update, running=1)[0]
    near = np.clip(4.0 - away, 0.0, 1.0)
    assert at_rest == pytest.approx(lost.sum(), rel=1e-9)
    assert at_rest - running == pytest.approx(near @ lost, rel=1e-9)
    assert near @ lost > 0.1 * at_rest


def test_the_damping_of_the_deck_is_booked_everywhere():
    """It acts in the field around the tip and does not flow into the tip."""
    filtered = moved("fmpm(2)", running=1)[0]
    both, lost, away = moved("fmpm(2)", running=1, damping=0.1)
    share = both - filtered
    everywhere = moved("fmpm(2)", running=0, damping=0.1)[0] - moved("fmpm(2)", running=0)[0]
    assert share == pytest.approx(everywhere, rel=1e-9)


def test_flip_books_no_filter():
    assert moved("flip", running=1)[0] == pytest.approx(0.0, abs=1e-12)
