"""A crack loaded far beyond its toughness (docs/theory/growth.md, Overloads)."""

from contextlib import nullcontext

import pytest
from runs import run_deck
from support import build_deck

from cramp_cli.cracks.grow import grow
from cramp_cli.step import step

pytestmark = [pytest.mark.verification, pytest.mark.slow]

# J = 300 G_Ic at the onset; the plate, its loads and its crack are their own mirror images.
PLATE = """
cramp: 1
analysis: plane_strain
grid: {cell: 1 mm, margin: 12}
materials:
  m: {law: elastic, density: 2500 kg/m^3, E: 70 GPa, nu: 0.2, toughness: {K_Ic: 2 MPa*m^0.5}}
bodies:
- {name: plate, material: m, shape: {type: rectangle, lower: [0, -23 mm], upper: [70 mm, 23 mm]}}
- {name: top, material: m, shape: {type: rectangle, lower: [0, 23 mm], upper: [70 mm, 25 mm]}}
- {name: low, material: m, shape: {type: rectangle, lower: [0, -25 mm], upper: [70 mm, -23 mm]}}
cracks: [{name: c, points: [[0, 0], [15 mm, 0]], start: edge, end: tip}]
loads:
- type: force
  body: top
  where: {x: [-9, 9]}
  total: [0, 21 MN]
  in_time: {type: ramp, until: 1 us}
- type: force
  body: low
  where: {x: [-9, 9]}
  total: [0, -21 MN]
  in_time: {type: ramp, until: 1 us}
solver: {end_time: 30 us, update: fmpm(2)}
propagation: {criterion: max_hoop_stress}
fracture: {every: 0.5 us, methods: [domain]}
output: {every: 10 us, particles: false}
"""
CELL = 1e-3  # m


def test_a_symmetric_overload_is_doubtful_long_before_it_curls():
    """It curls by 21 cells, with the status ok. Measured: told at 6.5 us, seen at 17 us."""
    run = run_deck(PLATE)
    rows = run.tip("end")
    told = next(n for n, row in enumerate(rows) if "the way is unstable" in row["status"])
    curls = next(n for n, row in enumerate(rows) if abs(row["y"]) > 0.01 * CELL)
    assert told < curls - 10
    assert all("doubtful: the way" in row["status"] for row in rows[told:])
    assert any("is unstable: where it goes from here tells nothing" in w for w in run.warnings)
    assert max(abs(row["y"]) for row in rows[: told + 1]) < 1e-12 * CELL


def turns(begin, steps, turn):
    """Return how a turn, put into the heading at a step, goes on, over its first size."""
    model, state, scratch = build_deck(PLATE)
    for _ in range(begin):
        step(model, state, scratch, lambda title: nullcontext())
        grow(model, state, scratch)
    state.growth.heading[1] = 1.0, turn
    for _ in range(steps):
        step(model, state, scratch, lambda title: nullcontext())
        grow(model, state, scratch)
    return abs(state.growth.heading[1, 1]) / turn


def test_a_turn_fades_while_nothing_pulls_along_the_crack():
    """K^2/8T^2 is 1.7 cells and more: by 0.46 in every half cell. Measured: 0.02 after ten."""
    assert turns(80, 10, 1e-6) < 0.1


def test_a_turn_grows_while_the_crack_is_pulled_along():
    """K^2/8T^2 is 0.05 cells: by 3 in every half cell. Measured: see the page."""
    assert turns(166, 10, 1e-6) > 5.0
