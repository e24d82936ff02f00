"""K from J and the opening of a crack (docs/theory/fracture.md)."""

import numpy as np
import pytest

from cramp_cli.cracks.domain_integral import TipFrame
from cramp_cli.cracks.intensity import (
    K_from_J,
    open_and_slide,
    opening_behind,
    opening_near_tip,
)
from cramp_cli.cracks.tips import Tip
from cramp_cli.state.paths import PLAIN, make_paths

SHEAR, NU = 27e9, 0.3
KAPPAS = pytest.mark.parametrize("kappa", [3 - 4 * NU, (3 - NU) / (1 + NU)])
END, START = 1, 0


@KAPPAS
@pytest.mark.parametrize(("K_I", "K_II"), [(2e6, 0.0), (1e6, 0.7e6), (1e6, -3e6), (-1e6, 0.5e6)])
def test_round_trip(kappa, K_I, K_II):
    """E' = 8G/(kappa + 1), J = (K_I^2 + K_II^2)/E'; faces r behind the tip open by
    (kappa + 1)/G sqrt(r/2 pi) K in each mode (Williams 1957).
    """
    J = (K_I**2 + K_II**2) * (kappa + 1.0) / (8.0 * SHEAR)
    per_K = (kappa + 1.0) / SHEAR * np.sqrt(1e-3 / (2.0 * np.pi))
    got = K_from_J(J, per_K * K_I, per_K * K_II, SHEAR, kappa)
    assert got == pytest.approx((K_I, K_II), rel=1e-14)


@pytest.mark.parametrize(
    ("J", "normal", "slide"), [(-1.0, 1e-6, 0.0), (0.0, 1e-6, 0.0), (1.0, 0.0, 0.0)]
)
def test_nothing_is_known_without_release_or_opening(J, normal, slide):
    """K = 0 where J <= 0 or the crack is closed."""
    assert K_from_J(J, normal, slide, SHEAR, 2.0) == (0.0, 0.0)


@pytest.mark.parametrize("angle", [0.0, 0.7, 2.0, -2.5])
def test_opening_in_the_axes_of_the_tip(angle):
    """Growth along (cos, sin): normal to its left, slide along it."""
    e = np.array([np.cos(angle), np.sin(angle)])
    n = np.array([-e[1], e[0]])
    assert open_and_slide(3.0 * n - 2.0 * e, e) == pytest.approx((3.0, -2.0), abs=1e-15)


def opened(points, gaps):
    """Return a crack along x with the given gaps, half of each side."""
    line = np.stack([np.arange(points, dtype=float), np.zeros(points)], axis=1)
    paths = make_paths([line], [(PLAIN, PLAIN)], [0], [(-1, 0)], 2)
    paths.above[:] += 0.5 * np.asarray(gaps)
    paths.below[:] -= 0.5 * np.asarray(gaps)
    return paths


def test_a_gap_in_proportion_to_the_distance_is_that_of_the_second_particle():
    """The spline (1, 4, 1)/6 reproduces straight lines."""
    away = np.arange(7.0)[:, None] * [0.01, 0.2]
    np.testing.assert_allclose(
        opening_near_tip(opened(7, away), 0, START), -2.0 * away[1], rtol=1e-13
    )
    np.testing.assert_allclose(
        opening_near_tip(opened(7, away[::-1]), 0, END), 2.0 * away[1], rtol=1e-13
    )


def test_weights_of_the_spline():
    gaps = np.zeros((6, 2))
    gaps[:, 1] = (9.0, 6.0, 12.0, 18.0, 7.0, 9.0)
    assert opening_near_tip(opened(6, gaps), 0, START)[1] == -(6.0 + 48.0 + 18.0) / 6.0
    assert opening_near_tip(opened(6, gaps), 0, END)[1] == (7.0 + 72.0 + 12.0) / 6.0


@pytest.mark.parametrize("end", [START, END])
def test_both_ends_of_an_opening_crack_are_opened(end):
    """Growth at the start points back, where above and below change places: mode I is positive."""
    gaps = np.array([0.0, 1.0, 1.5, 1.5, 1.0, 0.0])[:, None] * [0.0, 1.0]
    growth = (1.0, 0.0) if end == END else (-1.0, 0.0)
    normal, slide = open_and_slide(opening_near_tip(opened(6, gaps), 0, end), growth)
    assert normal == pytest.approx((1.0 + 6.0 + 1.5) / 6.0)
    assert slide == pytest.approx(0.0)


@pytest.mark.parametrize("end", [START, END])
def test_a_short_crack_has_its_first_gap_only(end):
    gaps = np.array([0.0, 1.0, 0.0])[:, None] * [0.0, 1.0]
    assert abs(opening_near_tip(opened(3, gaps), 0, end)[1]) == 1.0


def behind(bend, line, end, K=(0.6, 0.8)):
    """Return the mean opening and sliding behind a tip whose faces part by K sqrt(r), as seen.

    bend: of the crack (1/m), an arc; line: height of its line over the middle between the particles
    """
    r = 0.5 * np.arange(40)
    turn = bend * r
    x, y = (-r, 0.0 * r) if not bend else (-np.sin(turn) / bend, (1.0 - np.cos(turn)) / bend)
    ahead = np.stack([np.cos(turn), -np.sin(turn)], axis=1)
    normal = np.stack([np.sin(turn), np.cos(turn)], axis=1)
    opened = K[0] * np.sqrt(r)
    with np.errstate(invalid="ignore", divide="ignore"):
        slid = K[1] * np.sqrt(r) + np.nan_to_num(0.5 * line * opened / (2.0 * r))
    gap = opened[:, None] * normal + slid[:, None] * ahead
    points = np.stack([x, y], axis=1)
    if end == END:
        points, gap = points[::-1], gap[::-1]
    paths = make_paths([points.copy()], [(PLAIN, PLAIN)], [0], [(-1, 0)], 2)
    side = 1.0 if end == END else -1.0
    paths.above[:] = points + side * 0.5 * gap
    paths.below[:] = points - side * 0.5 * gap
    tip = Tip(0, end, np.arange(40)[::-1] if end == END else np.arange(40))
    frame = TipFrame((0.0, 0.0), (1.0, 0.0), (1.0, 0.0), line, bend)
    return np.array(opening_behind(paths, tip, frame, 1.0))


@pytest.mark.parametrize("end", [START, END])
@pytest.mark.parametrize("line", [0.0, 0.25, -0.25])
@pytest.mark.parametrize("bend", [0.0, 0.05, -0.05])
def test_the_mode_is_that_of_the_faces_of_the_solid(bend, line, end):
    """For faces that part like those of a tip, on an arc as well; chords are shorter by 1e-5."""
    assert behind(bend, line, end) == pytest.approx((0.6, 0.8), rel=5e-5)


def test_a_short_crack_has_the_mode_of_its_opening_near_the_tip():
    """Two segments: half of it holds no point beyond the first cell."""
    paths = opened(3, [[0.0, 0.0], [0.1, 0.2], [0.0, 0.0]])
    tip = Tip(0, END, np.arange(3)[::-1])
    frame = TipFrame((2.0, 0.0), (1.0, 0.0), (1.0, 0.0))
    near = open_and_slide(opening_near_tip(paths, 0, END), (1.0, 0.0))
    assert opening_behind(paths, tip, frame, 2.0) == near
