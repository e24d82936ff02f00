"""The curves and numbers that `cramp verify` compares with are those of their formulas."""

from math import hypot

import numpy as np
import pytest
from verification.solutions import EDGE_CRACK, center_crack, step_load, step_shear

from cramp_cli.study.results import read_table
from cramp_cli.study.templates import template_folder
from cramp_cli.study.verify import chosen

pytestmark = pytest.mark.verification

STEEL = {"E": 210e9, "nu": 0.3, "rho": 8000.0}
C_D = np.sqrt(210e9 * 0.7 / (8000.0 * 1.3 * 0.4))  # m/s
C_S = np.sqrt(210e9 / (8000.0 * 2.6))
HALF_HEIGHT, STRESS = 2.0, 5e6


def curve(name):
    return read_table(template_folder() / "verification" / "reference" / f"{name}.csv")


def reference(case, column="K_I"):
    return next(e.reference for e in chosen([case])[0].numbers if e.column == column)


@pytest.mark.parametrize(
    ("name", "column", "formula", "speed"),
    [("step_load", "K_I", step_load, C_D), ("step_shear", "K_II", step_shear, C_S)],
)
def test_curves_of_step_waves(name, column, formula, speed):
    table = curve(name)
    expected = formula(STRESS, table["time"] - HALF_HEIGHT / speed, **STEEL)
    assert table[column] == pytest.approx(expected, rel=1e-4, abs=1e-4 * expected.max())


@pytest.mark.parametrize(("case", "a"), [("center_crack_20", 0.04), ("center_crack_wide", 0.05)])
def test_centre_cracks(case, a):
    """Tada's formula is for a strip without end: 0.1 % below the collocation for H = 2W."""
    assert reference(case) == pytest.approx(center_crack(1e6, a, 0.1), rel=2e-3)


def test_edge_crack():
    expected = EDGE_CRACK[0.5] * 1e6 * np.sqrt(np.pi * 0.05)
    assert reference("edge_crack_20") == pytest.approx(expected, rel=1e-6)


def errors(case):
    """Return the frozen errors of K over their references, or over the peak of their curve."""
    bounded = (e for e in chosen([case])[0].numbers if e.curve or (e.reference and e.tip))
    return [e.value if e.curve else abs(e.value / e.reference - 1.0) for e in bounded]


@pytest.mark.parametrize(
    ("coarse", "fine"),
    [
        ("step_load_50", "step_load"),
        ("denp", "denp_100"),
    ],
)
def test_errors_fall_with_half_the_cell(coarse, fine):
    """Waves with a front: the error of both K together falls as h^0.7 at least.

    In statics the error at one place of the tip in its cell may be small by chance; the largest
    over several places is asked in test_center_crack.py.
    """
    assert hypot(*errors(fine)) <= hypot(*errors(coarse)) * 0.5**0.7
