"""J, K_I and K_II of a known field on particles: that of Williams (1957), by Kolosov's formulas."""

import numpy as np
import pytest
from scipy.integrate import quad

from cramp_cli.cracks.domain_integral import (
    Hooke,
    TipFrame,
    integral_of_weight,
    integrate_domain,
    weight,
)
from cramp_cli.cracks.williams import unit_slope, unit_stress
from cramp_cli.state.particles import particles_at

E, NU = 70e9, 0.3
SHEAR = E / (2 * (1 + NU))
PLANE_STRAIN = Hooke(SHEAR, 3 - 4 * NU, NU, E / (1 - NU**2))
PLANE_STRESS = Hooke(SHEAR, (3 - NU) / (1 + NU), NU / (1 + NU), E)
HOOKES = pytest.mark.parametrize("hooke", [PLANE_STRAIN, PLANE_STRESS], ids=["strain", "stress"])
CELL = 1.0
SMALL = 1e-9 * E  # K that strains by 1e-9 at a distance of one: finite rotation does not show
STILL = (0.0, 0.0)
R1 = 5.0 * CELL
INNER = 0.2  # R0/R1


def kolosov(K_I, K_II, x, y, hooke):
    """Return displacement gradient (n, 2, 2) and stress (n, 2, 2), crack along negative x.

    2G (u + iv) = kappa phi - z conj(phi') - conj(psi), phi' = (K_I - i K_II)/(2 sqrt(2 pi z)),
    psi' = conj(phi')(z) - phi' - z phi'' (free faces).
    """
    z = x + 1j * y
    root = np.sqrt(2.0 * np.pi * z)
    phi1 = 0.5 * (K_I - 1j * K_II) / root
    phi2 = -0.5 * phi1 / z
    psi1 = 0.5 * (K_I + 1j * K_II) / root - phi1 - z * phi2
    along = (hooke.kappa * phi1 - phi1.conj() - z * phi2.conj() - psi1.conj()) / (2.0 * hooke.shear)
    up = (
        1j
        * (hooke.kappa * phi1 - phi1.conj() + z * phi2.conj() + psi1.conj())
        / (2.0 * hooke.shear)
    )
    H = np.array([[along.real, up.real], [along.imag, up.imag]]).transpose(2, 0, 1)
    total, deviator = 4.0 * phi1.real, 2.0 * (z.conj() * phi2 + psi1)
    yy = 0.5 * (total + deviator.real)
    xx, xy = total - yy, 0.5 * deviator.imag
    return H, np.array([[xx, xy], [xy, yy]]).transpose(2, 0, 1)


def turned(angle):
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


def field(K_I, K_II, hooke, tip=(0.1, 0.2), crack=0.0, grid=0.0, spin=0.0, per_cell=2):
    """Return particles of a cracked body with the field of a tip, and the frame of the tip.

    crack: angle of the crack; grid: angle by which the particles are turned as well; spin: rotation
    of the body after it was strained
    """
    line = (np.arange(-7.0 * per_cell, 7.0 * per_cell) + 0.5) * CELL / per_cell
    X = np.stack(np.meshgrid(line, line), axis=-1).reshape(-1, 2)
    tip = np.array(tip) * CELL
    local = (X - tip) @ turned(crack - grid)
    H, stress = kolosov(K_I, K_II, local[:, 0], local[:, 1], hooke)
    Q, R = turned(crack), turned(spin)
    H, stress = Q @ H @ Q.T, Q @ stress @ Q.T
    volume = np.full(len(X), (CELL / per_cell) ** 2)
    particles = particles_at(X @ turned(grid).T, np.zeros(len(X)), volume, volume)
    particles.work[:] = 0.5 * np.einsum("nij,nij->n", stress, H)
    particles.F[:] = (R @ (np.eye(2) + H)).reshape(-1, 4)
    stress = R @ stress @ R.T
    particles.stress[:, [0, 1, 3]] = stress[:, [0, 1, 0], [0, 1, 1]]
    axes = tuple(Q[:, 0]), tuple((R @ Q)[:, 0])
    frame = TipFrame(tuple(turned(grid) @ tip), *axes, line=-1e-9 * CELL)  # on the crack: above
    return particles, frame


def measure(particles, frame, hooke, radius=R1, gravity=STILL):
    """Return J E'/K^2, K_I/K and K_II/K for K = SMALL, and how full the domain is."""
    n = len(particles.mass)
    J, K_I, K_II, filled = integrate_domain(
        particles, frame, hooke, gravity, INNER * radius, radius, 0, n
    )
    full = filled / integral_of_weight(INNER * radius, radius)
    return np.array([J * hooke.stiffness / SMALL**2, K_I / SMALL, K_II / SMALL]), full


