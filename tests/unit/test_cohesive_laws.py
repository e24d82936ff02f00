"""Every traction law: area, damage, energy, symmetry, and what lies between the modes."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.polynomial.legendre import leggauss

from cramp_cli.cohesive.cubic import Cubic
from cramp_cli.cohesive.elastic import Elastic
from cramp_cli.cohesive.exponential import Exponential
from cramp_cli.cohesive.law import respond, stored, strength, work
from cramp_cli.cohesive.modes import Modes, way_stiffness, way_toughness
from cramp_cli.cohesive.pressure import Pressure
from cramp_cli.cohesive.triangular import Triangular
from cramp_cli.cohesive.trilinear import Trilinear, corners

K_N, K_T = 3e10, 2e10  # Pa/m
MODES = Modes((K_N, K_T), (2e6, 3e6), (300.0, 900.0), 1.5)
CUBIC = Modes((K_N, K_T), (0.0, 0.0), (300.0, 900.0), 1.5)  # its peak follows from the others
LAWS = {
    "triangular": Triangular(MODES),
    "exponential": Exponential(MODES, 4.0),
    "cubic": Cubic(CUBIC),
    "trilinear": Trilinear(MODES, (0.3, 0.2), (0.1, 0.2)),
}
EVERY_LAW = pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
SHARES = pytest.mark.parametrize("share", [0.0, 0.3, 0.5, 0.9, 1.0])
FAR = 2e-3  # m: all laws have parted


def way(law, share, opening):
    """Return opening and sliding (m) at a distance on the straight way of a share."""
    k_n, k_t = law.modes.stiffness
    k = way_stiffness(law.modes, share)
    return opening * np.sqrt((1.0 - share) * k / k_n), opening * np.sqrt(share * k / k_t)


def follow(law, places):
    """Return answers of a law along openings and slidings, one after the other."""
    answers, damage = [], 0.0
    for normal, sliding in places:
        answers.append(respond(law, normal, sliding, damage))
        damage = answers[-1][2]
    return np.array(answers)


def breaks(law, share):
    """Return openings between which the strength is smooth (m)."""
    k, G = way_stiffness(law.modes, share), way_toughness(law.modes, share)
    if isinstance(law, Cubic):
        return [0.0, np.sqrt(12.0 * G / k)]
    if isinstance(law, Trilinear):
        first, _, second, _, end = corners(law, share)
        return [0.0, first, second, end]
    first = _last(lambda d: strength(law, share, d) > k * d * (1.0 - 1e-13), 1e-7)
    return [0.0, first, _last(lambda d: strength(law, share, d) > 0.0, first)]


def _last(holds, low):
    """Return the largest opening up to FAR for which something holds, by bisection."""
    high = FAR
    for _ in range(100):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if holds(middle) else (low, middle)
    return low


@EVERY_LAW
@SHARES
def test_area_under_the_strength_is_the_toughness(law, share):
    """Gauss's rule on every smooth piece."""
    x, w = leggauss(24)
    area, ends = 0.0, breaks(law, share)
    for a, b in zip(ends, ends[1:], strict=False):
        places = 0.5 * (a + b) + 0.5 * (b - a) * x
        area += (
            0.5 * (b - a) * sum(u * strength(law, share, d) for u, d in zip(w, places, strict=True))
        )
    wanted = way_toughness(law.modes, share)
    assert area == pytest.approx(wanted, rel=1e-10)
    assert work(law, share, FAR) == pytest.approx(wanted, rel=1e-14)


@EVERY_LAW
@SHARES
def test_work_is_the_area_up_to_every_opening(law, share):
    ends = np.array(breaks(law, share))
    x, w = leggauss(24)
    for part in (0.3, 0.7):
        area = 0.0
        for a, b in zip(ends, ends[1:], strict=False):
            stop = a + part * (b - a)
            places = 0.5 * (a + stop) + 0.5 * (stop - a) * x
            mean = sum(u * strength(law, share, d) for u, d in zip(w, places, strict=True))
            assert area + 0.5 * (stop - a) * mean == pytest.approx(work(law, share, stop), rel=1e-9)
            area = work(law, share, b)


@EVERY_LAW
@SHARES
def test_first_opening_follows_the_strength(law, share):
    for d in np.linspace(1e-6, 1e-3, 37):
        normal, sliding = way(law, share, d)
        t_n, t_t, _, _, _ = respond(law, normal, sliding, 0.0)
        along = (t_n * normal + t_t * sliding) / d
        assert along == pytest.approx(strength(law, share, d), rel=1e-12, abs=1e-6)


@EVERY_LAW
@pytest.mark.parametrize("mode", [0, 1])
def test_one_mode_alone_is_that_mode(law, mode):
    """Mixed mode at ratio 0 and 1: toughness, peak and stiffness are those of the pure mode."""
    d = np.linspace(1e-7, FAR, 4001)
    stress = np.array([strength(law, float(mode), x) for x in d])
    assert work(law, float(mode), FAR) == pytest.approx(law.modes.toughness[mode], rel=1e-14)
    assert stress[0] / d[0] == pytest.approx(law.modes.stiffness[mode], rel=2e-3)
    k, G = law.modes.stiffness[mode], law.modes.toughness[mode]
    peak = 4.0 / 27.0 * np.sqrt(12.0 * G * k) if isinstance(law, Cubic) else law.modes.peak[mode]
    assert stress.max() == pytest.approx(peak, rel=2e-3)
    assert stress.max() <= peak * (1.0 + 1e-12)


