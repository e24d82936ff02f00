"""A body under gravity falls exactly, with all updates and strain schemes."""

import numpy as np
import pytest
from support import advance, build_deck

pytestmark = pytest.mark.verification

STEPS = 629  # of NairnMPM's own free-fall test: a fall of 2.0027 mm
ACCELERATION = (1.5, -10.0)  # m/s^2
VELOCITY = (2.0, 3.0)  # m/s

STONE = """
cramp: 1
analysis: plane_strain
grid: {lower: [-40 mm, -40 mm], upper: [100 mm, 120 mm], cell: 10 mm}
materials:
  soft: {law: elastic, density: 1000 kg/m^3, E: 10 MPa, nu: 0.3}
bodies:
  - name: stone
    material: soft
    shape: {type: rectangle, lower: [0, 0], upper: [30 mm, 30 mm]}
    velocity: [2, 3]
cracks:
  - {name: slit, points: [[9 mm, 14 mm], [22 mm, 17 mm]]}
loads:
  - {type: gravity, acceleration: [1.5, -10]}
solver: {end_time: 1, dt: 31.818046 us}
"""


@pytest.mark.parametrize("update", ["flip", "pic", "fmpm(2)", "fmpm(5)", "xpic(2)", "xpic(5)"])
@pytest.mark.parametrize("strain", ["usf", "usl+", "usavg+"])
def test_fall_is_exact(update, strain):
    model, state, scratch = build_deck(STONE, solver={"update": update, "strain": strain})
    assert model.dt == pytest.approx(31.818046e-6, rel=1e-12)
    advance(model, state, scratch, STEPS)
    p, t = state.particles, STEPS * model.dt
    a, v = np.array(ACCELERATION), np.array(VELOCITY)
    fall = v * t + 0.5 * a * t**2
    assert p.velocity == pytest.approx(np.tile(v + a * t, (len(p.mass), 1)), rel=1e-12)
    assert p.position - p.origin == pytest.approx(np.tile(fall, (len(p.mass), 1)), rel=1e-11)
    assert np.abs(p.stress).max() < 1e-9 * 10e6  # E: nothing is strained


def test_gravity_follows_tables_along_both_axes():
    """Two loads of their own; the velocity is the sum of what the tables say at every step."""
    tables = {0: ([0, 5e-3, 10e-3], [0.0, 2.0, -1.0]), 1: ([0, 10e-3], [1.0, 0.0])}
    loads = [
        {
            "type": "gravity",
            "acceleration": [-4.0 if axis == 0 else 0, -10.0 if axis == 1 else 0],
            "in_time": {"type": "table", "time": times, "value": values},
        }
        for axis, (times, values) in tables.items()
    ]
    model, state, scratch = build_deck(STONE, loads=loads)
    advance(model, state, scratch, 400)
    times = model.dt * np.arange(400)
    size = {0: -4.0, 1: -10.0}
    for axis, (at, values) in tables.items():
        wanted = VELOCITY[axis] + size[axis] * np.interp(times, at, values).sum() * model.dt
        np.testing.assert_allclose(state.particles.velocity[:, axis], wanted, rtol=1e-12)


@pytest.mark.parametrize("shape", ["ugimp", "linear", "bspline2", "cpdi"])
@pytest.mark.parametrize("analysis", ["plane_strain", "axisymmetric"])
def test_half_a_stone_falls_along_its_plane_as_the_whole(analysis, shape):
    """Rows at a symmetry plane, or at the axis of rings, have the mass of the image too."""
    mirror = [{"where": {"x": 0.0}, "symmetry": True}] if analysis == "plane_strain" else []
    stone = {"shape": {"type": "rectangle", "lower": [0, 0], "upper": [0.03, 0.03]}}
    deck = {
        "analysis": analysis,
        "boundary": mirror,
        "bodies": [{"name": "stone", "material": "soft", **stone}],
        "cracks": [],
        "loads": [{"type": "gravity", "acceleration": [0.0, -10.0]}],
        "solver": {"shape": shape},
    }
    model, state, scratch = build_deck(STONE, **deck)
    advance(model, state, scratch, 50)
    fallen = np.array([0.0, -10.0]) * state.time
    np.testing.assert_allclose(state.particles.velocity - fallen, 0.0, atol=1e-10)
