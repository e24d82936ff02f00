"""What must hold for every law, on any path: frames, energy, waves, plane stress."""

from math import sqrt

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from unit.laws import (
    AXES,
    LAWS,
    METALS,
    RUBBERS,
    STEEL,
    STRAIN,
    STRESS,
    E,
    K,
    particle_of,
    rotation,
    strain,
    stress_of,
)

from cramp_cli.materials.hardening import yield_stress
from cramp_cli.materials.law import confined_modulus, memory
from cramp_cli.state.particles import DISSIPATED, PLASTIC_STRAIN
from cramp_cli.transfer.to_particles import strain_one

ROUND_OFF = 1e-12  # times E: sums of a few hundred terms of the size of the largest stress
EVERY = pytest.mark.parametrize("name", sorted(LAWS))
PLANES = pytest.mark.parametrize("geometry", [STRAIN, STRESS], ids=["strain", "stress"])
entry = st.integers(-100, 100).map(lambda n: 1e-4 * n)
path = st.lists(st.tuples(*[entry] * 4), min_size=1, max_size=6)
PATH = ((0.01, 0.004, -0.002, -0.003), (-0.03, 0.0, 0.01, 0.01), (0.01, 0.02, 0.0, 0.0))
REMEMBERING = sorted(name for name, law in LAWS.items() if memory(law))


def walk(law, geometry, steps, turned=0.0, dt=0.1):
    """Strain a particle along a path that is seen from a frame turned by an angle."""
    R = rotation(turned)[:2, :2]
    particle = particle_of(law, R.ravel())
    for step in steps:
        strain(particle, law, geometry, R @ np.reshape(step, (2, 2)) @ R.T, dt)
    return particle


@EVERY
@PLANES
@settings(max_examples=15)
@given(steps=path, angle=st.integers(-31, 31).map(lambda n: 0.1 * n))
def test_a_turned_body_on_a_turned_path_has_the_turned_stress(name, geometry, steps, angle):
    """Objectivity: F -> R F gives tau -> R tau R^T, and no other energy."""
    law, R = LAWS[name], rotation(angle)
    plain, turned = walk(law, geometry, steps), walk(law, geometry, steps, angle)
    wanted = R @ stress_of(plain) @ R.T
    np.testing.assert_allclose(stress_of(turned), wanted, atol=ROUND_OFF * E)
    assert turned.work[0] == pytest.approx(plain.work[0], abs=ROUND_OFF * E)
    np.testing.assert_allclose(turned.history[0, :2], plain.history[0, :2], atol=ROUND_OFF * E)


@EVERY
@PLANES
def test_a_body_that_spins_carries_its_stress_along(name, geometry):
    """A quarter of a turn after a strain, in 2000 steps of 1e-15 s, so that nothing can relax.

    A step of the spin w makes F longer by w^4/8 and turns it by w^3/6 too little: with w = pi/4000
    the stress is off by less than E times 2000 w^3 = 1e-6; rates that turn are exact.
    """
    law, steps = LAWS[name], 2000
    particle = walk(law, geometry, [(2e-3, 1e-3, 1e-3, -1e-3)])
    before, spin = stress_of(particle), 2.0 * np.tan(np.pi / (4 * steps))
    work, history = particle.work[0], particle.history[0, :2].copy()
    for _ in range(steps):
        strain(particle, law, geometry, [[0.0, -spin], [spin, 0.0]], 1e-15)
    R = rotation(np.pi / 2)
    near = 2000 * spin**3 if name in RUBBERS else 1e-8
    np.testing.assert_allclose(stress_of(particle), R @ before @ R.T, atol=near * E)
    assert particle.work[0] == pytest.approx(work, abs=1e-3 * near * E)
    np.testing.assert_allclose(particle.history[0, :2], history, atol=1e-3 * near)


@EVERY
@settings(max_examples=15)
@given(steps=path)
def test_plane_stress_has_none_across_the_plane(name, steps):
    """The particle keeps exactly zero; 3D gives the same stress for the thickness it has found."""
    law = LAWS[name]
    assert walk(law, STRESS, steps).stress[0, 2] == 0.0


@EVERY
@pytest.mark.parametrize("angle", [0.0, 0.4, 1.1])
def test_confined_modulus_is_that_of_the_stress(name, angle):
    """d tau_nn / d eps_nn at rest; no direction has a stiffer one, an isotropic law has only it."""
    law, size = LAWS[name], 1e-7
    n = rotation(angle)[:2, 0]
    particle = particle_of(law)
    strain(particle, law, STRAIN, size * np.outer(n, n), 1e-9)
    slope = n @ stress_of(particle)[:2, :2] @ n / size
    if name == "orthotropic":
        assert slope <= confined_modulus(law) * (1 + 1e-6)
    else:
        assert slope == pytest.approx(confined_modulus(law), rel=1e-6)


