"""Every law against a closed form of one simple test."""

import numpy as np
import pytest
from scipy.optimize import brentq
from unit.laws import (
    HARDENING,
    POLYMER,
    RUBBERS,
    STEEL,
    STRAIN,
    STRESS,
    WOOD,
    E,
    G,
    K,
    particle_of,
    pull,
    rotation,
    strain,
    stress_of,
)

from cramp_cli.build.laws import cone, law_of
from cramp_cli.materials.drucker_prager import DruckerPrager
from cramp_cli.materials.hardening import JohnsonCook, yield_stress
from cramp_cli.materials.j2_plastic import J2Plastic
from cramp_cli.materials.mooney_rivlin import MooneyRivlin
from cramp_cli.state.particles import PLASTIC_STRAIN

ROUND_OFF = 1e-10  # the secants of the free side stop at 1e-12 E


@pytest.mark.parametrize("name", ["linear", "power", "voce"])
def test_metal_in_tension(name):
    """eps = eps_p + Y(eps_p)/E; the radial return is exact on a straight path."""
    law = J2Plastic(STEEL, HARDENING[name])
    particle = particle_of(law)
    stress, _ = pull(particle, law, np.full(40, 5e-4))
    for tau, total in zip(stress, 5e-4 * np.arange(1, 41), strict=True):

        def left(plastic, total=total):
            return plastic + yield_stress(law.hardening, plastic, 0.0, 0.0) / E - total

        plastic = brentq(left, 0.0, total, xtol=1e-15) if left(0.0) < 0.0 else 0.0
        assert tau == pytest.approx(E * (total - plastic), abs=ROUND_OFF * E)
    assert particle.history[0, PLASTIC_STRAIN] == pytest.approx(plastic, abs=ROUND_OFF)


@pytest.mark.parametrize("rate", [1.0, 100.0])
def test_rate_raises_the_yield_stress_of_johnson_and_cook(rate):
    """Without hardening all strain is plastic in the end: A (1 + C ln(rate/rate0)) (1 - T*^m)."""
    law = J2Plastic(STEEL, JohnsonCook(0.5, 0.0, 1.0, 0.05, 0.1, 1.5, 0.2, 0.0))
    stress, _ = pull(particle_of(law), law, np.full(40, 1e-3), dt=1e-3 / rate)
    wanted = 0.5 * (1.0 + 0.05 * np.log(rate / 0.1)) * (1.0 - 0.2**1.5)
    assert stress[-1] == pytest.approx(wanted, rel=1e-8)


def test_plastic_work_softens_johnson_and_cook():
    """With m = 1, B = C = 0: d tau/d eps_p = -A h tau, so tau = A exp(-A h eps_p).

    The heat is that of the step before: the error is one step, A h d eps_p = 5e-4 of the stress.
    """
    law = J2Plastic(STEEL, JohnsonCook(0.5, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 2.0))
    particle = particle_of(law)
    stress, _ = pull(particle, law, np.full(400, 5e-4))
    wanted = 0.5 * np.exp(-0.5 * 2.0 * particle.history[0, PLASTIC_STRAIN])
    assert stress[-1] == pytest.approx(wanted, rel=5e-4)


@pytest.mark.parametrize("step", [0.01, -0.01])
def test_neo_hookean_bar(step):
    """No stress across: G (t - 1) + lambda/2 (l^2 t^2 - 1) = 0 gives t, the stretch across squared.

    The bar gets to 1.5 or 0.6 of its length.
    """
    law = RUBBERS["neo_hookean"]
    particle = particle_of(law)
    stress, _ = pull(particle, law, np.full(40, step))
    length = particle.F[0, 0]
    a, b, c = 0.5 * law.lame * length**2, law.shear, -(law.shear + 0.5 * law.lame)
    t = (-b + np.sqrt(b * b - 4.0 * a * c)) / (2.0 * a)
    wanted = law.shear * (length**2 - 1.0) + 0.5 * law.lame * (length**2 * t**2 - 1.0)
    assert particle.stretch[0] ** 2 == pytest.approx(t, rel=1e-9)
    assert stress[-1] == pytest.approx(wanted, abs=1e-9 * E)


@pytest.mark.parametrize("step", [0.01, -0.01])
def test_mooney_rivlin_bar(step):
    """Incompressible: tau = 2 (l^2 - 1/l) (C10 + C01/l) (Treloar 1975); here K = 1e5 G."""
    law = MooneyRivlin(0.3, 0.2, 1e5)
    particle = particle_of(law)
    stress, _ = pull(particle, law, np.full(40, step))
    length = particle.F[0, 0]
    wanted = 2.0 * (length**2 - 1.0 / length) * (law.C10 + law.C01 / length)
    assert stress[-1] == pytest.approx(wanted, rel=1e-4)


