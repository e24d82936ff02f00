"""An absorbing boundary: what comes back of a plane wave, and where its energy stands."""

import numpy as np
import pytest
from support import advance, build_deck, read

from cramp_cli.build import build
from cramp_cli.energy_balance import Balance
from cramp_cli.state.measures import sum_energies

pytestmark = pytest.mark.verification

LENGTH, CELL, E, NU, RHO = 0.5, 5e-3, 100.0e6, 0.3, 1000.0  # m, m, Pa, 1, kg/m^3
SHEAR = E / (2.0 * (1.0 + NU))
CONFINED = 2.0 * SHEAR * (1.0 - NU) / (1.0 - 2.0 * NU)
WAVES = {"P": (CONFINED, [1000.0, 0], "y"), "S": (SHEAR, [0, 1000.0], "x")}
PULSE = 36.0  # cells; of sin^2
MOST = [("ugimp", 0.01), ("linear", 0.025), ("bspline2", 0.025)]  # of the amplitude
TIMES = np.linspace(0.0, 1.0, 41)  # shares of the pulse


def duration(modulus):
    """Return how long the pulse takes to enter (s)."""
    return PULSE * CELL / float(np.sqrt(modulus / RHO))


def strip(wave, far, **more):
    """Return a deck: a pulse of traction at x = 0 of a strip that only moves as the wave wants."""
    modulus, traction, held = WAVES[wave]
    times, rise = TIMES * duration(modulus), (np.sin(np.pi * TIMES) ** 2).round(9)
    pulse = {"type": "table", "time": times.tolist(), "value": rise.tolist()}
    shape = {"type": "rectangle", "lower": [0, 0], "upper": [LENGTH, 4 * CELL]}
    sides = [{"where": {"y": y}, "fix": [held]} for y in (0, 4 * CELL)]
    return {
        "cramp": 1,
        "analysis": "plane_strain",
        "grid": {"cell": CELL},
        "materials": {"m": {"law": "elastic", "density": RHO, "E": E, "nu": NU}},
        "bodies": [{"name": "strip", "material": "m", "shape": shape}],
        "boundary": [*sides, {"name": "far", "where": {"x": LENGTH}} | far],
        "loads": [
            {"type": "traction", "body": "strip", "where": {"x": 0}, "traction": traction}
            | {"in_time": pulse}
        ],
        "solver": {"end_time": 1.0} | more,
    }


def left_over(wave, far, **more):
    """Return the amplitude that is left after the wave has met the far end: root of energies.

    Also energy (J) of the wave that came, the last row of the history, and the impulse of the far
    end (N s).
    """
    deck = strip(wave, far, **more)
    model, state, scratch = build_deck(deck)
    balance = Balance(state, read(deck).solver)
    transit = LENGTH / np.sqrt(WAVES[wave][0] / RHO)
    advance(model, state, scratch, round(0.9 * transit / model.dt))
    came = sum(sum_energies(state.particles))
    balance.row(model, state)
    impulse = np.zeros(2)
    for _ in range(round(0.9 * transit / model.dt)):
        advance(model, state, scratch, 1)
        impulse += model.dt * state.reactions[2]
    left = sum(sum_energies(state.particles))
    return (left / came) ** 0.5, came, balance.row(model, state), impulse


@pytest.mark.parametrize("wave", WAVES)
@pytest.mark.parametrize(("shape", "most"), MOST)
def test_a_plane_wave_leaves(wave, shape, most):
    """Measured: 0.5 % with ugimp, a fourth of that with twice the cells.

    Wanted: 1 to 2 %. Splines see a node beyond the face, and linear functions are pulled at the
    particle, a quarter of a cell within it: 2.2 %.
    """
    back, came, row, impulse = left_over(wave, {"absorbing": True}, shape=shape)
    print(f"{wave} {shape}: {back:.4f}, energy error {row['energy_error']:+.1e}")
    assert back < most
    assert row["absorbed_energy"] == pytest.approx(came, rel=1e-3)
    assert abs(row["energy_error"]) < 1e-3
    modulus, traction, _ = WAVES[wave]
    pushed = 0.5 * np.array(traction) * duration(modulus) * 4 * CELL  # sin^2: half the rectangle
    np.testing.assert_allclose(impulse, -pushed, atol=2.0 * most * pushed.max())


@pytest.mark.parametrize("wave", WAVES)
def test_without_it_all_comes_back(wave):
    back, _, row, _ = left_over(wave, {"fix": ["x" if wave == "P" else "y"]})
    assert back == pytest.approx(1.0, abs=0.01)
    assert row["absorbed_energy"] == 0.0


def test_half_a_strip_absorbs_like_the_whole_one():
    """A symmetry plane that meets the face: sums of dashpots are mirrored as masses are."""
    whole, half = (strip("P", {"absorbing": True}) for _ in range(2))
    half["bodies"][0]["shape"]["lower"] = [0, 2 * CELL]
    half["grid"] = {"cell": CELL, "lower": [-0.02, 0.0], "upper": [LENGTH + 0.02, 0.04]}
    half["boundary"][0] = {"where": {"y": 2 * CELL}, "symmetry": True}
    found = []
    for deck in (whole, half):
        model, state, scratch = build_deck(deck)
        advance(model, state, scratch, 236)  # the pulse is at the face
        p = state.particles
        upper = p.origin[:, 1] > 2 * CELL
        order = np.lexsort(p.origin[upper].T)
        found.append((p.velocity[upper][order], state.reactions[2, 0]))
    np.testing.assert_allclose(found[1][0], found[0][0], atol=1e-12 * np.abs(found[0][0]).max())
    assert found[1][1] == pytest.approx(0.5 * found[0][1], rel=1e-9)
    assert found[1][1] < 0.0


def test_thin_plates_and_bodies_of_revolution_have_their_own_speeds():
    """Plane stress: E/(1 - nu^2). A round bar with no lateral strain: that of the solid."""
    wanted = {"plane_stress": E / (1.0 - NU**2), "axisymmetric": CONFINED}
    for analysis, modulus in wanted.items():
        deck = strip("P", {"absorbing": True}) | {"analysis": analysis}
        deck["grid"] = {"cell": CELL, "lower": [-0.02, -0.02], "upper": [LENGTH + 0.02, 0.04]}
        model, _ = build(read(deck))
        (absorber,) = model.conditions.absorbers
        area = {"plane_stress": 4 * CELL, "axisymmetric": 2.0 * np.pi * LENGTH * 4 * CELL}
        total = absorber.faces.force[:, 0].sum()
        assert total == pytest.approx(np.sqrt(RHO * modulus) * area[analysis], rel=1e-12)
