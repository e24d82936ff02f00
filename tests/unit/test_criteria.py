"""When and where cracks grow, against the numbers and formulas of the literature."""

from math import acos, asin, cos, degrees, inf, pi, radians, sin, sqrt

import numpy as np
import pytest

from cramp_cli.cracks.criteria.critical_j import CriticalJ
from cramp_cli.cracks.criteria.directions import (
    GIVEN,
    NORMAL_TO_COD,
    OWN,
    SELF_SIMILAR,
    turn_by,
)
from cramp_cli.cracks.criteria.empirical import Empirical
from cramp_cli.cracks.criteria.load import Load
from cramp_cli.cracks.criteria.max_ctod import MaxCtod
from cramp_cli.cracks.criteria.max_energy_release_rate import MaxEnergyReleaseRate
from cramp_cli.cracks.criteria.max_hoop_stress import MaxHoopStress
from cramp_cli.cracks.criteria.steady_state import SteadyState
from cramp_cli.cracks.criteria.strain_energy_density import StrainEnergyDensity
from cramp_cli.cracks.kink import kinked
from cramp_cli.cracks.rayleigh import rayleigh_speed, release_factors, wave_speeds

TOUGHNESS = 3.0
HOOP, RELEASE = MaxHoopStress(TOUGHNESS), MaxEnergyReleaseRate(TOUGHNESS)
DENSITY = StrainEnergyDensity(TOUGHNESS, 3.0 - 4.0 * 0.3)
MIXES = [Load(1.0, 0.1), Load(1.0, 0.5), Load(1.0, 1.0), Load(1.0, 2.0), Load(0.0, 1.0)]


def mirrored(load):
    return load._replace(K_II=-load.K_II)


def erdogan_sih(load):
    """The angle of Erdogan and Sih (1963) by its cosine and sine (degrees)."""
    K_I, K_II = load.K_I, load.K_II
    c = (3.0 * K_II**2 + K_I * sqrt(K_I**2 + 8.0 * K_II**2)) / (K_I**2 + 9.0 * K_II**2)
    by_sine = -degrees(asin(min(1.0, K_II * (3.0 * c - 1.0) / K_I))) if K_I else 0.0
    return -degrees(acos(c)) if c < 0.9 else by_sine


@pytest.mark.parametrize(
    ("load", "quoted"),
    list(zip(MIXES, (-11.203, -40.208, -53.130, -61.342, -70.529), strict=True)),
)
def test_hoop_stress_angles(load, quoted):
    angle = degrees(HOOP.direction(load))
    assert angle == pytest.approx(quoted, abs=5e-4)
    assert angle == pytest.approx(erdogan_sih(load), abs=1e-9)
    assert degrees(HOOP.direction(mirrored(load))) == -angle


def test_hoop_stress_of_closing_faces():
    """Kalthoff's notch without contact, K_I < 0: a steeper kink than that of pure mode II."""
    angle = HOOP.direction(Load(-25.3, -70.6))
    assert -25.3 * sin(angle) - 70.6 * (3.0 * cos(angle) - 1.0) == pytest.approx(0.0, abs=1e-12)
    assert radians(70.53) < angle < radians(90.0)


def test_hoop_stress_loads():
    assert HOOP.drive(Load(TOUGHNESS, 0.0)) == 1.0
    assert HOOP.drive(Load(0.0, 1.0)) * TOUGHNESS == pytest.approx(2.0 / sqrt(3.0), abs=1e-9)
    assert HOOP.drive(Load(0.0, sqrt(0.75) * TOUGHNESS)) == pytest.approx(1.0, abs=1e-9)
    assert HOOP.drive(Load(-TOUGHNESS, 0.0)) < 0.0


@pytest.mark.parametrize("mix", np.linspace(-1.5, 1.5, 7))
def test_no_other_direction_has_a_larger_hoop_stress(mix):
    half = 0.5 * np.linspace(-pi, pi, 20001)
    hoop = np.cos(half) ** 2 * (np.cos(half) - 3.0 * mix * np.sin(half))
    assert HOOP.drive(Load(1.0, mix)) * TOUGHNESS == pytest.approx(hoop.max(), rel=1e-7)