def test_weight_is_one_then_falls_smoothly_to_zero():
    """The slope is the derivative (central differences; third derivatives are below 60/R^3)."""
    R0, R = 0.2, 1.0
    assert weight(0.1, R0, R) == (1.0, 0.0)
    for r in (0.2, 1.0):
        assert weight(r, R0, R) == pytest.approx((float(r < 0.5), 0.0), abs=1e-15)
    for r in np.linspace(0.21, 0.99, 14):
        ahead, behind = weight(r + 1e-5, R0, R)[0], weight(r - 1e-5, R0, R)[0]
        assert weight(r, R0, R)[1] == pytest.approx((ahead - behind) / 2e-5, abs=1e-7)


@pytest.mark.parametrize(("R0", "R"), [(0.2, 1.0), (0.0, 3.0), (1.0, 2.0)])
def test_integral_of_the_weight(R0, R):
    """Against quadrature of 2 pi r q."""
    inner = np.pi * R0**2
    outer = quad(lambda r: 2.0 * np.pi * r * weight(r, R0, R)[0], R0, R)[0]
    assert integral_of_weight(R0, R) == pytest.approx(inner + outer, rel=1e-12)


@HOOKES
@pytest.mark.parametrize("mode", [1, 2])
def test_williams_formulas_are_those_of_kolosov(mode, hooke):
    """Two ways to the same field: trigonometric functions and complex potentials."""
    angle = np.linspace(-3.1, 3.1, 11)
    x, y = 0.7 * np.cos(angle), 0.7 * np.sin(angle)
    H, stress = kolosov(float(mode == 1), float(mode == 2), x, y, hooke)
    for n in range(len(x)):
        wanted = stress[n, 0, 0], stress[n, 1, 1], stress[n, 0, 1]
        assert unit_stress(mode, 0.7, angle[n]) == pytest.approx(wanted, abs=1e-14)
        slopes = unit_slope(mode, 0.7, angle[n], hooke.shear, hooke.kappa)
        assert np.array(slopes) * SHEAR == pytest.approx(H[n, :, 0] * SHEAR, abs=1e-14)


def test_signs():
    """Ahead of the tip sigma_yy = K_I/sqrt(2 pi r) and sigma_xy = K_II/sqrt(2 pi r)."""
    _, (stress,) = kolosov(3.0, -2.0, np.array([0.5]), np.array([0.0]), PLANE_STRAIN)
    assert stress[1] * np.sqrt(np.pi) == pytest.approx([-2.0, 3.0])


MIXES = [(1.0, 0.0), (0.0, 1.0), (0.0, -1.0), (0.8, 0.6), (0.8, -0.6)]
# Largest error of J, K_I, K_II relative to K over 120 places and angles, by particles along a cell
# side and radius in cells. The field is exact: this is the error of the particles as a quadrature.
# Found on 2026-11-22 with commit 9bf7d71.
REACHED = {(1, 5.0): 5e-3, (2, 2.5): 5e-3, (2, 4.0): 8e-4, (2, 5.0): 3.1e-4, (3, 5.0): 7e-5}


def assert_intensities(got, K_I, K_II, within):
    np.testing.assert_allclose(got, [K_I**2 + K_II**2, K_I, K_II], rtol=0.0, atol=within)


@HOOKES
@pytest.mark.parametrize(("K_I", "K_II"), MIXES)
@pytest.mark.parametrize("tip", [(0.0, 0.0), (0.5, 0.5), (0.1, 0.2), (0.4, 0.0), (0.0, 0.3)])
def test_intensities_of_an_exact_field(K_I, K_II, tip, hooke):
    """The usual radius of 5 cells with 2 x 2 particles in each; J = (K_I^2 + K_II^2)/E'."""
    got, full = measure(*field(K_I * SMALL, K_II * SMALL, hooke, tip), hooke)
    assert_intensities(got, K_I, K_II, REACHED[2, 5.0])
    assert full == pytest.approx(1.0, abs=1e-5)


@pytest.mark.parametrize(("per_cell", "radius"), REACHED)
def test_what_the_quadrature_reaches(per_cell, radius):
    """Fewer particles in the domain, less accuracy; a tip on a grid line and anywhere."""
    for tip in ((0.3, 0.0), (0.85, 0.5), (0.37, 0.71)):
        built = field(0.6 * SMALL, 0.8 * SMALL, PLANE_STRAIN, tip, per_cell=per_cell)
        got, _ = measure(*built, PLANE_STRAIN, radius)
        assert_intensities(got, 0.6, 0.8, REACHED[per_cell, radius])


