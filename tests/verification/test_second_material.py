"""K beside a stiff or soft inclusion does not depend on how much of it the domain holds."""

import numpy as np
import pytest
from support import advance, build_deck

from cramp_cli.cracks.domain import domain_values
from cramp_cli.cracks.site import site_of
from cramp_cli.cracks.tips import tips_of
from cramp_cli.cracks.williams import unit_stress, unit_stress_slope

pytestmark = pytest.mark.verification
CELL = 1.25e-4  # m
PULSE = "{type: table, time: [0, 6 us, 12 us], value: [0, 1, 0]}"
DECK = f"""
cramp: 1
analysis: plane_strain
grid: {{cell: {CELL}, lower: [-4.5 mm, -4.5 mm], upper: [4.5 mm, 4.5 mm]}}
materials:
  matrix: {{law: elastic, density: 1200, E: 2.5 GPa, nu: 0.35}}
  other: {{law: elastic, density: 1200, E: STIFF, nu: 0.22}}
bodies:
  - name: plate
    material: matrix
    shape: {{type: rectangle, lower: [-4 mm, -4 mm], upper: [4 mm, 4 mm]}}
  - name: ball
    material: other
    shape: {{type: disk, center: [1.4 mm, 0.8 mm], radius: 1.4 mm}}
cracks: [{{name: c, points: [[-4 mm, 0.1875 mm], [-0.3 mm, 0.1875 mm]], start: edge}}]
boundary:
  - {{where: {{y: 4 mm}}, velocity: {{x: 0, y: 1 m/s}}, in_time: {PULSE}}}
  - {{where: {{y: -4 mm}}, velocity: {{x: 0, y: -1 m/s}}, in_time: {PULSE}}}
solver: {{end_time: 60 us, damping: {{grid: 3.0e5 1/s}}}}
"""


@pytest.mark.slow
@pytest.mark.parametrize("stiff", ["25 GPa", "0.25 GPa"])
def test_radius(stiff):
    """Ten times stiffer and softer: of 2.5 cells without it, of 5 and 6 with a part of it.

    Reached on 2026-11-22: 0.1 % between 5 and 6 cells, 6 % from the smallest domain there is.
    Without the term it is 5 to 8 % between 5 and 6 cells, and up to 20 % from the smallest.
    """
    model, state, scratch = build_deck(DECK.replace("STIFF", stiff))
    advance(model, state, scratch, int(40e-6 / model.dt))
    site = site_of(model, state, scratch, tips_of(state.paths)[0])
    small, *others = (domain_values(model, site, cells * CELL) for cells in (2.5, 5.0, 6.0))
    assert [small.mixed, *(other.mixed for other in others)] == [False, True, True]
    five, six = others
    assert abs(six.K_I / five.K_I - 1.0) < 0.01
    assert abs(six.K_II - five.K_II) < 0.01 * five.K_I
    assert abs(five.K_I / small.K_I - 1.0) < 0.08
    assert abs(five.K_II - small.K_II) < 0.02 * small.K_I


@pytest.mark.parametrize("mode", [1, 2])
def test_slope_of_the_auxiliary_stress(mode):
    """Beside central differences (truncation below 1e-8 here)."""
    step = 1e-5
    for angle in np.linspace(-3.0, 3.0, 13):
        places = (np.exp(1j * angle) + s for s in (step, -step))
        ahead, behind = (np.array(unit_stress(mode, abs(z), np.angle(z))) for z in places)
        found = unit_stress_slope(mode, 1.0, angle)
        assert found == pytest.approx((ahead - behind) / (2.0 * step), abs=1e-8)