def plain_kink(K_I, K_II, phi):
    """Amestoy and Leblond (1992), term by term, for real or complex angles."""
    m, p = phi / pi, pi
    F11 = 1 - 3 * p**2 / 8 * m**2 + (p**2 - 5 * p**4 / 128) * m**4
    F11 += (p**2 / 9 - 11 * p**4 / 72 + 119 * p**6 / 15360) * m**6 + 5.07790 * m**8
    F11 += -2.88312 * m**10 - 0.0925 * m**12 + 2.996 * m**14 - 4.059 * m**16
    F11 += 1.63 * m**18 + 4.1 * m**20
    F12 = -3 * p / 2 * m + (10 * p / 3 + p**3 / 16) * m**3
    F12 += (-2 * p - 133 * p**3 / 180 + 59 * p**5 / 1280) * m**5 + 12.313906 * m**7
    F12 += -7.32433 * m**9 + 1.5793 * m**11 + 4.0216 * m**13 - 6.915 * m**15
    F12 += 4.21 * m**17 + 4.56 * m**19
    F21 = p / 2 * m - (4 * p / 3 + p**3 / 48) * m**3
    F21 += (-2 * p / 3 + 13 * p**3 / 30 - 59 * p**5 / 3840) * m**5 - 6.176023 * m**7
    F21 += 4.44112 * m**9 - 1.5340 * m**11 - 2.0700 * m**13 + 4.684 * m**15
    F21 += -3.95 * m**17 - 1.32 * m**19
    F22 = 1 - (4 + 3 * p**2 / 8) * m**2 + (8 / 3 + 29 * p**2 / 18 - 5 * p**4 / 128) * m**4
    F22 += (-32 / 15 - 4 * p**2 / 9 - 1159 * p**4 / 7200 + 119 * p**6 / 15360) * m**6
    F22 += 10.58254 * m**8 - 4.78511 * m**10 - 1.8804 * m**12 + 7.280 * m**14
    F22 += -7.591 * m**16 + 0.25 * m**18 + 12.5 * m**20
    return F11 * K_I + F12 * K_II, F21 * K_I + F22 * K_II


def release_slope(load, phi):
    """d(k_I^2 + k_II^2)/d phi by a complex step: exact to round-off."""
    first, second = plain_kink(load.K_I, load.K_II, phi + 1e-30j)
    return (first * first + second * second).imag / 1e-30


@pytest.mark.parametrize("phi", np.linspace(-1.4, 1.4, 9))
def test_kinked_tip(phi):
    assert kinked(1.3, -0.7, phi) == pytest.approx(plain_kink(1.3, -0.7, phi), abs=1e-12)


def test_small_kinks_turn_as_in_the_series_of_cotterell_and_rice():
    """Cotterell and Rice (1980), first order in the angle."""
    k_I, k_II = kinked(1.0, 0.5, 1e-5)
    assert k_I == pytest.approx(1.0 - 1.5e-5 * 0.5, abs=1e-9)
    assert k_II == pytest.approx(0.5 + 0.5e-5, abs=1e-9)


@pytest.mark.parametrize(
    ("load", "quoted", "within"),
    [
        (MIXES[0], -11.25, 0.05),
        (MIXES[1], -42.0, 0.05),
        (MIXES[2], -56.6, 0.05),
        (MIXES[3], -65.8, 0.05),
        (MIXES[4], -75.76, 0.005),
        (MIXES[4], -75.6, 0.3),
    ],
)
def test_energy_release_angles(load, quoted, within):
    angle = RELEASE.direction(load)
    assert degrees(angle) == pytest.approx(quoted, abs=within)
    low, high = angle - radians(1e-9), angle + radians(1e-9)
    assert release_slope(load, low) > 0.0 > release_slope(load, high)
    assert RELEASE.direction(mirrored(load)) == pytest.approx(-angle, abs=1e-12)


def test_energy_release_loads():
    assert RELEASE.drive(Load(TOUGHNESS, 0.0)) == pytest.approx(1.0, abs=1e-12)
    assert RELEASE.drive(Load(-TOUGHNESS, 0.0)) == 0.0
    k_I, k_II = plain_kink(0.0, 1.0, RELEASE.direction(Load(0.0, 1.0)))
    drive = RELEASE.drive(Load(0.0, 1.0))
    assert drive == pytest.approx(np.hypot(k_I, k_II) / TOUGHNESS, abs=1e-12)


def test_a_kink_of_local_symmetry():
    """In pure mode II k_II vanishes at 77.33 degrees (quoted: 77.3)."""
    assert abs(kinked(0.0, 1.0, radians(-77.33))[1]) < 2e-4
    assert kinked(0.0, 1.0, radians(-77.3))[1] * kinked(0.0, 1.0, radians(-77.36))[1] < 0.0


@pytest.mark.parametrize("nu", [0.2, 0.3, 0.4])
def test_strain_energy_density_in_mode_II(nu):
    """Sih (1974): cos(angle) = (1 - 2 nu)/3 in plane strain; 82.338 degrees for nu = 0.3."""
    law = StrainEnergyDensity(TOUGHNESS, 3.0 - 4.0 * nu)
    angle = degrees(law.direction(Load(0.0, 1.0)))
    assert angle == pytest.approx(-degrees(acos((1.0 - 2.0 * nu) / 3.0)), abs=1e-9)
    if nu == 0.3:
        assert angle == pytest.approx(-82.338, abs=5e-4)


