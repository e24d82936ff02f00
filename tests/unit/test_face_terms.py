"""A crack whose faces stick in a uniform field is no crack: what the faces carry cancels K_II."""

from types import SimpleNamespace

import numpy as np
import pytest
from unit.test_domain_integral import CELL, PLANE_STRAIN, R1, SHEAR, STILL, field

from cramp_cli.cohesive.elastic import Elastic
from cramp_cli.cohesive.modes import Modes
from cramp_cli.cracks.cohesion import Cohesion
from cramp_cli.cracks.contact import FRICTIONAL, STICK
from cramp_cli.cracks.domain_integral import TipFrame, inner_radius, integrate_domain
from cramp_cli.cracks.face_terms import drawn, rubbed_off, zone_energy
from cramp_cli.cracks.tips import tips_of
from cramp_cli.state.paths import TIP, make_paths

INNER = inner_radius(R1, CELL)
STIFF = 5.0  # Pa/m
TAU, PRESSURE = 1e-9 * SHEAR, 2e-9 * SHEAR


def frame_of(tip, state):
    axis = tip.direction(state.paths.point)
    return TipFrame(tuple(state.paths.point[tip.points[0]]), axis, axis)


def uniform(shear, pressure):
    """Return site and particles under a uniform shear stress and pressure across the crack."""
    particles, frame = field(0.0, 0.0, PLANE_STRAIN, tip=(0.0, 0.0))
    particles.stress[:, 3], particles.stress[:, 1] = shear, -pressure
    particles.F[:] = [1.0, shear / SHEAR, 0.0, 1.0]
    particles.work[:] = 0.5 * shear**2 / SHEAR
    cloud = SimpleNamespace(particles=particles, parts=((None, 0, len(particles.mass)),))
    return SimpleNamespace(frame=frame, cloud=cloud)


def model(kind, mu=0.0):
    contact = SimpleNamespace(kind=np.array([kind]), mu=np.array([mu]))
    return SimpleNamespace(lattice=SimpleNamespace(width=CELL), contact=contact)


def added(kind, mu=0.0, shear=TAU, pressure=PRESSURE):
    return rubbed_off(model(kind, mu), uniform(shear, pressure), 0, INNER, R1)


@pytest.mark.parametrize("shear", [TAU, -TAU])
def test_stuck_faces_take_all_of_K_II(shear):
    """In a uniform field; 1 %: the sum over particles sees the jump at the crack coarsely."""
    site = uniform(shear, 0.0)
    _, _, K_II, _ = integrate_domain(
        site.cloud.particles, site.frame, PLANE_STRAIN, STILL, INNER, R1, *site.cloud.parts[0][1:]
    )
    assert added(STICK, shear=shear) == pytest.approx(K_II, rel=0.01)


def test_sliding_faces_carry_mu_times_the_pressure():
    assert added(FRICTIONAL, 0.25) == pytest.approx(0.25 * PRESSURE / TAU * added(STICK), rel=1e-12)
    assert added(FRICTIONAL, 0.25, shear=-TAU) == pytest.approx(-added(FRICTIONAL, 0.25))
    assert added(FRICTIONAL, 2.0) == added(STICK)


def test_smooth_or_parted_faces_carry_nothing():
    assert added(FRICTIONAL, 0.0) == 0.0
    assert added(FRICTIONAL, 0.3, pressure=-PRESSURE) == 0.0


def springs(opening, sliding):
    """Return model and state of a straight crack whose faces are apart by the same all along."""
    line = np.stack([np.linspace(-2.0 * R1, 2.0 * R1, 81), np.zeros(81)], axis=1)
    paths = make_paths([line], [(TIP, TIP)], [0], [(-1, 0)], 2)
    paths.law[:] = 0
    paths.above[:] += (sliding, opening)
    law = Elastic(Modes((STIFF, 2.0 * STIFF), (np.inf, np.inf), (np.inf, np.inf), 1.0))
    model = SimpleNamespace(cohesion=Cohesion((law,), (None,)))
    return model, SimpleNamespace(paths=paths, time=0.0)


@pytest.mark.parametrize("end", [0, 1])
def test_springs_take_as_much_of_K_as_rubbing_of_the_same_stress(end):
    """Opening and sliding of the upper face along +x load both tips with K_I, K_II > 0."""
    model_, state = springs(3e-9, 2e-9)
    tip = tips_of(state.paths)[end]
    _, opened, slid = drawn(model_, state, tip, frame_of(tip, state), INNER, R1)
    as_rubbed = added(STICK, shear=TAU) / TAU
    assert opened == pytest.approx(STIFF * 3e-9 * as_rubbed, rel=1e-3)
    assert slid == pytest.approx(2.0 * STIFF * 2e-9 * as_rubbed, rel=1e-3)


@pytest.mark.parametrize("end", [0, 1])
def test_zone_of_springs_holds_what_they_store(end):
    """All of the gap arises between the tip, which is closed, and the first point: T_i g_i."""
    model_, state = springs(3e-9, 2e-9)
    energy = zone_energy(model_, state, tips_of(state.paths)[end])
    assert energy == pytest.approx(STIFF * (3e-9) ** 2 + 2.0 * STIFF * (2e-9) ** 2, rel=1e-12)
