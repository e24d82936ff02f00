"""Contact between bodies: rows, normals, separation, laws, rigid bodies, what a deck may say."""

import hashlib

import numpy as np
import pytest
from support import advance, build_deck, locate, read

from cramp_cli.contact.bodies import find_pairs
from cramp_cli.contact.outline import beside_corner, make_outlines, nearest_piece
from cramp_cli.contact.pairs import group_of
from cramp_cli.cracks.contact import OPEN
from cramp_cli.numerics import team
from cramp_cli.output.checkpoint import read_state, write_state
from cramp_cli.schema.mistake import DeckError
from cramp_cli.scratch import make_scratch
from cramp_cli.state.measures import sum_energies
from cramp_cli.transfer.sums import sum_mass_and_momentum

MATERIALS = {"m": {"law": "elastic", "density": 1.0, "E": 1.0, "nu": 0.3}}


def box(name, x, y, **more):
    shape = {"type": "rectangle", "lower": [x[0], y[0]], "upper": [x[1], y[1]]}
    made = {} if "rigid" in more else {"material": "m"}
    return {"name": name, "shape": shape} | made | more


def deck(*bodies, contact=None, **more):
    return {
        "cramp": 1,
        "analysis": "plane_strain",
        "grid": {"cell": 1.0},
        "materials": MATERIALS,
        "bodies": list(bodies),
        "contact": {"bodies": {"law": "frictional"}} if contact is None else contact,
        "solver": {"end_time": 1000.0},
    } | more


def met(*bodies, **more):
    """Return model, state, scratch with all rows and pairs of bodies found."""
    model, state, scratch = build_deck(deck(*bodies, **more))
    locate(model, state, scratch)
    find_pairs(model, state, scratch)
    return model, state, scratch


def pairs_of(scratch):
    pairs = scratch.meeting.pairs
    return type(pairs)(*(array[: pairs.used[0]] for array in pairs))


LEFT, RIGHT = box("left", (0, 4), (0, 6)), box("right", (4, 8), (0, 6))


def test_a_body_has_rows_of_its_own_where_another_is_near():
    model, state, scratch = met(LEFT, RIGHT)
    sum_mass_and_momentum(model, state, scratch)
    rows, mass = scratch.rows, scratch.grid.mass[: scratch.row_count]
    groups = np.array([group_of(rows, row) for row in range(scratch.row_count)])
    seen = rows.highest[: len(rows.first)] >= 0
    for group in (0, 1):
        mine = state.particles.body == group
        held = mass[groups == group].sum()
        assert held == pytest.approx(state.particles.mass[mine].sum(), rel=1e-14)
    assert seen.any()


@pytest.mark.parametrize("normal", ["logistic", "average", "larger"])
def test_flat_faces_have_their_normal_and_gap(normal):
    moved = box("right", (4.5, 8.5), (0, 6))
    contact = {"bodies": {"law": "frictional"}, "normal": normal}
    model, _, scratch = met(LEFT, moved, contact=contact)
    pairs, y = pairs_of(scratch), model.lattice.node_positions()[:, 1]
    inner = np.abs(y[pairs.node] - 3.0) < (3.5 if normal == "logistic" else 0.5)
    assert inner.sum() >= (7 if normal == "logistic" else 1)  # gradients feel the corners
    np.testing.assert_allclose(pairs.normal[inner, 0], 1.0)
    np.testing.assert_allclose(pairs.gap[inner], 0.5, atol=2e-9)  # flush bodies touch: 1e-9 cells


def test_round_off_does_not_part_flush_faces():
    """Before, the gap was -1e-18 or 0 as round-off would have it, and some nodes touched later."""
    for n in range(1, 12):
        a, b = box("left", (n - 4, n), (0, 6)), box("right", (n, n + 4), (0, 6))
        for one in (a, b):
            shape = one["shape"]
            shape |= {key: [0.1 * x for x in shape[key]] for key in ("lower", "upper")}
        *_, scratch = met(a, b, grid={"cell": 0.1})
        assert (pairs_of(scratch).gap < 0.0).all()


