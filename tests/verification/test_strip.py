"""A crack runs through a clamped strip: the energy that flows into it is known at any speed.

Both edges of a strip |y| < h are moved apart by u0 and held. Far ahead of the tip the strip stores
(lambda + 2 mu) u0^2/h per length, far behind it nothing (Rice 1967).
"""

import numpy as np
import pytest
import yaml
from support import advance_growing, build_deck

from cramp_cli.cracks.rayleigh import release_factors, wave_speeds
from cramp_cli.state.measures import sum_energies

pytestmark = [pytest.mark.verification, pytest.mark.slow]
HALF, U0, LOADED = 0.02, 20e-6, 300e-6  # m, m, s
E, NU = 3.2e9, 0.35
RELEASE = E * (1 - NU) / ((1 + NU) * (1 - 2 * NU)) * U0**2 / HALF  # J/m^2
STRIP = f"""
cramp: 1
analysis: plane_strain
grid: {{cell: 2 mm, lower: [-8 mm, -28 mm], upper: [248 mm, 28 mm]}}
materials: {{m: {{law: elastic, density: 1190, E: {E}, nu: {NU}, toughness: {{G_Ic: {RELEASE}}}}}}}
bodies:
  - name: b
    material: m
    shape: {{type: rectangle, lower: [0, -0.02], upper: [0.24, 0.02]}}
cracks: [{{name: c, points: [[0, 0], [80.5 mm, 0]], start: edge}}]
boundary:
  - {{where: {{y: 0.02}}, velocity: {{x: 0, y: {2 * U0 / LOADED}}}, in_time: PULSE}}
  - {{where: {{y: -0.02}}, velocity: {{x: 0, y: {-2 * U0 / LOADED}}}, in_time: PULSE}}
solver: {{end_time: 2 ms, update: fmpm(2)}}
fracture: {{methods: [domain]}}
""".replace("PULSE", f"{{type: table, time: [0, {LOADED / 2}, {LOADED}], value: [0, 1, 0]}}")


def run(propagation, until, toughness=1.0, update="fmpm(2)"):
    """Run until the tip is at `until` (m) or for 1.5 ms.

    returns: rows of time, place, speed, J, K_I, K_II, energy of the solid less work, energy booked
    for fracture and damping; the Rayleigh speed
    """
    data = yaml.safe_load(STRIP) | {"propagation": propagation}
    data["materials"]["m"]["toughness"]["G_Ic"] *= toughness
    data["solver"]["update"] = update
    model, state, scratch = build_deck(data)
    rows = []
    while state.time < 1.5e-3 and state.paths.origin[-1, 0] < until:
        advance_growing(model, state, scratch, 1)
        tip, growth, books = state.paths.origin[-1, 0], state.growth, state.books
        energy = sum(sum_energies(state.particles)) - books.external[0]
        booked = books.fracture[0] + books.damping[0]
        rows.append((state.time, tip, growth.speed[1], *growth.load[1], energy, booked))
    return np.array(rows), model.propagation.resistance["m"].rayleigh


def steady(share):
    rayleigh = 933.0
    speed = {"law": "prescribed", "value": share * rayleigh}
    return {"criterion": "steady_state", "begin": 1.2 * LOADED, "speed": speed}


@pytest.mark.parametrize("share", [0.2, 0.5])
def test_a_prescribed_speed(share):
    """C4: J within 5 %, aim 3 %, and K_I with it (Freund 1990, eq. 5.3.10).

    Reached: J too low by 2.1 % at 0.2 c_R and by 3.1 % at 0.5 c_R, of which the solid keeps 2.4 and
    2.2 %.
    """
    rows, rayleigh = run(steady(share), 0.17)
    speeds = wave_speeds(0.5 * E / (1 + NU), 3 - 4 * NU, 1190.0)
    speed = share * 933.0
    factor = release_factors(speed, *speeds)[0] / release_factors(0.0, *speeds)[0]
    expected = np.sqrt(RELEASE * E / (1 - NU**2) / factor)
    running = rows[rows[:, 1] > 0.12]
    assert speed == pytest.approx(share * rayleigh, rel=1e-3)
    assert running[:, 3].mean() == pytest.approx(RELEASE, rel=0.035)
    assert running[:, 4].mean() == pytest.approx(expected, rel=0.03)
    assert running[:, 4].std() < 0.03 * expected
    at_rest = rows[(rows[:, 0] > 1.13 * LOADED) & (rows[:, 2] == 0.0)]
    assert at_rest[:, 3].mean() == pytest.approx(RELEASE, rel=0.02)


@pytest.mark.parametrize(
    ("share", "update"), [(0.2, "flip"), (0.5, "flip"), (0.5, "fmpm(2)"), (0.2, "fmpm(2)")]
)
def test_what_is_booked_has_left_the_solid(share, update):
    """J da against the energy that the run has really lost, over 50 mm of growth.

    Within 0.5 %; 2 to 5 % before J counted what the filters take.
    """
    rows, _ = run(steady(share), 0.17, update=update)
    running = rows[rows[:, 1] > 0.12]
    lost, booked = running[0, 6] - running[-1, 6], running[-1, 7] - running[0, 7]
    assert booked == pytest.approx(lost, rel=0.015)


def coarse(update, bottom):
    """Return J (J/m^2) in every step of a strip with cells of 4 mm, or of its upper half."""
    data = yaml.safe_load(STRIP) | {"propagation": steady(0.5)}
    data["grid"]["cell"], data["solver"]["update"] = "4 mm", update
    data["bodies"][0]["shape"]["lower"][1] = bottom
    data["cracks"][0]["contact"] = {"law": "ignore"}
    if bottom == 0.0:
        data["boundary"][1] = {"where": {"y": 0}, "symmetry": True}
    model, state, scratch = build_deck(data)
    J = []
    while state.paths.origin[-1, 0] < 0.125:
        advance_growing(model, state, scratch, 1)
        J.append(state.growth.load[1, 0])
    return np.array(J)


@pytest.mark.parametrize("update", ["flip", "fmpm(2)"])
def test_a_crack_on_a_symmetry_plane_runs_like_that_of_the_whole_strip(update):
    """Closing tractions and the filter around the tip know the image: a patch test of growth."""
    whole, half = coarse(update, -HALF), coarse(update, 0.0)
    assert len(whole) == len(half)
    assert half == pytest.approx(whole, abs=1e-9 * RELEASE)


def test_a_strip_that_stores_less_than_the_toughness_keeps_its_crack():
    data = {"criterion": "critical_J", "speed": {"law": "toughness"}}
    rows, _ = run(data, 0.17, toughness=2.0)
    assert rows[:, 2].max() == 0.0