@EVERY_LAW
@pytest.mark.parametrize("share", [0.2, 0.5, 0.8])
def test_mixed_mode_parts_by_the_power_law(law, share):
    """(G_I/G_Ic)^p + (G_II/G_IIc)^p = 1 with the energies that were dissipated."""
    answers = follow(law, [way(law, share, d) for d in np.linspace(0.0, FAR, 150)])
    G_I, G_II = answers[:, 3:].sum(axis=0)
    assert answers[-1, 2] == 1.0
    assert pytest.approx(1.0, rel=1e-9) == (G_I / 300.0) ** 1.5 + (G_II / 900.0) ** 1.5


@pytest.mark.parametrize("name", ["triangular", "exponential", "trilinear"])
@pytest.mark.parametrize("share", [0.2, 0.5, 0.8])
def test_damage_begins_by_the_quadratic_criterion(name, share):
    """(T_n/s_n)^2 + (T_t/s_t)^2 = 1 where the strength leaves the straight line."""
    law = LAWS[name]
    limit = breaks(law, share)[1]
    t_n, t_t, damage, _, _ = respond(law, *way(law, share, limit * (1.0 - 1e-9)), 0.0)
    assert damage == 0.0
    assert (t_n / 2e6) ** 2 + (t_t / 3e6) ** 2 == pytest.approx(1.0, rel=1e-8)


places = st.lists(
    st.tuples(st.floats(-2e-4, 6e-4), st.floats(-8e-4, 8e-4)), min_size=1, max_size=30
)


@EVERY_LAW
@given(places=places)
@settings(max_examples=60, deadline=None)
def test_nothing_heals_and_no_energy_comes_back(law, places):
    """On any way: damage and dissipation never fall, and what has parted carries nothing."""
    answers = follow(law, places)
    damage, spent = answers[:, 2], answers[:, 3:]
    assert np.all(np.diff(damage, prepend=0.0) >= 0.0)
    assert damage.max() <= 1.0
    assert np.all(spent >= 0.0)
    assert np.all(answers[damage == 1.0, :2] == 0.0)


@EVERY_LAW
@given(places=places)
@settings(max_examples=40, deadline=None)
def test_energy_is_work(law, places):
    """Work of the stresses on a fine way through all places = stored + dissipated."""
    corners = np.array([(0.0, 0.0), *places])
    fine = np.concatenate(
        [a + np.linspace(0, 1, 200)[:, None] * (b - a) for a, b in zip(corners, corners[1:])]  # noqa: B905
    )
    answers = follow(law, fine)
    stress, step = answers[:, :2], np.diff(fine, axis=0)
    done = float(np.sum(0.5 * (stress[1:] + stress[:-1]) * step))
    held = stored(law, *fine[-1], answers[-1, 2])
    assert done == pytest.approx(held + answers[:, 3:].sum(), abs=0.02 * 900.0)


@EVERY_LAW
@given(normal=st.floats(-1e-4, 6e-4), sliding=st.floats(0.0, 8e-4), damage=st.floats(0.0, 1.0))
@settings(max_examples=60, deadline=None)
def test_sliding_to_either_side_is_the_same(law, normal, sliding, damage):
    one, other = respond(law, normal, sliding, damage), respond(law, normal, -sliding, damage)
    assert one == (other[0], -other[1], *other[2:])


@EVERY_LAW
@SHARES
def test_stress_is_continuous(law, share):
    """Half the step of opening halves the largest change of the stress."""
    coarse, fine = (
        np.abs(np.diff([strength(law, share, d) for d in np.linspace(0.0, FAR, count)])).max()
        for count in (10_001, 20_001)
    )
    assert fine == pytest.approx(0.5 * coarse, rel=0.02)


@EVERY_LAW
def test_unloading_goes_to_the_origin(law):
    _, _, damage, _, _ = respond(law, 1.2e-4, 0.9e-4, 0.0)
    for part in (0.75, 0.5, 0.25):
        t_n, t_t, again, opened, slid = respond(law, part * 1.2e-4, part * 0.9e-4, damage)
        assert (again, opened, slid) == (damage, 0.0, 0.0)
        assert t_n == pytest.approx((1.0 - damage) * K_N * part * 1.2e-4, rel=1e-14)
        assert t_t == pytest.approx((1.0 - damage) * K_T * part * 0.9e-4, rel=1e-14)


@EVERY_LAW
def test_closed_faces_are_left_to_contact(law):
    """No normal stress on overlapping faces, and the shear of sliding alone."""
    t_n, t_t, damage, opened, _ = respond(law, -1e-4, 2e-4, 0.0)
    assert (t_n, opened) == (0.0, 0.0)
    assert (t_t, damage) == respond(law, 0.0, 2e-4, 0.0)[1:3]


def test_elastic_faces_never_fail():
    law = Elastic(Modes((2e9, 1e9), (np.inf, np.inf), (np.inf, np.inf), 1.0))
    assert respond(law, 3.0, -4.0, 0.0) == (6e9, -4e9, 0.0, 0.0, 0.0)
    assert stored(law, 3.0, -4.0, 0.0) == 0.5 * (2e9 * 9.0 + 1e9 * 16.0)


def test_pressure_pushes_whatever_the_opening():
    law = Pressure(5.0)
    assert respond(law, -1.0, 2.0, 0.0) == respond(law, 1.0, 0.0, 0.0) == (-5.0, 0.0, 0.0, 0.0, 0.0)
    assert stored(law, 1.0, 0.0, 0.0) == 0.0
