"""When a solution is no longer one, and how that is said."""

from typing import ClassVar

import numpy as np
import pytest
from runs import Listener, Rows
from support import advance, build_deck, locate, read

from cramp_cli.build import build
from cramp_cli.energy_balance import SETTLED, Balance
from cramp_cli.simulation import simulate
from cramp_cli.state.failure import NumericalFailure
from cramp_cli.state.particles import DELETED

BLOCK = """
cramp: 1
analysis: plane_strain
grid: {cell: 1}
materials: {m: {law: elastic, density: 1, E: 3, nu: 0}}
bodies: [{name: block, material: m, shape: {type: rectangle, lower: [0, 0], upper: [8, 6]}}]
solver: {end_time: 1}
"""


@pytest.mark.parametrize(("place", "words", "others"), [
    ([np.nan, 1.0], "shape that is no number.\nLikely causes: the time step", "leaves"),
    ([1.0, np.inf], "shape that is no number.\nLikely causes: the time step", "leaves"),
    ([1.0, 99.0], "leaves the grid.\nMake the grid larger", "no number"),
])  # fmt: skip
def test_a_particle_without_nodes_is_named(place, words, others):
    model, state, scratch = build_deck(BLOCK)
    state.particles.position[7] = place
    with pytest.raises(NumericalFailure) as caught:
        locate(model, state, scratch)
    assert words in str(caught.value)
    assert others not in str(caught.value)


def flying(**solver):
    """Return a model of a block that flies to the right, after it has met the border."""
    sections = {"grid": {"cell": 1, "lower": [-2, -2], "upper": [11, 8]}}
    model, state, scratch = build_deck(BLOCK, solver=solver, **sections)
    state.particles.velocity[:] = 0.0
    state.particles.velocity[:, 0] = 0.2
    advance(model, state, scratch, int(8.0 / 0.2 / model.dt))
    return state, scratch, Balance(state, read(BLOCK).solver).start


def test_particles_that_leave_are_deleted_and_named():
    state, scratch, energy = flying(leaving="delete")
    alive = state.particles.mass > 0.0
    assert 0 < alive.sum() < len(alive)
    assert state.particles.position[alive, 0].max() < 11.0
    assert len(scratch.remarks) == (~alive).sum()
    assert "is deleted" in scratch.remarks[0]
    before = 0.5 * 8.0 * 6.0 * 0.2**2
    np.testing.assert_allclose(energy - state.books.external[0], before, rtol=1e-3)
    assert (scratch.index[state.particles.id[~alive]] == DELETED).all()


def test_particles_that_leave_are_held_and_named():
    state, scratch, _ = flying(leaving="clamp")
    assert (state.particles.mass > 0.0).all()
    assert 10.0 < state.particles.position[:, 0].max() < 11.0
    assert "is held at its border" in scratch.remarks[0]


class Ears:
    def __init__(self):
        self.heard = []

    def message(self, level, text):
        self.heard.append((level, text))


def judged(error, **solver):
    """Return what is said when the balance is off by a share."""
    _, state, _ = build_deck(BLOCK)
    state.step, ears = SETTLED, Ears()
    books = Balance(state, read(BLOCK, solver=solver).solver)
    books.error = error
    books.judge(state, ears)
    books.judge(state, ears)
    return ears.heard


def test_the_energy_balance_is_judged_by_the_limits_of_the_deck():
    """One percent and ten if the deck does not say; one warning is enough."""
    assert judged(0.0099) == []
    assert [level for level, _ in judged(-0.011)] == ["warning"]
    assert judged(0.3, energy_error={"warn": 0.5, "stop": 0.5}) == []
    for limits in ({}, {"energy_error": {"stop": 0.02}}):
        with pytest.raises(NumericalFailure, match=r"off by -11 %"):
            judged(-0.11, **limits)


@pytest.mark.parametrize(("update", "words"), [
    ("flip", "Lower solver.cfl"),
    ("fmpm(2)", "What fmpm(2) filters from particles is in damping_energy"),
])  # fmt: skip
def test_the_advice_is_that_for_the_update(update, words):
    with pytest.raises(NumericalFailure) as caught:
        judged(0.2, update=update)
    assert words in str(caught.value)
    assert "solver.energy_error.stop: 0.1" in str(caught.value)


def test_the_advice_for_an_unstable_pair_of_schemes():
    with pytest.raises(NumericalFailure, match=r"usl- may be unstable; use usl\+"):
        judged(0.9, update="fmpm(2)", strain="usl-")


def test_the_end_of_a_run_is_judged_however_short_it_is():
    _, state, _ = build_deck(BLOCK)
    state.step, ears = 1, Ears()
    books = Balance(state, read(BLOCK).solver)
    books.error = -0.23
    books.judge(state, ears)
    with pytest.raises(NumericalFailure, match="step 1.*off by -23 %"):
        books.judge(state, ears, at_end=True)


class Steps(Balance):
    """A balance that remembers when it was judged."""

    judged: ClassVar[list] = []

    def judge(self, state, reporter, *, at_end=False):
        self.judged.append(state.step)


def test_the_balance_is_judged_fifty_times_a_run(monkeypatch):
    """However rarely the history has a row; and at the end."""
    monkeypatch.setattr("cramp_cli.simulation.Balance", Steps)
    Steps.judged.clear()
    deck = read(BLOCK, solver={"end_time": 60.0}, output={"every": 60, "history_every": 60})
    model, state = build(deck)
    simulate(deck, model, state, Rows(), Listener())
    judged = sorted(set(Steps.judged))
    assert len(judged) >= 50
    assert np.diff(judged).max() <= state.step // 50 + 1
    assert judged[-1] == state.step


def test_a_pressure_that_keeps_a_crack_closed_is_no_failure():
    """Next to nothing moves, so next to no energy is all there is; the load itself is the scale."""
    pressed = {"name": "c", "points": [[0, 3], [4, 3]], "start": "edge"}
    pressed["traction"] = {"law": "pressure", "value": -1e-3}
    model, state, scratch = build_deck(BLOCK, cracks=[pressed])
    books = Balance(state, read(BLOCK).solver)
    for _ in range(SETTLED + 10):
        advance(model, state, scratch, 1)
        row = books.row(model, state)
    moving = row["kinetic_energy"] + row["strain_energy"]
    assert books.largest == pytest.approx((4 * 1e-3) ** 2 / (2 * 3))
    assert moving < 0.01 * books.largest
    assert abs(books.error) < 0.01


@pytest.mark.parametrize(("step", "error", "fails"), [
    (1, -0.45, False), (1, 0.51, True), (10, 0.45, False), (10, -1e5, True), (25, 0.19, False),
    (25, 0.21, True), (50, 0.11, True), (1, np.nan, True),
])  # fmt: skip
def test_limits_hold_from_the_first_step(step, error, fails):
    """Wider at first: 10 % times 50 over the steps, but never more than half of the energy."""
    _, state, _ = build_deck(BLOCK)
    state.step = step
    books = Balance(state, read(BLOCK).solver)
    books.error = error
    if not fails:
        books.judge(state, Ears())
        return
    with pytest.raises(NumericalFailure, match="off by"):
        books.judge(state, Ears())


def test_a_glance_leaves_the_balance_as_it_was():
    model, state, _ = build_deck(BLOCK)
    books = Balance(state, read(BLOCK).solver)
    state.particles.velocity[:, 0] = 1.0  # from nowhere
    before = dict(vars(books))
    with pytest.raises(NumericalFailure, match="off by 100 %"):
        books.glance(model, state)
    assert vars(books) == before
