"""Means of J and K over the time that a wave takes through the domain of a tip."""

from types import SimpleNamespace

import numpy as np
import pytest
from support import build_deck, locate

from cramp_cli.cracks import tip_mean
from cramp_cli.cracks.tip_mean import NAMES, TipMeans, crossing_time
from cramp_cli.cracks.tips import sample_tips

PLATE = """
cramp: 1
analysis: plane_strain
grid: {cell: 1}
materials: {soft: {law: elastic, density: 4, E: 3, nu: 0}}
bodies: [{name: plate, material: soft, shape: {type: rectangle, lower: [0, 0], upper: [30, 20]}}]
cracks: [{name: c, points: [[0, 10], [15, 10]], start: edge, end: tip}]
solver: {end_time: 100}
fracture: {means: true, methods: [domain]}
"""


@pytest.fixture(scope="module")
def plate():
    model, state, scratch = build_deck(PLATE)
    locate(model, state, scratch)
    return model, state, scratch


def test_the_time_is_that_of_a_wave_through_the_domain(plate):
    """Ten cells at sqrt(E/rho), as nu is zero."""
    model, *_ = plate
    assert crossing_time(model, model.blocks[0]) == pytest.approx(10.0 / np.sqrt(3.0 / 4.0))


def means_at(plate, values, monkeypatch, row_at=60.0):
    """Return the row with means of a tip whose J, K_I, K_II are `values` of the time."""
    model, state, scratch = plate
    means, now = TipMeans(model), SimpleNamespace(**vars(state))
    monkeypatch.setattr(tip_mean, "_measured", lambda model, state, *_: list(values(state.time)))
    calls = 0
    while now.time < row_at - 1e-9:
        before = len(means.samples.get("c end", []))
        means.after_step(model, now, scratch, row_at)
        calls += len(means.samples.get("c end", [])) > before
        now.step, now.time = now.step + 1, now.time + model.dt
    (row,) = sample_tips(model, state, scratch)
    row |= dict(zip(NAMES, values(now.time), strict=True))
    (found,) = means.of_rows(model, now, scratch, [row])
    return found, calls


def test_what_changes_evenly_has_its_mean_in_the_middle_of_the_time(plate, monkeypatch):
    found, calls = means_at(plate, lambda t: (3.0 * t, 2.0 - t, 1.0), monkeypatch)
    t = found["time_mean"]
    assert found["time"] == 0.0  # the row's own columns stand as they were
    assert t == pytest.approx(60.0 - 5.0 / np.sqrt(3.0 / 4.0), abs=0.6)
    got = [found[f"{name}_mean"] for name in NAMES]
    assert got == pytest.approx([3.0 * t, 2.0 - t, 1.0], rel=1e-12)
    assert 8 <= calls <= 24  # only while the mean is due


def test_a_wave_of_the_length_of_a_few_cells_is_nothing(plate, monkeypatch):
    """A period of a quarter of the time: a twentieth is left of it."""
    T = crossing_time(plate[0], plate[0].blocks[0])
    swing = lambda t: (5.0 + np.sin(8.0 * np.pi * t / T),) * 3  # noqa: E731 - a formula
    found, _ = means_at(plate, swing, monkeypatch)
    assert found["K_I_mean"] == pytest.approx(5.0, abs=0.08)


def test_no_number_leaves_no_mean(plate, monkeypatch):
    found, _ = means_at(plate, lambda t: (1.0, np.nan, 1.0), monkeypatch)
    assert np.isnan(found["K_I_mean"])
    assert found["J_mean"] == pytest.approx(1.0)
