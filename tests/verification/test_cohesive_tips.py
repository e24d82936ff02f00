"""Tips beside faces that carry stresses: a pressure in a crack, a bridged tip, a growing zone."""

import numpy as np
import pytest
from runs import run_input

from cramp_cli.cracks.domain import domain_values
from cramp_cli.cracks.site import site_of
from cramp_cli.cracks.tips import tips_of
from cramp_cli.scratch import make_scratch

pytestmark = pytest.mark.verification
STRESS, HALF = 1e6, 0.04  # Pa, m
FINITE = 1.11018  # of the width, by collocation: as in inputs/center_crack.yaml
K_THEORY = FINITE * STRESS * np.sqrt(np.pi * HALF)
RAMP = "in_time: {type: ramp, until: 0.1 ms}"


@pytest.fixture(scope="module")
def pulled():
    return run_input("center_crack")


@pytest.fixture(scope="module")
def pressed():
    law = f"{{law: pressure, value: 1 MPa, {RAMP}}}"
    return run_input("center_crack", f"cracks.centre.traction={law}", "loads=[]")


def test_pressure_in_a_crack_is_as_good_as_remote_tension(pressed, pulled):
    """Superposition: K_I = p sqrt(pi a) times the factor of the finite width."""
    inside, outside = pressed.tip("end")[-1], pulled.tip("end")[-1]
    assert inside["K_I"] == pytest.approx(K_THEORY, rel=0.02)
    assert inside["K_I"] == pytest.approx(outside["K_I"], rel=0.005)
    assert inside["J"] == pytest.approx(outside["J"], rel=0.005)
    assert inside["J_zone"] == 0.0
    assert inside["J_spread"] < 0.01


def test_work_of_the_pressure_is_booked(pressed):
    """Half of pressure times volume of the crack is stored, the rest is damped."""
    last = pressed.history[-1]
    assert abs(last["energy_error"]) < 1e-3
    gap = (pressed.state.paths.above - pressed.state.paths.below)[:, 1]
    volume = np.trapezoid(gap, pressed.state.paths.origin[:, 0])
    assert last["strain_energy"] == pytest.approx(0.5 * STRESS * volume, rel=0.01)


@pytest.fixture(scope="module")
def bridged():
    """Springs hold the last five cells before the tip of the centre crack."""
    law = "{law: elastic, normal: 2e12 Pa/m}"
    settings = (f"cracks.centre.traction={law}", "cracks.centre.traction_along=[20 mm, 40 mm]")
    return run_input("center_crack", *settings)


def test_J_around_a_zone_is_that_of_tip_and_zone(bridged):
    """A domain with the weight 1 along all of the zone knows of no face terms."""
    model, state = bridged.model, bridged.state
    tip = tips_of(state.paths)[0]
    site = site_of(model, state, make_scratch(model, state), tip)
    width = model.lattice.width
    around, _, _, spoiled, *_ = domain_values(model, site, 7.5 * width, inner=5.5 * width)
    assert not spoiled
    row = bridged.tip("end")[-1]
    assert 0.3 * around < row["J_zone"] < 0.6 * around
    assert row["J"] == row["J_tip"] + row["J_zone"]
    assert row["J"] == pytest.approx(around, rel=0.005)


def test_bridged_tip_agrees_with_its_K(bridged):
    """K_I^2/E' = J_tip, each with its own face term, whatever part of the zone the domain holds."""
    row = bridged.tip("end")[-1]
    stiffness = 200e9 / (1.0 - 0.3**2)
    assert row["K_I"] ** 2 / stiffness == pytest.approx(row["J_tip"], rel=0.02)
    assert row["J_spread"] < 0.01
    assert "doubtful" not in row["status"]


@pytest.mark.slow
def test_growing_tip_leaves_a_zone_behind():
    """NairnMPM 19 of the same beam under a step load: first growth at 0.4095 ms, first debond at
    0.9398 ms (its elastic limit lies at 0.2259 of the opening), later J = 400 J/m^2.

    Sharp tips, as there, until 1.1 ms: the balance is off by 9 % then and by 10 % at 1.3 ms
    (docs/theory/growth.md, Limits). With smooth ones it is by 1 % at 1.5 ms, and the first debond
    comes at 0.9679 ms, 3 % later than there.
    """
    law = "{law: triangular, normal: {peak: 1 MPa, toughness: 300 J/m^2, stiffness: 7.378e9 Pa/m}}"
    run = run_input(
        "dcb",
        f"propagation={{criterion: critical_J, traction: {law}}}",
        "materials.polymer.toughness.G_Ic=100",
        "solver.end_time=1.1 ms",
    )
    parted = [row for row in run.growth if row["kind"] == "debond"]
    assert run.growth[0]["time"] == pytest.approx(0.4095e-3, rel=0.01)
    assert parted[0]["time"] == pytest.approx(0.9398e-3, rel=0.02)
    assert parted[0]["J"] == pytest.approx(300.0, rel=1e-6)
    late = [row for row in run.tip("start") if row["time"] > parted[0]["time"]]
    assert np.mean([row["J_zone"] for row in late]) == pytest.approx(300.0, rel=0.02)
