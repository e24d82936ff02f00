"""A rigid motion put on top of a state opens and shears no face (docs/theory/cracks.md)."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from support import advance, build_deck, locate

from cramp_cli.cracks.cohesion import cohesive_energies
from cramp_cli.cracks.faces import lay_out_faces, spread
from cramp_cli.cracks.fields import (
    cut_of_points,
    find_openings,
    move_paths,
    what_surfaces_see,
)
from cramp_cli.cracks.openings import apart
from cramp_cli.cracks.rows import row_across

BLOCK = """
cramp: 1
analysis: plane_strain
thickness: 1
grid: {cell: 1, lower: [-10, -10], upper: [10, 10]}
materials: {m: {law: elastic, density: 1, E: 1, nu: 0.3}}
bodies: [{name: block, material: m, shape: {type: rectangle, lower: [-4, -3], upper: [4, 3]}}]
solver: {end_time: 1000, cfl: 0.3}
"""
THROUGH = {"name": "c", "points": [[-4.3, 0.2], [4.4, 0.6]], "start": "edge", "end": "edge"}
LEVEL = THROUGH | {"points": [[-4.3, 0.2], [4.4, 0.2]]}
INSIDE = {"name": "c", "points": [[-2.3, 0.2], [2.6, 0.5]]}
MODE = {"peak": 0.05, "toughness": 0.01}
TRACTIONS = [
    {"law": "triangular", "normal": MODE, "shear": MODE},
    {"law": "elastic", "normal": 0.2, "shear": 0.1},
    {"law": "pressure", "value": 0.02},
]
CONTACTS = [
    {"law": "frictional"},
    {"law": "frictional", "mu": 0.3},
    {"law": "stick"},
    {"law": "glued"},
    {"law": "ignore"},
]
angles = st.floats(0.0, 2.0 * np.pi)
ways = st.tuples(st.floats(-1.5, 1.5), st.floats(-1.5, 1.5))


def rotation(angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s], [s, c]])


def move_rigidly(state, Q, way):
    """Turn a whole state by Q about the origin, then move it."""
    p, paths, n = state.particles, state.paths, len(state.particles.mass)
    p.position[:] = p.position @ Q.T + way
    for vectors in (p.velocity, p.acceleration, paths.above_velocity, paths.below_velocity):
        vectors[:] = vectors @ Q.T
    p.F[:] = (Q @ p.F.reshape(n, 2, 2)).reshape(n, 4)
    p.L[:] = (Q @ p.L.reshape(n, 2, 2) @ Q.T).reshape(n, 4)
    xx, yy, _, xy = p.stress.T
    turned = Q @ np.array([[xx, xy], [xy, yy]]).transpose(2, 0, 1) @ Q.T
    p.stress[:, 0], p.stress[:, 1], p.stress[:, 3] = (
        turned[:, 0, 0],
        turned[:, 1, 1],
        turned[:, 0, 1],
    )
    for places in (paths.point, paths.above, paths.below):
        places[:] = places @ Q.T + way


def jumps(model, state, scratch):
    """Return how far the lower rows are apart from the upper ones, pair by pair (pairs, 2)."""
    rows, found = scratch.rows, []
    find_openings(model, state, scratch)
    for e in range(int(rows.count[0])):
        partner = row_across(rows, e, 0)
        row = len(rows.first) + e
        if partner >= 0 and rows.weight[row] > 0.0 and rows.weight[partner] > 0.0:
            a, b = (row, partner) if rows.side[e, 0] > 0 else (partner, row)
            found.append(apart(rows, a, b, model.strides)[0])
    return np.array(found)


@pytest.mark.parametrize("tips", ["sharp", "smooth"])
@settings(max_examples=25, deadline=None)
@given(angle=angles, way=ways)
def test_no_node_sees_an_opening_in_a_body_that_has_turned(tips, angle, way):
    """Wherever its particles are: to 1e-9 of a cell. Without the rotation it is up to a cell."""
    model, state, scratch = build_deck(BLOCK, cracks=[INSIDE], solver={"tips": tips})
    move_rigidly(state, rotation(angle), way)
    locate(model, state, scratch)
    found = jumps(model, state, scratch)
    assert len(found) > 5
    np.testing.assert_allclose(found, 0.0, atol=1e-9)


@settings(max_examples=25, deadline=None)
@given(angle=angles, way=ways, jump=st.tuples(st.floats(-0.2, 0.2), st.floats(0.0, 0.2)))
def test_every_node_sees_by_how_much_two_halves_have_parted(angle, way, jump):
    """A half that has moved by a vector, then both turned: the vector has turned with them."""
    model, state, scratch = build_deck(BLOCK, cracks=[LEVEL])
    state.particles.position[state.particles.position[:, 1] > 0.2] += jump
    Q = rotation(angle)
    move_rigidly(state, Q, way)
    locate(model, state, scratch)
    found = jumps(model, state, scratch)
    assert len(found) > 5
    np.testing.assert_allclose(found, np.tile(-Q @ jump, (len(found), 1)), atol=1e-9)


def with_grid(tips, angle, way, crack=INSIDE):
    """Return a turned block with the masses of its rows, and where the nodes of the rows are."""
    model, state, scratch = build_deck(BLOCK, cracks=[crack], solver={"tips": tips})
    move_rigidly(state, rotation(angle), way)
    locate(model, state, scratch)
    advance(model, state, scratch, 1)  # at rest: for the sums of its masses
    rows, count = scratch.rows, scratch.row_count
    node = np.arange(count)
    node[len(rows.first) :] = rows.node[: int(rows.count[0])]
    width = model.strides[1]
    place = np.stack([node % width, node // width], axis=1) + np.array(model.lattice.lower)
    return model, state, scratch, place


@pytest.mark.parametrize("tips", ["sharp", "smooth"])
@settings(max_examples=15, deadline=None)
@given(angle=angles, way=ways, spin=st.floats(-0.1, 0.1), centre=ways)
def test_both_surfaces_follow_a_rigid_motion_of_the_grid(tips, angle, way, spin, centre):
    """A crack that is closed stays so, and moves as the solid does."""
    model, state, scratch, place = with_grid(tips, angle, way)
    arm = place - centre
    scratch.grid.velocity[: len(place)] = spin * np.stack([-arm[:, 1], arm[:, 0]], axis=1)
    scratch.grid.acceleration[:] = 0.0
    paths = state.paths
    arm = paths.above - centre
    wanted = spin * np.stack([-arm[:, 1], arm[:, 0]], axis=1)
    move_paths(model, state, scratch)
    np.testing.assert_allclose(paths.above_velocity, wanted, atol=1e-9)
    np.testing.assert_allclose(paths.below_velocity, wanted, atol=1e-9)
    np.testing.assert_allclose(paths.above, paths.below, atol=1e-9)


@pytest.mark.parametrize("tips", ["sharp", "smooth"])
@settings(max_examples=15, deadline=None)
@given(angle=angles, way=ways, seed=st.integers(0, 1000))
def test_tractions_neither_push_nor_turn_the_body_and_work_on_the_surfaces(tips, angle, way, seed):
    """Forces of both faces on the rows: no sum, no moment, and the power of the surface points."""
    model, state, scratch, place = with_grid(tips, angle, way, INSIDE | {"traction": TRACTIONS[1]})
    chance, paths, count = np.random.default_rng(seed), state.paths, len(place)
    traction = chance.normal(size=paths.point.shape)
    paths.above_velocity[:] = paths.below_velocity[:] = 0.0
    scratch.grid.force[:] = scratch.grid.acceleration[:] = 0.0
    scratch.grid.velocity[:count] = chance.normal(size=(count, 2))
    faces, where = lay_out_faces(paths), what_surfaces_see(model, scratch)
    cut, mass = cut_of_points(model, paths, scratch.at_tips), scratch.grid.mass
    spread(scratch.grid.force, *scratch.seen, traction, paths, faces, cut, mass, *where, 1.0)
    force = scratch.grid.force[:count]
    assert np.abs(force).max() > 0.1
    np.testing.assert_allclose(force.sum(axis=0), 0.0, atol=1e-12)
    np.testing.assert_allclose(
        np.sum(place[:, 0] * force[:, 1] - place[:, 1] * force[:, 0]), 0.0, atol=1e-11
    )
    move_paths(replace(model, dt=1e-12), state, scratch)
    parting = paths.above_velocity - paths.below_velocity
    power = np.sum(force * scratch.grid.velocity[:count])
    assert power == pytest.approx(-np.sum(traction * parting * faces.length[:, None]), abs=1e-10)


def moving(quarters, tips, steps, **sections):
    """Return what matters of a block in motion after some steps, turned back by quarters of a turn.

    The lattice is its own image, so nothing but round-off may tell one quarter from another. The
    particles are moved a little, or they end at cell borders, and round-off decides what they see.
    """
    model, state, scratch = build_deck(BLOCK, solver={"tips": tips}, **sections)
    state.particles.position[:] += (0.013, -0.017)
    state.particles.origin[:] = state.particles.position
    x, y = state.particles.position.T
    v = 0.1 * np.stack([np.sin(0.7 * x + y) - 0.3 * y, np.cos(x) - 0.8 * np.tanh(y) + 0.3 * x], 1)
    state.particles.velocity[:] = v
    Q = np.round(rotation(0.5 * np.pi * quarters))
    move_rigidly(state, Q, (0.0, 0.0))
    advance(model, state, scratch, steps)
    order, paths = np.argsort(state.particles.id), state.paths
    return SimpleNamespace(
        position=state.particles.position[order] @ Q,
        velocity=state.particles.velocity[order] @ Q,
        opening=(paths.above - paths.below) @ Q,
        damage=paths.damage,
        energies=[*(float(b[0]) for b in state.books), *cohesive_energies(model, state)],
        touching=float(state.books.friction[0]),
        bonds=len(state.bonds),
    )


STEPS = 12
TWO = {
    "bodies": [
        {"name": n, "material": "m", "shape": {"type": "rectangle", "lower": low, "upper": up}}
        for n, low, up in (("low", [-4, -3], [4, 0]), ("high", [-4, 0], [4, 3]))
    ]
}
ADHESION = {"law": "adhesive", "strength": 0.03, "shear_strength": 0.02, "mu": 0.2}


def same(sections, quarters, tips):
    one, other = (moving(q, tips, STEPS, **sections) for q in (0, quarters))
    for name in ("position", "velocity", "opening", "damage", "energies"):
        first, second = getattr(one, name), getattr(other, name)
        np.testing.assert_allclose(second, first, atol=1e-9, err_msg=name)
    assert one.bonds == other.bonds
    return one


@pytest.mark.parametrize("tips", ["sharp", "smooth"])
@settings(max_examples=8, deadline=None)
@given(
    quarters=st.integers(1, 3),
    crack=st.sampled_from([INSIDE, THROUGH]),
    law=st.sampled_from(CONTACTS),
)
def test_contact_of_faces_does_not_ask_how_the_body_has_turned(tips, quarters, crack, law):
    same({"cracks": [crack | {"contact": law}]}, quarters, tips)


@pytest.mark.parametrize("law", TRACTIONS, ids=lambda law: law["law"])
@settings(max_examples=4, deadline=None)
@given(quarters=st.integers(1, 3), tips=st.sampled_from(["sharp", "smooth"]))
def test_traction_laws_do_not_ask_how_the_body_has_turned(law, quarters, tips):
    one = same({"cracks": [INSIDE | {"traction": law}]}, quarters, tips)
    assert np.abs(one.opening).max() > 1e-4


@pytest.mark.parametrize("quarters", [1, 2, 3])
def test_adhesion_does_not_ask_how_the_bodies_have_turned(quarters):
    one = same(TWO | {"contact": {"bodies": ADHESION}}, quarters, "smooth")
    assert one.bonds > 0