def test_orthotropic_has_the_confined_modulus_of_its_fastest_wave():
    """The largest eigenvalue of the acoustic tensor n C n over all directions of the plane."""
    law, size, largest = LAWS["orthotropic"], 1e-7, 0.0
    for angle in np.linspace(0.0, np.pi, 721):
        n, columns = rotation(angle)[:2, 0], []
        for a in np.eye(2):
            particle = particle_of(law)
            strain(particle, law, STRAIN, size * np.outer(a, n), 1e-9)
            columns.append(stress_of(particle)[:2, :2] @ n / size)
        largest = max(largest, np.linalg.eigvals(np.array(columns)).real.max())
    assert confined_modulus(law) == pytest.approx(largest, rel=1e-4)


def energy_of_stress(tau):
    """Return the energy of an isotropic elastic stress per volume."""
    mean = np.trace(tau) / 3.0
    s = tau - mean * np.eye(3)
    return 0.5 * mean**2 / K + 0.25 * np.sum(s * s) / STEEL.shear


@pytest.mark.parametrize("name", ["elastic", *sorted(METALS), "drucker_prager"])
@PLANES
@settings(max_examples=25)
@given(steps=path)
def test_work_is_the_energy_of_the_stress_and_what_was_dissipated(name, geometry, steps):
    """Exact for rate laws: both ends of a step are on the same straight line."""
    law = LAWS[name]
    particle = walk(law, geometry, steps)
    lost = particle.history[0, DISSIPATED] if memory(law) else 0.0
    stored = energy_of_stress(stress_of(particle))
    assert particle.work[0] == pytest.approx(stored + lost, abs=ROUND_OFF * E)


@pytest.mark.parametrize("name", REMEMBERING)
@PLANES
@settings(max_examples=8)
@given(steps=path)
def test_dissipation_and_plastic_strain_never_fall(name, geometry, steps):
    """In steps of less stress than the strength: the work of a larger one is partly elastic."""
    law, before, pieces = LAWS[name], np.zeros(2), 50
    particle = particle_of(law)
    for step in np.repeat(steps, pieces, axis=0) / pieces:
        strain(particle, law, geometry, step.reshape(2, 2), 0.1)
        now = particle.history[0, [DISSIPATED, PLASTIC_STRAIN]].copy()
        assert (now >= before - ROUND_OFF).all()
        before = now


CYCLES = {  # corners of F, and by how much less is left after twice the steps
    "stretch": ([[1, 0, 0, 1], [1.4, 0, 0, 1], [1.4, 0, 0, 1.2], [1, 0, 0, 1.3]], 4.0),
    "shear": ([[1, 0, 0, 1], [1.4, 0, 0, 1], [1.4, 0.3, 0.1, 1.2], [1, 0, 0.3, 1.3]], 2.0),
}


@pytest.mark.parametrize("name", sorted(RUBBERS))
@PLANES
@pytest.mark.parametrize("cycle", CYCLES)
def test_a_closed_cycle_of_rubber_gives_all_work_back(name, geometry, cycle):
    """Out one way, back another: what is left falls with the step, with its square without spin."""
    corners, less = CYCLES[cycle]
    coarse, fine = (work_left(LAWS[name], geometry, corners, steps) for steps in (100, 200))
    assert abs(fine) < 2e-4
    assert coarse / fine == pytest.approx(less, rel=0.1)


def work_left(law, geometry, corners, steps):
    """Return the work over the largest of the cycle, so many steps from corner to corner."""
    particle, largest = particle_of(law), 0.0
    corners = np.reshape([*corners, corners[0]], (-1, 2, 2)).astype(float)
    for start, end in zip(corners[:-1], corners[1:], strict=True):
        for share in np.arange(steps) / steps:
            a, change = start + (end - start) * share, (end - start) / steps
            strain(particle, law, geometry, change @ np.linalg.inv(a + 0.5 * change))
            largest = max(largest, particle.work[0])
    return particle.work[0] / largest


@pytest.mark.parametrize("name", sorted(METALS))
@settings(max_examples=30)
@given(steps=path)
def test_no_metal_is_stressed_beyond_its_yield_stress(name, steps):
    """sqrt(3/2 s:s) is at most the yield stress at the rate of the step, and the heat before it."""
    law, dt = METALS[name], 0.1
    particle = particle_of(law)
    for step in steps:
        before = particle.history[0].copy()
        strain(particle, law, STRAIN, np.reshape(step, (2, 2)), dt)
        tau, alpha = stress_of(particle), particle.history[0, PLASTIC_STRAIN]
        s = tau - np.trace(tau) / 3.0 * np.eye(3)
        rate = (alpha - before[PLASTIC_STRAIN]) / dt
        bound = yield_stress(law.hardening, alpha, rate, before[DISSIPATED])
        assert sqrt(1.5 * np.sum(s * s)) <= bound + ROUND_OFF * E


@EVERY
def test_compiled_and_plain_strains_agree(name):
    """Numba may fuse a product and a sum, so the last bits differ."""
    law = LAWS[name]
    plain = walk(law, STRESS, PATH)
    compiled = particle_of(law)
    for step in PATH:
        compiled.L[0] = 10.0 * np.array(step)
        strain_one(compiled, 0, law, STRESS, AXES, 0.1)
    for field in ("stress", "history", "work", "stretch"):
        got, wanted = getattr(compiled, field), getattr(plain, field)
        np.testing.assert_allclose(got, wanted, rtol=1e-9, atol=ROUND_OFF * E)
