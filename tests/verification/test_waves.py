"""Waves along a bar against d'Alembert: fronts, plateaus, and the order of convergence.

With nu = 0 a bar in plane strain is a bar of uniaxial stress, of exact speed sqrt(E / rho).
"""

import numpy as np
import pytest
from support import advance, build_deck
from verification.solutions import bar_impact, bar_speed, bar_step_traction, vibrating_bar

from cramp_cli.build.model import SHAPES

pytestmark = pytest.mark.verification

LENGTH, E, RHO = 1.0, 100.0e6, 1000.0  # m, Pa, kg/m^3
TRANSIT = LENGTH / bar_speed(E, RHO)
V0 = 0.1  # m/s: a strain of 3e-4, so that large strains do not change the speed
UPDATES = ["flip", "fmpm(2)", "xpic(2)"]
PLATEAU = 0.02  # of the stress behind the front, in impact and under a step of traction


def bar(cells, **more):
    """Return a deck of a bar of so many cells and two cells wide, held at x = 0."""
    h = LENGTH / cells
    body = {"name": "bar", "material": "rod"}
    body["shape"] = {"type": "rectangle", "lower": [0, 0], "upper": [LENGTH, 2.0 * h]}
    return {
        "cramp": 1,
        "analysis": "plane_strain",
        "grid": {"cell": h, "lower": [-4.0 * h, -4.0 * h], "upper": [LENGTH + 4.0 * h, 6.0 * h]},
        "materials": {"rod": {"law": "elastic", "density": RHO, "E": E, "nu": 0}},
        "bodies": [body | more.pop("body", {})],
        "boundary": [{"name": "wall", "where": {"x": 0}, "fix": ["x"]}],
        "solver": {"end_time": 1},
    } | more


def advance_to(model, state, scratch, time):
    """Take the steps up to the one next to a time (s)."""
    advance(model, state, scratch, round((time - state.time) / model.dt))


def check_plateaus(x, value, exact, front, pointwise):
    """Compare the means on both sides of a front, from 0.05 m (ten cells) away from it on.

    pointwise: compare every particle too, from 0.2 m away on, where no ringing of the front is left
    """
    for side in (x < front - 0.05, x > front + 0.05):
        assert value[side].mean() == pytest.approx(exact[side].mean(), abs=PLATEAU)
    if pointwise:
        calm = np.abs(x - front) > 0.2
        assert np.abs(value - exact)[calm].max() < PLATEAU


@pytest.mark.parametrize("update", UPDATES)
def test_bar_hits_a_wall(update):
    """Contact stress -rho c v0, from the wall to the free end and back; momentum turns around."""
    deck = bar(200, body={"velocity": [-V0, 0]})
    model, state, scratch = build_deck(deck, solver={"update": update})
    p, pressure = state.particles, RHO * bar_speed(E, RHO) * V0
    for transits in (0.5, 1.5):
        advance_to(model, state, scratch, transits * TRANSIT)
        x, pointwise = p.origin[:, 0], update == "fmpm(2)"
        stress, velocity = bar_impact(x, state.time, V0, LENGTH, E, RHO)
        front = LENGTH * state.time / TRANSIT
        front = min(front, 2.0 * LENGTH - front)
        check_plateaus(x, p.stress[:, 0] / pressure, stress / pressure, front, pointwise)
        check_plateaus(x, p.velocity[:, 0] / V0, velocity / V0, front, pointwise)
        # the wall has pushed with rho c v0 all the time: p(t) = m v0 (t / transit - 1)
        momentum = p.mass @ p.velocity[:, 0] / (p.mass.sum() * V0)
        assert momentum == pytest.approx(state.time / TRANSIT - 1.0, abs=0.002)


@pytest.mark.parametrize("update", UPDATES)
def test_traction_on_the_end_of_a_bar(update):
    """The traction runs in, is doubled at the held end, and runs back."""
    traction = 1000.0  # Pa
    where = {"body": "bar", "where": {"x": LENGTH}}
    deck = bar(200, loads=[{"type": "traction", "traction": [traction, 0], **where}])
    model, state, scratch = build_deck(deck, solver={"update": update})
    p = state.particles
    for transits in (0.5, 1.5, 2.5, 3.5):
        advance_to(model, state, scratch, transits * TRANSIT)
        x, pointwise = p.origin[:, 0], update == "fmpm(2)"
        stress = bar_step_traction(x, state.time, traction, LENGTH, E, RHO)
        front = abs(LENGTH - (LENGTH * state.time / TRANSIT) % (2.0 * LENGTH))
        check_plateaus(x, p.stress[:, 0] / traction, stress / traction, front, pointwise)


def vibration_error(cells, periods, **solver):
    """Return the rms error of displacement over its amplitude, after periods of the first mode."""
    model, state, scratch = build_deck(bar(cells), solver=solver)
    p, omega = state.particles, 0.5 * np.pi / TRANSIT
    x = p.origin[:, 0]
    p.velocity[:, 0] = vibrating_bar(x, 0.0, V0, 1, LENGTH, E, RHO)
    advance_to(model, state, scratch, periods * 4.0 * TRANSIT)
    exact = V0 / omega * np.sin(omega * state.time) * np.sin(0.5 * np.pi * x / LENGTH)
    error = p.position[:, 0] - x - exact
    return np.sqrt(np.mean(error**2)) * omega / V0


@pytest.mark.parametrize("update", UPDATES)
@pytest.mark.parametrize("shape", list(SHAPES))
def test_vibrating_bar_converges_with_the_square_of_the_cell_at_least(shape, update):
    """Splines with FMPM come so near (1.6e-5 at 40 cells) that the error of time steps is left."""
    errors = [vibration_error(cells, 1.0, shape=shape, update=update) for cells in (10, 20, 40)]
    orders = np.log2(errors[:-1]) - np.log2(errors[1:])
    assert orders.min() > 1.9 or errors[-1] < 5e-5


def test_vibrating_bar_after_ten_periods():
    """Cases.md E: 1 % after ten periods; a bar of 80 cells."""
    assert vibration_error(80, 10.0) < 0.01