@pytest.mark.parametrize("angle", [0.0, 25.0, 60.0, 90.0])
@pytest.mark.parametrize("turned", [0.0, 0.7])
def test_off_axis_modulus(angle, turned):
    """The strain of a bar cut at an angle (Jones 1999, section 2.8) gives stress along it alone.

    A bar that was turned as a whole at the start is stressed along its turned axis.
    """
    law, c, s = (
        law_of(WOOD.model_copy(update={"angle": angle})),
        *np.cos(np.radians([angle, angle - 90.0])),
    )
    E1, E2, nu, G12 = WOOD.E1, WOOD.E2, WOOD.nu12, WOOD.G12
    cross = 1.0 / G12 - 2.0 * nu / E1
    along = c**4 / E1 + cross * s**2 * c**2 + s**4 / E2
    across = (1.0 / E1 + 1.0 / E2 - 1.0 / G12) * s**2 * c**2 - nu / E1 * (s**4 + c**4)
    slide = (2.0 / E1 + 2.0 * nu / E1 - 1.0 / G12) * s * c**3
    slide -= (2.0 / E2 + 2.0 * nu / E1 - 1.0 / G12) * s**3 * c
    size, R = 1e-4, rotation(turned)[:2, :2]
    particle = particle_of(law, R.ravel())
    e = size * np.array([[along, 0.5 * slide], [0.5 * slide, across]])
    strain(particle, law, STRESS, R @ e @ R.T)
    wanted = R @ np.diag([size, 0.0]) @ R.T
    np.testing.assert_allclose(stress_of(particle)[:2, :2], wanted, atol=1e-12 * size * E)


@pytest.mark.parametrize("geometry", [STRAIN, STRESS])
def test_orthotropic_with_equal_constants_is_elastic(geometry):
    nu = STEEL.lame / (2.0 * (STEEL.lame + STEEL.shear))
    same = {"E1": E, "E2": E, "E3": E, "nu12": nu, "nu13": nu, "nu23": nu, "G12": G}
    law = law_of(WOOD.model_copy(update=same))
    pair = particle_of(law), particle_of(STEEL)
    for dU in np.random.default_rng(1).normal(0.0, 0.01, (20, 2, 2)):
        strain(pair[0], law, geometry, dU)
        strain(pair[1], STEEL, geometry, dU)
    np.testing.assert_allclose(*(stress_of(p) for p in pair), atol=1e-12 * E)


def modulus(time):
    """Return the relaxed shear modulus of the polymer."""
    parts = zip(POLYMER.shares, POLYMER.times, strict=True)
    return G * (1.0 - sum(g * (1.0 - np.exp(-time / tau)) for g, tau in parts))


def test_relaxation():
    """tau = 2 G(t) e after a strain at once; the mean stress stays."""
    particle, e = particle_of(POLYMER), 1e-4
    strain(particle, POLYMER, STRAIN, [[e, e], [e, 0.0]], 1e-12)
    for _ in range(30):
        strain(particle, POLYMER, STRAIN, np.zeros((2, 2)), 0.1)
    assert particle.stress[0, 3] == pytest.approx(2.0 * modulus(3.0) * e, rel=1e-10)
    assert particle.stress[0, :3].sum() == pytest.approx(3.0 * K * e, rel=1e-10)


@pytest.mark.parametrize("steps", [3, 30])
def test_constant_rate_of_strain(steps):
    """tau = 2 e/t int G: exact for any step."""
    particle, e, time = particle_of(POLYMER), 1e-4, 3.0
    for _ in range(steps):
        strain(particle, POLYMER, STRAIN, [[0.0, e / steps], [e / steps, 0.0]], time / steps)
    parts = zip(POLYMER.shares, POLYMER.times, strict=True)
    relaxed = sum(g * (time - tau * (1.0 - np.exp(-time / tau))) for g, tau in parts)
    wanted = 2.0 * G * e / time * (time - relaxed)
    assert particle.stress[0, 3] == pytest.approx(wanted, rel=1e-12)


def test_creep():
    """One branch: 1/G0 + (1/G1 - 1/G0) (1 - exp(-t G1/(G0 tau))), G1 the relaxed modulus."""
    law = POLYMER._replace(shares=(0.6,), times=(0.5,))
    particle, load, dt, relaxed = particle_of(law), 1e-3, 0.002, 0.4 * G
    total = load / (2.0 * G)
    strain(particle, law, STRAIN, [[0.0, total], [total, 0.0]], 1e-12)
    for _ in range(500):  # 1 s; what the stress would fall by is made up for by strain
        x = dt / 0.5
        held = particle.history[0, 2 + 3] * np.exp(-x) - particle.history[0, 2 + 3]
        e = -held / (2.0 * G * (0.4 - 0.6 * np.expm1(-x) / x))
        strain(particle, law, STRAIN, [[0.0, e], [e, 0.0]], dt)
        total += e
    assert particle.stress[0, 3] == pytest.approx(load, rel=1e-10)
    creep = 1.0 / G + (1.0 / relaxed - 1.0 / G) * (1.0 - np.exp(-1.0 * relaxed / (G * 0.5)))
    assert 2.0 * total / load == pytest.approx(creep, rel=1e-5)


@pytest.mark.parametrize(
    ("match", "geometry", "sign"),
    [("compression", STRESS, -1), ("tension", STRESS, 1), ("plane_strain", STRAIN, -1)],
)
def test_strength_of_soil_is_that_of_mohr_and_coulomb(match, geometry, sign):
    """2c cos phi/(1 -+ sin phi) without lateral stress, in the state in which the cones meet.

    In plane strain they meet at collapse, with the flow of the cone itself.
    """
    phi, c = 0.5, 0.3
    eta, xi = cone(match, phi)
    law = DruckerPrager(STEEL, eta, eta, xi * c)
    stress, _ = pull(particle_of(law), law, np.full(200, sign * 1e-3), geometry=geometry)
    wanted = sign * 2.0 * c * np.cos(phi) / (1.0 + sign * np.sin(phi))
    assert stress[-1] == pytest.approx(wanted, rel=1e-4)
