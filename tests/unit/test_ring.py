"""Rings: slopes weighed by the radius, the deck's mistakes, checkpoints and threads."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support import advance, build_deck, read

from cramp_cli.build.model import SHAPES
from cramp_cli.deck.deck import DeckError
from cramp_cli.scratch import make_scratch
from cramp_cli.shapes.ring import Ring
from cramp_cli.shapes.shape import along_axis, first_node, seen_from, support
from cramp_cli.shapes.ugimp import UniformGimp

DISK = """
cramp: 1
analysis: axisymmetric
grid: {cell: 1}
materials: {m: {law: elastic, density: 2, E: 1, nu: 0.3}}
bodies: [{name: disk, material: m, shape: {type: rectangle, lower: [0, 0], upper: [6, 4]}}]
boundary: [{name: floor, where: {y: 0}, fix: [y]}]
solver: {end_time: 1}
"""
AXIS, COLUMNS = 2, 20


def of_particle(plain, radius):
    """Return values, slopes and the radii (cells) of the nodes of a particle at a radius."""
    ring = Ring(plain, plain.half, AXIS, COLUMNS)
    x = radius + AXIS
    first = first_node(ring, 0, x)
    values, slopes = along_axis(
        seen_from(ring, first + 3 * COLUMNS, (x - first, 0.5)), 0, x - first
    )
    return np.array(values), np.array(slopes), first - AXIS + np.arange(support(ring))


@pytest.mark.parametrize("name", [n for n in SHAPES if n != "cpdi"])
@pytest.mark.parametrize("half", [0.5, 0.25])
@given(radius=st.floats(1.0, 9.0))
def test_linear_fields_of_rings_are_exact(name, half, radius):
    """sum S = 1, sum S r_i = r; the slopes of a constant and of r are 0 and 1."""
    S, G, r = of_particle(SHAPES[name]((half, half)), radius)
    assert S.sum() == pytest.approx(1.0, abs=1e-14)
    assert S @ r == pytest.approx(radius, abs=1e-13)
    assert G.sum() == pytest.approx(0.0, abs=1e-14)
    assert G @ r == pytest.approx(1.0, abs=1e-13)


@given(radius=st.floats(0.6, 9.0))
def test_slopes_of_gimp_are_means_weighed_by_the_radius(radius):
    """G = int r N' dr / int r dr over the particle (Nairn and Guilkey 2015), piece by piece."""
    half = 0.25
    _, G, nodes = of_particle(UniformGimp((half, half)), radius)
    low, high = radius - half, radius + half
    ends = np.array([low, *np.arange(np.ceil(low), np.ceil(high)), high])
    middle, area = 0.5 * (ends[1:] + ends[:-1]), 0.5 * np.diff(ends**2)
    for node, slope in zip(nodes, G, strict=True):
        N = np.where(np.abs(middle - node) < 1.0, -np.sign(middle - node), 0.0)
        assert slope == pytest.approx(N @ area / area.sum(), abs=1e-13)


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"thickness": 2.0}, "thickness: must be left out"),
        (
            {"loads": [{"type": "gravity", "acceleration": [1, 0]}]},
            "loads.0.acceleration: must be 0 along x",
        ),
        (
            {"cracks": [{"name": "c", "points": [[-1, 2], [3, 2]]}]},
            "reaches beyond the axis, x = 0 (to x = -1 m)",
        ),
        ({"grid": {"cell": 0.7}, "boundary": []}, None),
        (
            {"grid": {"cell": 1, "lower": [-1.5, -2], "upper": [8.5, 6]}},
            "grid.lower: must have a line at x = 0",
        ),
    ],
)
def test_what_a_ring_can_not_be(changes, told):
    if told is None:
        build_deck(DISK, **changes)
        return
    with pytest.raises(DeckError) as mistakes:
        build_deck(DISK, **changes)
    assert told in str(mistakes.value)


def test_bodies_of_rings_lie_on_one_side_of_the_axis():
    body = {"name": "disk", "material": "m", "angular_velocity": 1.0}
    body["shape"] = {"type": "rectangle", "lower": [-2, 0], "upper": [6, 4]}
    with pytest.raises(DeckError) as mistakes:
        read(DISK, bodies=[body])
    assert "beyond the axis, x = 0 (to x = -2 m); cut it off there" in str(mistakes.value)
    assert "angular_velocity: must be 0" in str(mistakes.value)


def test_a_total_force_is_an_even_traction_over_the_rings():
    """10 N over the face of a disk: each ring takes its share of the area."""
    load = {"type": "force", "body": "disk", "where": {"y": 4}, "total": [0, 10]}
    model, state, _ = build_deck(DISK, loads=[load])
    force = model.conditions.forces[0]
    r = state.particles.origin[force.particles, 0]
    assert force.load[:, 1].sum() == pytest.approx(10.0)
    np.testing.assert_allclose(force.load[:, 1] / r, force.load[0, 1] / r[0], rtol=1e-12)


@pytest.mark.parametrize("where", [{"x": 6}, {"y": 4}])
def test_the_force_of_a_pressure_is_that_on_the_whole_face(where):
    """2 pi R H on the mantle, pi R^2 on the end."""
    load = {"type": "traction", "body": "disk", "where": where, "pressure": 3.0}
    model, _, _ = build_deck(DISK, loads=[load])
    wanted = 3.0 * (2 * np.pi * 6.0 * 4.0 if "x" in where else np.pi * 36.0)
    assert -sum(t.faces.force.sum() for t in model.conditions.tractions) == pytest.approx(wanted)


def test_threads_do_not_change_rings():
    """A bit for bit equal motion with two threads and with one."""
    body = {"name": "disk", "material": "m", "velocity": [0, -0.01]}
    body["shape"] = {"type": "rectangle", "lower": [0, 0], "upper": [60, 90]}
    ends = []
    for threads in (1, 2):
        model, state, _ = build_deck(DISK, bodies=[body])
        scratch = make_scratch(model, state, threads)
        assert scratch.team.size == threads
        advance(model, state, scratch, 20)
        ends.append(state.particles)
    for one, other in zip(*ends, strict=True):
        assert np.array_equal(one, other)
