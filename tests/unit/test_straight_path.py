"""Whether K can tell the way of a running tip (Cotterell and Rice 1980)."""

from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cramp_cli.cracks.straight_path import stress_along, unstable_path, with_past

WIDTH = 0.1
PLACES = np.stack(np.meshgrid(np.arange(-9.5, 10), np.arange(-9.5, 10)), -1).reshape(-1, 2) * 0.05


def site(angle, T, across=0.0, shear=0.0):
    """Return the surroundings of a tip at the origin, in a field that is the same everywhere.

    angle: of the crack (rad); T, across, shear: stresses in the axes of the crack
    """
    c, s = np.cos(angle), np.sin(angle)
    turn = np.array([[c, -s], [s, c]])
    xx, xy, _, yy = (turn @ [[T, shear], [shear, across]] @ turn.T).ravel()
    stress = np.tile([xx, yy, 0.0, xy], (len(PLACES), 1))
    particles = SimpleNamespace(origin=PLACES @ turn.T, stress=stress)
    frame = SimpleNamespace(origin=(0.0, 0.0), before=(c, s), now=(c, s))
    return SimpleNamespace(cloud=SimpleNamespace(particles=particles), frame=frame)


@given(angle=st.floats(-3.0, 3.0), T=st.floats(-5.0, 5.0), across=st.floats(-5.0, 5.0))
def test_only_the_stress_along_the_crack_counts(angle, T, across):
    assert stress_along(site(angle, T, across, 0.3), WIDTH) == pytest.approx(T, abs=1e-12)


@pytest.mark.parametrize(("T", "told"), [(1.2, True), (1.0, False), (-9.0, False), (0.0, False)])
def test_the_way_is_unstable_where_a_turn_grows_within_a_cell(T, told):
    """K^2/8T^2 = h at T = 1.118."""
    row = {"K_I": 1.0, "K_II": 0.0}
    model = SimpleNamespace(lattice=SimpleNamespace(width=WIDTH))
    found = unstable_path(model, site(0.0, T), row)
    assert bool(found) == told
    if told:
        assert found == [
            "doubtful: the way is unstable, a turn grows by e within 0.87 cells (T = 1.2 Pa)"
        ]


def test_what_was_unstable_stays_doubtful():
    rows = [
        {"crack": "c", "tip": "end", "status": "ok"},
        {"crack": "c", "tip": "start", "status": "ok"},
    ]
    told = {"the way is unstable c end"}
    assert [row["status"] for row in with_past(rows, told)] == [
        "doubtful: the way was unstable",
        "ok",
    ]