PLATE = [[(0, 0), (4, 0), (4, 0.5), (0, 0.5), (0, 0)]]


def test_the_outline_of_a_body_has_corners_and_sides():
    outlines = make_outlines([[], PLATE])
    assert outlines.first.tolist() == [0, 0, 4]
    assert outlines.corner.tolist() == [1, 1, 1, 1]
    assert beside_corner(outlines, 1, 3.5, 0.5, 0.6)
    assert not beside_corner(outlines, 1, 3.0, 0.5, 0.6)
    t = np.linspace(0.0, 2.0 * np.pi, 65)
    assert not make_outlines([[np.stack([np.cos(t), np.sin(t)], axis=1)]]).corner.any()


@pytest.mark.parametrize("below", [-0.3, 0.4, 0.9])
def test_a_thin_plate_has_the_normal_of_the_side_that_is_touched(below):
    """A body above it; a node above the plate, in its lower half, and below it."""
    outlines = make_outlines([[], PLATE])
    found, along = nearest_piece(outlines, 1, 2.0, 0.5 - below, 3.0, 0.51)
    assert (found, along) == (2, 2.0)


@pytest.mark.parametrize("wall_first", [True, False])
def test_normals_beside_a_rigid_body_are_of_its_outline(wall_first):
    """All of them, on an inclined plane that has moved; the other body has a face of steps."""
    n, t = np.array([0.8, 0.6]), np.array([-0.6, 0.8])

    def strip(name, low, high, end, **more):
        corners = [(low, -end), (high, -end), (high, end), (low, end)]
        points = [(a * n + b * t).tolist() for a, b in corners]
        return {"name": name, "shape": {"type": "polygon", "points": points}} | more

    wall = strip("wall", -4.0, 0.0, 9.0, rigid={"velocity": [0.01, 0.0]})
    body = strip("body", 0.05, 4.0, 3.0, material="m")
    scene = deck(*((wall, body) if wall_first else (body, wall)), grid=GRID)
    model, state, scratch = build_deck(scene)
    advance(model, state, scratch, 100)
    pairs, sign = pairs_of(scratch), 1.0 if wall_first else -1.0
    assert len(pairs.normal) > 10
    np.testing.assert_allclose(pairs.normal, np.tile(sign * n, (len(pairs.normal), 1)), atol=1e-12)


def test_holes_and_later_bodies_are_no_part_of_an_outline():
    wall = box("wall", (0, 9), (0, 9), rigid={})
    hole = {"name": "hole", "hole": True, "shape": box("", (6, 9), (0, 9))["shape"]}
    near = box("near", (-4, 0), (0, 6))
    outlines = build_deck(deck(near, wall, hole, grid=GRID))[0].between_bodies.outlines
    assert outlines.start.max(axis=0).tolist() == [6.0, 9.0]


def turned_boxes(angle, contact):
    """Return two bodies that share a plane through the origin whose normal has an angle."""
    n, t = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])

    def strip(name, low, high):
        corners = [(low, -6.0), (high, -6.0), (high, 6.0), (low, 6.0)]
        points = [(a * n + b * t).tolist() for a, b in corners]
        return {"name": name, "material": "m", "shape": {"type": "polygon", "points": points}}

    return met(strip("a", -4.0, 0.0), strip("b", 0.0, 4.0), contact=contact), n, t


# Largest angle between normal and that of the plane (rad), 3 cells and more from its ends, where
# no window of a node sees them: measured 0.045, 0.004, 0.005. Nearer to them it is up to 0.136.
FARTHEST = {"logistic": 0.06, "average": 0.01, "larger": 0.01}
BESIDE_ENDS = 0.15
APART = 0.06  # cells; the bodies touch: measured up to 0.048


