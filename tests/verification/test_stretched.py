"""A bar of rubber is drawn to three times its length: cpdi holds, ugimp tears on the way."""

import numpy as np
import pytest
from scipy.optimize import brentq
from support import advance, build_deck

from cramp_cli.state.failure import NumericalFailure

pytestmark = pytest.mark.verification

E, NU, RHO = 1.0e6, 0.3, 1000.0  # Pa, 1, kg/m^3
G, LAME = E / (2.0 + 2.0 * NU), E * NU / ((1.0 + NU) * (1.0 - 2.0 * NU))
STRETCH = 3.0
BAR = """
cramp: 1
analysis: plane_stress
grid: {cell: 1 mm, lower: [-4 mm, -4 mm], upper: [70 mm, 8 mm]}
materials: {rubber: {law: neo_hookean, density: 1000, E: 1 MPa, nu: 0.3}}
bodies:
  - {name: bar, material: rubber, shape: {type: rectangle, lower: [0, 0], upper: [20 mm, 4 mm]}}
boundary: [{name: left, where: {x: 0}, fix: [x]}]
solver: {end_time: 30 ms, strain: usavg-, cfl: 0.2, damping: {particle: 400}}
"""


def bar_at(stretch):
    """Return nominal stress (Pa) and stretch across of a bar in uniaxial stress.

    tau = G (b - 1) + lambda/2 (J^2 - 1) 1 with J = stretch across^2 and no stress across.
    """

    def across_stress(q):
        return G * (q**2 - 1.0) + 0.5 * LAME * (stretch**2 * q**4 - 1.0)

    q = brentq(across_stress, 0.1, 1.0)
    return G * (stretch**2 - q**2) / stretch, q


def drawn(shape):
    """Return model, state and scratch of the bar under a dead load that rises and stays."""
    pull, _ = bar_at(STRETCH)
    load = {"type": "traction", "body": "bar", "where": {"x": "20 mm"}, "traction": [pull, 0.0]}
    load["in_time"] = {"type": "ramp", "until": "20 ms"}
    return build_deck(BAR, solver={"shape": shape}, loads=[load])


def test_domains_that_go_with_the_solid_hold_it_together():
    """Stretch along and across, and the place of every particle, within 1 percent of theory."""
    model, state, scratch = drawn("cpdi")
    advance(model, state, scratch, round(model.end_time / model.dt))
    p, (_, across) = state.particles, bar_at(STRETCH)
    assert p.F[:, 0] == pytest.approx(STRETCH, rel=0.01)
    assert p.F[:, 3] == pytest.approx(across, rel=0.01)
    assert p.position[:, 0] == pytest.approx(STRETCH * p.origin[:, 0], rel=0.01, abs=1e-5)
    assert not scratch.report[:, :, 3].any()  # no domain was shortened


def test_boxes_that_keep_their_size_tear_it():
    """The same bar with ugimp: particles are thrown out of the grid before twice the length."""
    model, state, scratch = drawn("ugimp")
    with pytest.raises(NumericalFailure, match="leaves the grid"):
        advance(model, state, scratch, round(model.end_time / model.dt))
    assert np.mean(state.particles.F[:, 0]) < 2.0
