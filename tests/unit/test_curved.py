"""J, K_I and K_II of a curved crack from an exact field, that of an arc in a pulled plate."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from unit.test_domain_integral import PLANE_STRAIN, STILL
from verification.arc_crack import Arc, ArcCrack

from cramp_cli.cracks.domain_integral import (
    TipFrame,
    inner_radius,
    integral_of_weight,
    integrate_domain,
)
from cramp_cli.cracks.williams import (
    unit_displacement,
    unit_slope,
    unit_slope_across,
    unit_slope_change,
)
from cramp_cli.state.particles import particles_at

HALF = np.pi / 4
SMALL = 1e-9 * PLANE_STRAIN.shear  # stress far away (Pa)


def plate(cells):
    """Return a plate with an arc of 90 degrees, `cells` over half its chord; cells of 1 m."""
    radius = cells / np.sin(HALF)
    arc = Arc((0.0, -0.85 * radius), radius, 0.5 * np.pi, HALF)
    return ArcCrack(arc, (-3.0 * cells,) * 2, (3.0 * cells,) * 2)


PLATES = {cells: plate(cells) for cells in (10, 20)}


def tip_of(cells, end):
    """Return the place of a tip and the direction out of the crack."""
    arc = PLATES[cells].arc
    angle = arc.middle + end * HALF
    tip = np.array(arc.center) + arc.radius * np.array([np.cos(angle), np.sin(angle)])
    return tip, (-end * np.sin(angle), end * np.cos(angle))


def nearest(cells, end, shift):
    """Return the distance of the nearest particle from a tip, two along a cell."""
    from_particle = (tip_of(cells, end)[0] - shift - 0.25) % 0.5
    return np.hypot(*np.minimum(from_particle, 0.5 - from_particle))


def particles_of(whole, tip, shift, per_cell):
    line = (np.arange(-8.0 * per_cell, 8.0 * per_cell) + 0.5) / per_cell
    X = np.stack(np.meshgrid(line, line), axis=-1).reshape(-1, 2) + np.floor(tip) + shift
    H, stress = whole.field(X, PLANE_STRAIN.shear, PLANE_STRAIN.kappa)
    H, stress = SMALL * H, SMALL * stress
    volume = np.full(len(X), 1.0 / per_cell**2)
    particles = particles_at(X, np.zeros(len(X)), volume, volume)
    particles.F[:] = (np.eye(2) + H).reshape(-1, 4)
    particles.stress[:, [0, 1, 3]] = stress[:, [0, 1, 0], [0, 1, 1]]
    particles.work[:] = 0.5 * np.einsum("nij,nij->n", stress, H)
    return particles


def errors(cells, end, shift=(0.1, 0.2), per_cell=2, radius=5.0, bent=True):
    """Return the errors of J, K_I, K_II as shares of K, and how full the domain is."""
    whole, (tip, axis) = PLATES[cells], tip_of(cells, end)
    particles = particles_of(whole, tip, shift, per_cell)
    frame = TipFrame(tuple(tip), axis, axis, 0.0, end / whole.arc.radius if bent else 0.0)
    R0 = inner_radius(radius, 1.0)
    J, *K, filled = integrate_domain(
        particles, frame, PLANE_STRAIN, STILL, R0, radius, 0, len(particles.mass)
    )
    exact = SMALL * whole.intensities(end)
    size = np.hypot(*exact)
    of_J = J * PLANE_STRAIN.stiffness / size**2 - 1.0
    return np.array([of_J, *((K - exact) / size)]), filled / integral_of_weight(R0, radius)


@pytest.mark.parametrize("mode", [1, 2])
def test_further_derivatives_of_the_asymptotic_field(mode):
    """Central differences; along x that of `unit_slope`, itself checked against Kolosov."""
    step, constants = 1e-5, (1.3, 1.8)

    def at(function, x, y):
        return np.array(function(mode, np.hypot(x, y), np.arctan2(y, x), *constants))

    for x, y in ((0.7, 0.2), (-0.5, 0.6), (-0.4, -0.3), (0.1, -0.9)):
        across = (at(unit_displacement, x, y + step) - at(unit_displacement, x, y - step)) / 2e-5
        along = (at(unit_displacement, x + step, y) - at(unit_displacement, x - step, y)) / 2e-5
        change = (at(unit_slope, x + step, y) - at(unit_slope, x - step, y)) / 2e-5
        assert at(unit_slope_across, x, y) == pytest.approx(across, abs=1e-9)
        assert at(unit_slope, x, y) == pytest.approx(along, abs=1e-9)
        assert at(unit_slope_change, x, y) == pytest.approx(change, abs=1e-9)


def test_the_reference_is_that_of_an_infinite_plate_far_from_its_border():
    """Cotterell and Rice (1980): an arc of 90 degrees under equal tension from all sides."""
    far = ArcCrack(Arc((0.0, 0.0), 1.0, 0.7, HALF), (-50.0, -50.0), (50.0, 50.0), (1, 1, 0), 6)
    half = 0.5 * HALF
    exact = np.sqrt(np.pi * np.sin(HALF)) / (1.0 + np.sin(half) ** 2)
    for end in (-1, 1):
        wanted = exact * np.array([np.cos(half), end * np.sin(half)])
        np.testing.assert_allclose(far.intensities(end), wanted, rtol=5e-4)


@pytest.mark.parametrize("cells", [10, 20])
@pytest.mark.parametrize("end", [-1, 1])
def test_many_particles_show_that_the_terms_are_right(cells, end):
    """The same for all radii to 0.1 % of K. Straight coordinates give another K_II by 2 %."""
    found = np.array([errors(cells, end, per_cell=6, radius=r)[0] for r in (4.0, 5.0, 7.0)])
    assert np.abs(found).max() < 0.02
    assert np.ptp(found, axis=0).max() < 1e-3
    straight, _ = errors(cells, end, per_cell=6, bent=False)
    assert abs(straight[2] - found[1, 2]) > 0.015


@settings(max_examples=25)
@given(st.sampled_from([10, 20]), st.sampled_from([-1, 1]), st.tuples(*[st.floats(0.0, 1.0)] * 2))
def test_anywhere_in_the_cell(cells, end, shift):
    """Two particles along a cell: 4 % by the particle next to the tip, half of it on half the cell.

    That one sees the infinite stress of the exact field, which no particle of a run does; nearer
    than 0.15 cells it would make 10 %.
    """
    assume(nearest(cells, end, shift) > 0.15)
    found, full = errors(cells, end, shift)
    assert np.abs(found).max() < 0.4 / cells
    assert full == pytest.approx(1.0, abs=1e-3)