@pytest.mark.parametrize("normal", FARTHEST)
@pytest.mark.parametrize("degrees", [10.0, 30.0, 45.0, 77.0])
def test_normals_of_an_inclined_plane(normal, degrees):
    contact = {"bodies": {"law": "frictional"}, "normal": normal}
    (model, _, scratch), n, t = turned_boxes(np.radians(degrees), contact)
    pairs, place = pairs_of(scratch), model.lattice.node_positions()
    along = np.abs(place[pairs.node] @ t)
    off = np.arccos(np.clip(pairs.normal @ n, -1.0, 1.0))
    assert off[along < 3.0].max() < FARTHEST[normal]
    assert off[along < 4.0].max() < BESIDE_ENDS
    assert np.abs(pairs.gap[along < 4.0]).max() < APART * model.lattice.width


def flight(*bodies, steps=400, **more):
    """Return the state before and after a flight of bodies, and momentum over its size."""
    model, state, scratch = build_deck(deck(*bodies, **more))
    p = state.particles
    before, size = p.mass @ p.velocity, float(p.mass @ np.hypot(*p.velocity.T))
    energy = sum(sum_energies(p))
    touched = 0
    for _ in range(steps):
        advance(model, state, scratch, 1)
        touched += bool((pairs_of(scratch).state != OPEN).any())
    drift = np.abs(p.mass @ p.velocity - before).max() / size
    return state, touched, drift, sum(sum_energies(p)) / energy


GRID = {"lower": [-20, -20], "upper": [30, 30], "cell": 1.0}
THREE = (
    box("left", (0, 4), (0, 6), velocity=[0.02, 0.0]),
    box("right", (4.5, 8.5), (0, 6), velocity=[-0.02, 0.0]),
    box("top", (0.3, 8.2), (6.5, 10), velocity=[0.005, -0.03]),
)


@pytest.mark.parametrize("law", ["frictional", "stick", "glued"])
@pytest.mark.parametrize("normal", ["logistic", "average", "larger"])
def test_three_bodies_at_a_node_keep_their_momentum(law, normal):
    contact = {"bodies": {"law": law}, "normal": normal}
    _, touched, drift, energy = flight(*THREE, contact=contact, grid=GRID)
    assert touched > 20
    assert drift < 1e-13
    assert energy < 1.0 or law != "glued"  # others: docs/theory/contact.md, limits


def test_body_contact_beside_a_crack():
    """Two plates collide; the crack of one ends on the surface that they share."""
    bodies = (
        box("left", (0, 6), (0, 8), velocity=[0.02, 0.0]),
        box("right", (6.5, 12.5), (0, 8), velocity=[-0.02, 0.003]),
    )
    crack = {"name": "c", "points": [[2.2, 4.5], [6, 4.5]], "end": "edge"}
    model, state, scratch = build_deck(deck(*bodies, cracks=[crack], grid=GRID))
    p, sides = state.particles, set()
    before = p.mass @ p.velocity
    for _ in range(300):
        advance(model, state, scratch, 1)
        pairs, nodes = pairs_of(scratch), len(scratch.rows.first)
        for row, state_of in zip(pairs.row, pairs.state, strict=True):
            crossing = [r for r in row if r >= nodes and scratch.rows.crack[r - nodes, 0] == 0]
            sides |= {int(scratch.rows.side[r - nodes, 0]) for r in crossing if state_of != OPEN}
    assert sides == {-1, 1}  # rows behind the crack, on both of its sides, touch the other body
    size = float(p.mass @ np.hypot(*p.velocity.T))
    assert np.abs(p.mass @ p.velocity - before).max() < 1e-13 * size
    right = scratch.rows.group[: scratch.rows.count[0]] == 1
    assert (scratch.rows.crack[: scratch.rows.count[0]][right] == -1).all()


def test_glued_bodies_are_one_solid():
    bodies = (box("left", (0, 4), (0, 6), velocity=[0.02, 0.01]), box("right", (4, 8), (0, 6)))
    runs = []
    for contact in ({}, {"bodies": {"law": "glued"}}):
        model, state, scratch = build_deck(deck(*bodies, contact=contact, grid=GRID))
        advance(model, state, scratch, 200)
        runs.append(state.particles)
    stress = np.abs(runs[0].stress).max()
    assert np.abs(runs[0].stress - runs[1].stress).max() < 1e-12 * stress


