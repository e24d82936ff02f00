"""The elastic law through the strain update of particles: Hooke's numbers, energy, rotation."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cramp_cli.materials.elastic import Elastic
from cramp_cli.materials.geometry import PlaneStrain, PlaneStress, is_plane_stress, strained
from cramp_cli.materials.law import (
    Straining,
    confined_modulus,
    poisson_ratio,
    shear_modulus,
)
from cramp_cli.shapes.linear import Linear
from cramp_cli.state.grid import make_grid
from cramp_cli.state.lattice import Lattice
from cramp_cli.state.particles import particles_at
from cramp_cli.state.stencil import make_stencil
from cramp_cli.transfer.to_particles import update_stress

E, NU = 70e9, 0.3
LAME, SHEAR = E * NU / ((1 + NU) * (1 - 2 * NU)), E / (2 * (1 + NU))
GLASS = Elastic(LAME, SHEAR)
STRAIN, STRESS = PlaneStrain(1.0), PlaneStress(1.0)
NONE = (0.0,) * 6
ROUND_OFF = 1e-13  # of stresses that are differences of larger ones
LATTICE = Lattice((1, 1), 0.5, (0.0, 0.0))
ALONE = np.array([[0, 1, 0]])  # one particle, in band 0
AT_REST = particles_at(np.array([[0.2, 0.3]]), [0], [1.0], [1.0])


def strain_particle(particles, geometry, L, dt, share=1.0):
    """Strain a particle in a cell whose nodes move with velocity gradient L (1/s)."""
    shape = Linear((0.25, 0.25))
    stencil = make_stencil(1, 2, 4, 1)
    stencil.local[0] = particles.position[0] / LATTICE.width
    grid, _ = make_grid(4, 2, 0)
    grid.velocity[:] = LATTICE.node_positions() @ np.array(L).T
    motion = (LATTICE.strides, LATTICE.width, share * dt, ALONE)
    update_stress(particles, grid, stencil, GLASS, geometry, shape, *motion)


def fresh_particle():
    return AT_REST._replace(**{name: array.copy() for name, array in AT_REST._asdict().items()})


def stress_after(geometry, dU):
    """Return the stress after one step of the displacement gradient (four numbers) from rest."""
    step = Straining(NONE, dU, (1.0, 0.0, 0.0, 1.0), 1.0, 1.0)
    return strained(geometry, GLASS, step, np.zeros((1, 0)), 0)[1]


def stress_of(geometry, exx, eyy, gamma=0.0):
    """Return the stress after one strain from rest; gamma is the engineering shear strain."""
    return stress_after(geometry, (exx, 0.5 * gamma, 0.5 * gamma, eyy))


def test_constants():
    assert poisson_ratio(GLASS) == pytest.approx(NU, rel=ROUND_OFF)
    assert shear_modulus(GLASS) == SHEAR
    K = E / (3 * (1 - 2 * NU))
    assert confined_modulus(GLASS) == pytest.approx(K + 4 * SHEAR / 3, rel=ROUND_OFF)
    assert is_plane_stress(STRESS)
    assert not is_plane_stress(STRAIN)


def test_confined_bar():
    """sigma_xx = (lambda + 2G) eps, sigma_yy = sigma_zz = lambda eps."""
    wanted = (confined_modulus(GLASS) * 1e-3, LAME * 1e-3, LAME * 1e-3, 0.0, 0.0, 0.0)
    assert stress_of(STRAIN, 1e-3, 0.0) == pytest.approx(wanted, rel=ROUND_OFF)


@pytest.mark.parametrize("size", [1e-3, 1e-9, 1e-15])
def test_bar_in_plane_stress(size):
    """sigma = E eps when the bar contracts by nu eps, however small the strain of a step is."""
    got = stress_of(STRESS, size, -NU * size)
    assert got == pytest.approx((E * size, 0, 0, 0, 0, 0), abs=ROUND_OFF * E * size)
    assert got[2] == 0.0


def test_wide_bar_in_plane_strain():
    """sigma_xx = E/(1 - nu^2) eps, sigma_zz = nu sigma_xx when it contracts by nu/(1 - nu) eps."""
    sigma = E / (1 - NU**2) * 1e-3
    got = stress_of(STRAIN, 1e-3, -NU / (1 - NU) * 1e-3)
    assert got == pytest.approx((sigma, 0, NU * sigma, 0, 0, 0), abs=ROUND_OFF * sigma)


@pytest.mark.parametrize("geometry", [STRAIN, STRESS])
def test_shear(geometry):
    """tau = G gamma."""
    got = stress_of(geometry, 0.0, 0.0, gamma=2e-3)
    assert got == pytest.approx((0, 0, 0, SHEAR * 2e-3, 0, 0), abs=ROUND_OFF * SHEAR * 2e-3)


strain_step = st.integers(-1000, 1000).map(lambda n: 1e-6 * n)


@pytest.mark.parametrize("geometry", [STRAIN, STRESS])
@settings(max_examples=40)
@given(path=st.lists(st.tuples(*[strain_step] * 3), min_size=1, max_size=6))
def test_work_is_half_stress_times_strain_on_any_path(geometry, path):
    """Hooke's stress is linear in strain: the mean stress of a step is exact, if there is no spin.

    Sums of the squares of the path's strains, which may cancel: round-off of the largest.
    """
    particle, total = fresh_particle(), np.zeros(3)
    for exx, eyy, exy in path:
        strain_particle(particle, geometry, [[exx, exy], [exy, eyy]], 1.0)
        total += (exx, eyy, exy)
    s = particle.stress[0]
    energy = 0.5 * (s[0] * total[0] + s[1] * total[1] + 2.0 * s[3] * total[2])
    assert particle.work[0] == pytest.approx(energy, abs=1e-14 * len(path) * E * 6e-3**2)


@pytest.mark.parametrize("geometry", [STRAIN, STRESS])
def test_a_turning_particle_keeps_its_stress(geometry):
    """A full turn in 40 steps of equal spin brings the stress back; a quarter swaps its axes.

    The Cayley transform of the spin w dt turns by 2 atan(w dt/2) (Hughes and Winget 1980).
    """
    steps = 40
    spin = 2.0 * np.tan(np.pi / steps)
    particle = fresh_particle()
    strain_particle(particle, geometry, [[1e-3, 3e-4], [3e-4, -2e-4]], 1.0)
    start, work = particle.stress[0].copy(), particle.work[0]
    size = ROUND_OFF * np.abs(start).max()
    for step in range(1, steps + 1):
        strain_particle(particle, geometry, [[0.0, -spin], [spin, 0.0]], 1.0)
        if step == steps // 4:
            swapped = [start[1], start[0], start[2], -start[3]]
            np.testing.assert_allclose(particle.stress[0], swapped, atol=size)
    np.testing.assert_allclose(particle.stress[0], start, atol=size)
    assert particle.work[0] == pytest.approx(work, rel=ROUND_OFF)


@pytest.mark.parametrize("geometry", [STRAIN, STRESS])
@pytest.mark.parametrize("angle", [0.3, 1.7])
def test_a_turned_strain_gives_the_turned_stress(geometry, angle):
    """The law is isotropic: stress(R e R^T) = R stress(e) R^T."""
    c, s = np.cos(angle), np.sin(angle)
    R = np.array([[c, -s], [s, c]])
    e = np.array([[1e-3, 2e-4], [2e-4, -5e-4]])

    def stress(strain):
        xx, yy, zz, xy, _, _ = stress_after(geometry, tuple(strain.ravel()))
        return np.array([[xx, xy], [xy, yy]]), zz

    (plain, normal), (turned, other) = stress(e), stress(R @ e @ R.T)
    np.testing.assert_allclose(turned, R @ plain @ R.T, atol=ROUND_OFF * E * 1e-3)
    assert other == pytest.approx(normal, abs=ROUND_OFF * E * 1e-3)


def test_deformation_gradient_multiplies_and_the_gradient_is_the_last():
    """F = dF2 dF1 with dF = 1 + dU + dU^2/2; L is that of the last strain update."""
    first, second = np.array([[0.1, 0.3], [-0.2, 0.05]]), np.array([[-0.2, 0.1], [0.4, 0.3]])
    particle, dt = fresh_particle(), 0.1
    strain_particle(particle, STRAIN, first, dt, share=0.5)
    strain_particle(particle, STRAIN, second, dt, share=0.5)
    dF = [np.eye(2) + U + 0.5 * U @ U for U in (0.05 * first, 0.05 * second)]
    np.testing.assert_allclose(particle.F[0].reshape(2, 2), dF[1] @ dF[0], rtol=1e-14)
    np.testing.assert_allclose(particle.L[0].reshape(2, 2), second, rtol=1e-14)


def test_thickness_follows_poisson_in_plane_stress():
    """eps_zz = -nu/(1 - nu) (eps_xx + eps_yy); the stretch is its exponential to second order."""
    particle = fresh_particle()
    strain_particle(particle, STRESS, [[1e-3, 0.0], [0.0, 2e-3]], 1.0)
    zz = -NU / (1 - NU) * 3e-3
    assert particle.stretch[0] == pytest.approx(1.0 + zz + 0.5 * zz**2, rel=1e-15)
