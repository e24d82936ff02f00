"""The circle that a crack follows near its tip."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cramp_cli.cracks.tip_curve import curve_at

CELL, REACH = 1e-3, 5e-3
SIZES = st.floats(0.05, 0.6), st.floats(-np.pi, np.pi), st.floats(0.0, 1.0)


def arc(radius, step, heading=0.0, left=True, count=60):
    """Return points of an arc from its tip backwards; heading: direction out of the crack."""
    back = np.arange(count) * step / radius
    x, y = -radius * np.sin(back), radius * (1.0 - np.cos(back)) * (1.0 if left else -1.0)
    c, s = np.cos(heading), np.sin(heading)
    return np.stack([c * x - s * y, s * x + c * y], axis=1)


@given(st.floats(10.5, 500.0), *SIZES, st.booleans())
def test_an_arc_has_its_tangent_and_its_curvature(cells, step, heading, shift, left):
    """Segments are chords: a length s lies s^2/8R inside, which costs s^2/R as an angle at most."""
    line = arc(cells * CELL, step * CELL, heading, left) + shift * CELL
    curve = curve_at(line, CELL, REACH)
    assert curve.length >= REACH
    got = np.arctan2(*curve.direction[::-1])
    assert abs(np.angle(np.exp(1j * (got - heading)))) < step**2 / cells / 8.0 + 1e-7
    sign = 1.0 if left else -1.0
    assert curve.bend * cells * CELL * sign == pytest.approx(1.0, abs=0.03)


@given(*SIZES)
def test_a_straight_line_keeps_its_last_segment_to_the_bit(step, heading, shift):
    way = -np.arange(20)[:, None] * step * CELL
    line = shift * CELL + way * [np.cos(heading), np.sin(heading)]
    behind = line[0] - line[1]
    curve = curve_at(line, CELL, REACH)
    assert curve.direction == tuple((behind / np.hypot(*behind)).tolist())
    assert (curve.bend, curve.length) == (0.0, np.inf)


@given(st.lists(st.floats(-0.05, 0.05), min_size=40, max_size=40))
def test_noise_of_a_twentieth_of_a_cell_is_neither_a_bend_nor_a_turn(noise):
    """The last segment of half a cell would be turned by up to 0.2 rad."""
    line = np.stack([-0.5 * np.arange(40), noise], axis=1) * CELL
    curve = curve_at(line, CELL, REACH)
    assert curve.length >= REACH
    assert abs(np.arctan2(*curve.direction[::-1])) < 0.1  # of a tip that is itself off by 0.1
    assert abs(curve.bend) * CELL < 0.04


@pytest.mark.parametrize("kink", [1.4, 2.5, 4.24])
def test_a_kink_ends_it(kink):
    """By 45 degrees: the crack is straight up to there, within half a cell; 2.5 are the least."""
    line = np.array([[kink * 0.5**0.5, kink * 0.5**0.5], [0.0, 0.0], [-12.0, 0.0]]) * CELL
    curve = curve_at(line, CELL, REACH)
    assert curve.length / CELL <= kink + 0.25
    if kink >= 2.5:
        assert curve.length / CELL >= kink - 0.5
        np.testing.assert_allclose(curve.direction, [0.5**0.5, 0.5**0.5], atol=1e-9)


def test_a_circle_tighter_than_twice_the_way_is_no_domain():
    """The metric of the coordinates along it would vanish within the domain."""
    assert curve_at(arc(6.0 * CELL, 0.25 * CELL), CELL, REACH).length < 3.2 * CELL