def test_bodies_of_a_group_stay_one_solid():
    parts = [box("a", (0, 4), (0, 6)), box("b", (4, 8), (0, 6)), box("c", (9, 12), (0, 6))]
    contact = {"bodies": {"law": "frictional"}, "groups": [["a", "b"]]}
    model, _, scratch = met(*parts, contact=contact)
    assert model.groups.of_body.tolist() == [0, 0, 1]
    assert model.between_bodies.names == ("a", "c")
    assert set(map(tuple, pairs_of(scratch).group.tolist())) <= {(0, 1)}


def test_pairs_have_laws_of_their_own():
    parts = [box("a", (0, 4), (0, 6)), box("b", (4, 8), (0, 6)), box("c", (8, 12), (0, 6))]
    pair = {"bodies": ["b", "a"], "contact": {"law": "frictional", "mu": 0.3}}
    contact = {"bodies": {"law": "ignore"}, "pairs": [pair]}
    model, _, scratch = met(*parts, contact=contact)
    laws = model.between_bodies.laws
    assert laws.mu[0, 1] == laws.mu[1, 0] == 0.3
    assert set(map(tuple, pairs_of(scratch).group.tolist())) == {(0, 1)}


WALL = box("wall", (4, 6), (-2, 8), rigid={"velocity": [-0.01, 0.0]})


def test_a_rigid_body_moves_as_it_must_and_pushes_the_other():
    model, state, scratch = build_deck(deck(LEFT, WALL, grid=GRID))
    p, start = state.particles, sum(sum_energies(state.particles))
    given = np.zeros(2)
    for _ in range(300):
        advance(model, state, scratch, 1)
        given += state.contact_forces[0] * model.dt
    wall = p.body == 1
    way = (p.position - p.origin)[wall]
    np.testing.assert_allclose(way, np.tile([-0.01 * state.time, 0.0], (wall.sum(), 1)), atol=1e-12)
    assert not p.stress[wall].any()
    np.testing.assert_allclose(p.mass @ p.velocity, given, rtol=1e-12, atol=1e-14)
    np.testing.assert_allclose(state.contact_forces.sum(axis=0), 0.0, atol=1e-15)
    gained = sum(sum_energies(p)) - start
    work = float(state.books.external[0])
    assert 0.9 * work < gained < work  # measured 0.92: four cells that an impact goes through


def test_a_rigid_wedge_opens_a_crack():
    """Its particles see no crack: they touch the faces on both sides."""
    plate = box("plate", (0, 12), (0, 8))
    points = [[-3, 3.4], [1.5, 4.0], [-3, 4.6]]
    wedge = {
        "name": "wedge",
        "rigid": {"velocity": [0.02, 0]},
        "shape": {"type": "polygon", "points": points},
    }
    crack = {"name": "c", "points": [[0, 4], [6.3, 4]], "start": "edge"}
    model, state, scratch = build_deck(deck(plate, wedge, cracks=[crack], grid=GRID))
    given, widest = np.zeros(2), 0.0
    for _ in range(300):
        advance(model, state, scratch, 1)
        given += state.contact_forces[1] * model.dt
        widest = max(widest, float((state.paths.above - state.paths.below)[0, 1]))
    assert widest > 0.2  # the wedge is 0.9 thick where it has come to
    assert given[0] < 0.0  # it is pushed back
    assert abs(given[1]) < 0.2 * abs(given[0])  # and hardly to a side


def bits(state):
    digest = hashlib.sha256()
    for array in (*state.particles, *state.paths, *state.books, state.contact_forces):
        digest.update(np.ascontiguousarray(array).tobytes())
    return digest.hexdigest()


