"""A crack whose faces stick in a uniform field is no crack: what the faces carry cancels K_II."""

from types import SimpleNamespace

import numpy as np
import pytest
from unit.test_domain_integral import CELL, PLANE_STRAIN, R1, SHEAR, STILL, field

from cramp_cli.cracks.contact import FRICTIONAL, STICK
from cramp_cli.cracks.domain_integral import inner_radius, integrate_domain
from cramp_cli.cracks.face_terms import rubbed_off

INNER = inner_radius(R1, CELL)
TAU, PRESSURE = 1e-9 * SHEAR, 2e-9 * SHEAR


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
