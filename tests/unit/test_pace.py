"""Steps follow what moves fast, and a solution that blows up is seen."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from runs import Listener, Rows
from support import build_deck, read

from cramp_cli.build import build
from cramp_cli.pace import FARTHEST, keep_pace, largest_speed
from cramp_cli.simulation import simulate
from cramp_cli.state.failure import NumericalFailure

GEL = """
cramp: 1
analysis: plane_strain
grid: {cell: 1 mm, lower: [-30 mm, -10 mm], upper: [60 mm, 30 mm]}
materials:
  gel: {law: neo_hookean, density: 1000, E: 10 kPa, nu: 0.3}
bodies:
  - {name: pad, material: gel, shape: {type: rectangle, lower: [0, 0], upper: [4 mm, 6 mm]}}
  - name: plate
    rigid: {velocity: [100 m/s, 0]}
    shape: {type: rectangle, lower: [-20 mm, -5 mm], upper: [-18 mm, 15 mm]}
contact: {bodies: {law: frictional}}
solver: {end_time: 2.2 ms}
output: {history_every: 2.2 ms}
"""


@given(st.floats(0.0, 500.0), st.floats(0.0, 500.0))
def test_nothing_moves_farther_than_a_quarter_of_a_cell(particle, plate):
    model, state = MODEL
    state.particles.velocity[:] = 0.0
    state.particles.velocity[3] = [0.6 * particle, -0.8 * particle]
    one = model.between_bodies.rigid[0]
    one.velocity[:] = [plate, 0.0]
    now = keep_pace(model, state)
    assert largest_speed(model, state) == pytest.approx(max(particle, plate))
    assert max(particle, plate) * now.dt <= FARTHEST * model.lattice.width
    halvings = np.log2(model.dt / now.dt)
    assert halvings == round(halvings)
    if now.dt < model.dt:  # and no step is shorter than it must be
        assert max(particle, plate) * 2.0 * now.dt > FARTHEST * model.lattice.width


MODEL = build_deck(GEL)[:2]


@pytest.mark.parametrize("speed", [1e5, np.inf, np.nan])
def test_what_no_solid_bears_ends_the_run(speed):
    model, state, _ = build_deck(GEL)
    state.particles.velocity[3, 0] = speed
    with pytest.raises(NumericalFailure, match="something moves at|no number"):
        keep_pace(model, state)


def outcome(deck):
    """Return the rows of a run that may fail, its state, and whether it has."""
    deck = read(deck)
    model, state = build(deck)
    rows, failed = Rows(), ""
    rows.failure = lambda *_: "nowhere"
    try:
        simulate(deck, model, state, rows, Listener())
    except NumericalFailure as failure:
        failed = str(failure)
    return rows.tables["history"], state, failed


def test_a_plate_faster_than_waves_does_not_throw_the_pad_out():
    """Before, it moved by 13 cells in a step: energies of 1e76 were written."""
    history, state, failed = outcome(GEL)
    mass = float(state.particles.mass.sum())
    kinetic = 0.5 * mass * 100.0**2
    assert history
    assert all(row["kinetic_energy"] < 8.0 * kinetic for row in history)
    assert np.abs(state.particles.position).max() < 0.1
    assert failed == "" or "energy balance" in failed or "inside out" in failed


UNSTABLE = """
cramp: 1
analysis: plane_strain
grid: {cell: 1}
materials: {m: {law: elastic, density: 1, E: 1, nu: 0.3}}
bodies:
  - {name: block, material: m, shape: {type: rectangle, lower: [0, 0], upper: [8, 6]}}
  - {name: floor, rigid: {}, shape: {type: rectangle, lower: [-1, -2], upper: [9, 0]}}
contact: {bodies: {law: frictional}}
loads: [{type: gravity, acceleration: [0, -1.0e-5]}]
solver: {end_time: 2000, cfl: 1.0, update: fmpm(8), strain: usl-}
output: {history_every: 2000}
"""


def test_a_blow_up_between_two_rows_ends_the_run():
    """Without a crack, and with a rigid body only touching; there is no row until the end."""
    _, state, failed = outcome(UNSTABLE)
    assert failed
    assert state.step < 400
    assert np.abs(state.particles.velocity).max() < 10.0  # waves have 1.16