@pytest.mark.parametrize("load", [*MIXES, Load(-0.3, 1.0)])
def test_strain_energy_density_is_a_minimum(load):
    angle = DENSITY.direction(load)
    t = np.linspace(-pi, pi, 720001)
    c, s, k = np.cos(t), np.sin(t), DENSITY.kappa
    S = (1 + c) * (k - c) * load.K_I**2 + 2 * s * (2 * c - k + 1) * load.K_I * load.K_II
    S += ((k + 1) * (1 - c) + (1 + c) * (3 * c - 1)) * load.K_II**2
    lowest = np.flatnonzero((S[1:-1] <= S[:-2]) & (S[1:-1] < S[2:])) + 1
    lowest = lowest[t[lowest] * load.K_II <= 0.0]
    assert angle == pytest.approx(t[lowest[np.argmin(np.abs(t[lowest]))]], abs=2e-5)
    assert DENSITY.direction(mirrored(load)) == -angle


def test_strain_energy_density_near_mode_I():
    assert DENSITY.direction(Load(1.0, 1e-4)) == pytest.approx(-2e-4, rel=1e-3)
    assert DENSITY.drive(Load(TOUGHNESS, 0.0)) == 1.0
    assert DENSITY.drive(Load(TOUGHNESS, 1e-9)) == pytest.approx(1.0, abs=1e-9)


@pytest.mark.parametrize(("p", "q"), [(2.0, 2.0), (1.0, 2.0), (1.5, 3.0)])
def test_empirical_curve(p, q):
    law = Empirical(2.0, 5.0, p, q)
    drive = law.drive(Load(3.0, -4.0))
    assert (3.0 / 2.0 / drive) ** p + (4.0 / 5.0 / drive) ** q == pytest.approx(1.0, abs=1e-9)
    assert law.drive(Load(2.0, 0.0)) == 1.0
    assert law.drive(Load(-1.0, 5.0)) == 1.0
    assert law.direction(Load(1.0, 1.0)) == HOOP.direction(Load(1.0, 1.0))


def test_critical_J_and_steady_state():
    for law in (CriticalJ(400.0), SteadyState(400.0)):
        assert law.drive(Load(0.0, 0.0, 400.0)) == 1.0
        assert law.drive(Load(0.0, 0.0, -1.0)) == 0.0
        assert law.direction(Load(1.0, 1.0, 400.0)) == 0.0
    assert SteadyState(begin=1.0).drive(Load(0.0, 0.0, 1e30)) == 0.0


def test_critical_opening():
    law = MaxCtod(2e-6, 3e-6)
    assert law.drive(Load(0.0, 0.0, opening=2e-6)) == 1.0
    assert law.drive(Load(0.0, 0.0, opening=-9e-6, sliding=-3e-6)) == 1.0
    assert MaxCtod(delta_IIc=1e-6).drive(Load(0.0, 0.0, opening=1.0)) == 0.0
    assert MaxCtod().delta_Ic == inf


def test_directions():
    load = Load(0.0, 1.0, opening=1.0, sliding=1.0)
    assert turn_by(OWN, HOOP, load, (1.0, 0.0), (0.0, 1.0)) == HOOP.direction(load)
    assert turn_by(SELF_SIMILAR, HOOP, load, (1.0, 0.0), (0.0, 1.0)) == 0.0
    assert turn_by(NORMAL_TO_COD, HOOP, load, (1.0, 0.0), (0.0, 1.0)) == pytest.approx(-pi / 4.0)
    assert turn_by(GIVEN, HOOP, load, (1.0, 0.0), (0.0, 1.0)) == pytest.approx(pi / 2.0)


def test_speeds_of_kalthoffs_steel():
    """E = 190 GPa, nu = 0.3, 8000 kg/m^3 in plane strain: 5654.3, 3022.4 and 2803 m/s."""
    fast, slow = wave_speeds(190e9 / 2.6, 3.0 - 4.0 * 0.3, 8000.0)
    assert (fast, slow) == pytest.approx((5654.3, 3022.4), abs=0.05)
    assert rayleigh_speed(fast, slow) == pytest.approx(2803.0, abs=0.6)


def test_rayleigh_speed_for_a_quarter():
    """nu = 1/4: c_R/c_s = sqrt(2 - 2/sqrt(3)) exactly."""
    fast, slow = wave_speeds(1.0, 2.0, 1.0)
    assert rayleigh_speed(fast, slow) == pytest.approx(sqrt(2.0 - 2.0 / sqrt(3.0)), abs=1e-12)


@pytest.mark.parametrize(
    ("share", "first", "second"),
    [
        (0.2, 1.0262, 1.0134),
        (0.4, 1.1180, 1.0593),
        (0.5, 1.2037, 1.1008),
        (0.6, 1.3374, 1.1639),
        (0.8, 2.0006, 1.4612),
        (0.9, 3.2635, 2.0083),
    ],
)
def test_factors_of_a_moving_tip(share, first, second):
    """A(v)/A(0) for nu = 0.3 (Freund 1990; Nishioka 1990)."""
    fast, slow = wave_speeds(1.0, 1.8, 1.0)
    rest = release_factors(0.0, fast, slow)
    assert rest == pytest.approx((0.7, 0.7), abs=1e-12)
    factors = release_factors(share * rayleigh_speed(fast, slow), fast, slow)
    assert factors[0] / rest[0] == pytest.approx(first, abs=6e-5)
    assert factors[1] / rest[1] == pytest.approx(second, abs=6e-5)