SCENE = {
    "contact": {"bodies": {"law": "frictional", "mu": 0.3}},
    "cracks": [{"name": "c", "points": [[2.2, 3.1], [4, 3.1]], "end": "edge"}],
    "grid": GRID,
}


def test_threads_do_not_change_a_bit(monkeypatch):
    monkeypatch.setattr(team, "LEAST", 1)
    found = set()
    for threads in (1, 2, 4):
        model, state, _ = build_deck(deck(*THREE, WALL | {"shape": TOUCHING}, **SCENE))
        advance(model, state, make_scratch(model, state, threads), 80)
        found.add(bits(state))
    assert len(found) == 1


TOUCHING = {"type": "rectangle", "lower": [9, -2], "upper": [11, 8]}


def test_a_checkpoint_goes_on_to_the_same_bits(tmp_path):
    scene = deck(*THREE, WALL | {"shape": TOUCHING}, **SCENE)
    model, state, scratch = build_deck(scene)
    advance(model, state, scratch, 50)
    write_state(tmp_path / "a.h5", state, {})
    back = read_state(tmp_path / "a.h5", build_deck(scene)[1]).state
    for one in (state, back):
        advance(model, one, make_scratch(model, one), 40)
    assert bits(state) == bits(back)
    assert state.books.friction[0] > 0.0


HOLE = {"name": "hole", "hole": True, "shape": {"type": "disk", "center": [2, 3], "radius": 1}}
ON = {"bodies": {"law": "frictional"}}
WRONG = {
    "contact.groups.0.1: unknown body 'rihgt'; did you mean 'right'?": (
        [LEFT, RIGHT],
        {"contact": ON | {"groups": [["left", "rihgt"]]}},
    ),
    "contact.pairs.0.bodies.0: unknown body 'hole'": (
        [LEFT, RIGHT, HOLE],
        {"contact": ON | {"pairs": [{"bodies": ["hole", "left"], "contact": {"law": "stick"}}]}},
    ),
    "contact.pairs.0.bodies: are one solid": (
        [LEFT, RIGHT],
        {
            "contact": ON
            | {
                "groups": [["left", "right"]],
                "pairs": [{"bodies": ["right", "left"], "contact": {"law": "stick"}}],
            }
        },
    ),
    "contact.groups: goes with bodies": ([LEFT, RIGHT], {"contact": {"groups": [["left"]]}}),
    "bodies.wall.rigid: acts by contact only": ([LEFT, WALL], {"contact": {}}),
    "contact.groups.0.0: 'wall' is rigid": (
        [LEFT, WALL],
        {"contact": ON | {"groups": [["wall", "left"]]}},
    ),
    "bodies.wall.velocity: does not go with rigid": ([LEFT, WALL | {"velocity": [1.0, 0.0]}], {}),
    "loads.0.body: 'wall' is rigid": (
        [LEFT, WALL],
        {"loads": [{"type": "force", "body": "wall", "where": {"x": 4}, "total": [1, 0]}]},
    ),
    "cracks.c: runs through left and right": (
        [LEFT, RIGHT],
        {"cracks": [{"name": "c", "points": [[1, 3], [7, 3]]}]},
    ),
    "bodies: are all rigid": ([WALL], {}),
    "bodies.hole.rigid: does not go with hole": ([LEFT, HOLE | {"rigid": {}}], {}),
}


def test_a_resolved_deck_with_contact_reads_back():
    pair = {"bodies": ["left", "wall"], "contact": {"law": "stick"}}
    contact = ON | {"groups": [["left", "top"]], "pairs": [pair], "normal": "average"}
    first = read(deck(LEFT, box("top", (0, 4), (6, 8)), WALL, contact=contact))
    assert read(first.resolved()).model_dump() == first.model_dump()


@pytest.mark.parametrize("message", WRONG)
def test_mistakes_of_a_deck(message):
    bodies, more = WRONG[message]
    with pytest.raises(DeckError) as failure:
        read(deck(*bodies, **more))
    assert message in str(failure.value)