@pytest.mark.parametrize(("K_I", "K_II"), MIXES[1:])
def test_a_particle_has_the_field_of_its_face(K_I, K_II):
    """A row of particles lies above the tip's own axis, but below the line of the crack.

    Its field is that of the lower face carried on, which is that of the upper one with the other
    sign. Told by the axis alone, which takes the row for one of the upper face, K_II is 8 % off.
    """
    particles, frame = field(K_I * SMALL, K_II * SMALL, PLANE_STRAIN)
    x, y = (particles.origin - frame.origin).T
    between = (x < 0.0) & (y > 0.0) & (y < 0.1 * CELL)
    assert between.sum() > 10
    particles.F[between] = 2.0 * np.eye(2).ravel() - particles.F[between]
    particles.stress[between] *= -1.0
    told, _ = measure(particles, frame._replace(line=0.1 * CELL), PLANE_STRAIN)
    taken, _ = measure(particles, frame, PLANE_STRAIN)
    assert_intensities(told, K_I, K_II, 5e-3)
    assert abs(taken[2] / K_II - 1.0) > 0.05


@pytest.mark.parametrize("crack", [0.3, np.pi / 4, 1.9, -2.4, np.pi])
def test_a_crack_at_any_angle_to_the_particles(crack):
    got, _ = measure(*field(0.6 * SMALL, -0.8 * SMALL, PLANE_STRAIN, crack=crack), PLANE_STRAIN)
    assert_intensities(got, 0.6, -0.8, REACHED[2, 5.0])


@pytest.mark.parametrize("angle", [0.3, 1.9, -2.4])
def test_a_body_turned_as_a_whole_has_the_same_intensities(angle):
    """To round-off of about 300 particles."""
    here, _ = measure(*field(0.6 * SMALL, 0.8 * SMALL, PLANE_STRAIN), PLANE_STRAIN)
    there, _ = measure(
        *field(0.6 * SMALL, 0.8 * SMALL, PLANE_STRAIN, crack=angle, grid=angle), PLANE_STRAIN
    )
    np.testing.assert_allclose(there, here, rtol=1e-7)


@pytest.mark.parametrize("spin", [0.01, 0.7, np.pi])
def test_a_turn_after_loading_does_not_matter(spin):
    """F to R F and stress to R stress R^T.

    F holds strains of 1e-9 beside a rotation, so 1e-16/1e-9 is lost.
    """
    still, _ = measure(*field(0.6 * SMALL, 0.8 * SMALL, PLANE_STRAIN), PLANE_STRAIN)
    turned_, _ = measure(*field(0.6 * SMALL, 0.8 * SMALL, PLANE_STRAIN, spin=spin), PLANE_STRAIN)
    np.testing.assert_allclose(turned_, still, rtol=1e-6)


def test_inertia_is_that_of_the_motion_less_gravity():
    """A body in free fall has no inertia term; one that is shaken adds rho a_i u_i,1 q to J and
    rho a_i U_i,1 q E'/2 to K.
    """
    particles, frame = field(SMALL, 0.0, PLANE_STRAIN)
    rest, _ = measure(particles, frame, PLANE_STRAIN)
    a = np.array([3e9, -2e9])
    particles.acceleration[:] = a
    falling, _ = measure(particles, frame, PLANE_STRAIN, gravity=tuple(a))
    np.testing.assert_array_equal(falling, rest)
    shaken, _ = measure(particles, frame, PLANE_STRAIN)
    away = particles.origin - frame.origin
    q = np.array([weight(r, INNER * R1, R1)[0] if r < R1 else 0.0 for r in np.hypot(*away.T)])
    slope = particles.F.reshape(-1, 2, 2)[:, :, 0] - (1.0, 0.0)
    J = np.sum(particles.mass * q * (slope @ a))
    assert shaken[0] - rest[0] == pytest.approx(J * PLANE_STRAIN.stiffness / SMALL**2, rel=1e-6)
    for mode in (1, 2):
        unit = kolosov(float(mode == 1), float(mode == 2), *away.T, PLANE_STRAIN)[0][:, :, 0]
        K = 0.5 * PLANE_STRAIN.stiffness * np.sum(particles.mass * q * (unit @ a))
        assert shaken[mode] - rest[mode] == pytest.approx(K / SMALL, rel=1e-6)


def test_blocks_add_up():
    """Any split of the particles gives the same sums."""
    particles, frame = field(SMALL, 0.0, PLANE_STRAIN)
    args = (particles, frame, PLANE_STRAIN, STILL, INNER * R1, R1)
    n = len(particles.mass)
    parts = np.array([integrate_domain(*args, 0, 300), integrate_domain(*args, 300, n)])
    np.testing.assert_allclose(parts.sum(axis=0), integrate_domain(*args, 0, n), rtol=1e-12)
