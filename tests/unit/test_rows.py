"""Which row of a node a particle belongs to: never one with particles from across a crack."""

import numpy as np
import pytest
from support import build_deck, locate

from cramp_cli.build.model import SHAPES as KINDS
from cramp_cli.cracks.fields import find_openings
from cramp_cli.cracks.segments import make_segments
from cramp_cli.cracks.tip_nodes import cut_share
from cramp_cli.shapes.shape import offsets, place_of, weights
from cramp_cli.state.grid import make_grid
from cramp_cli.state.model import TipNodes
from cramp_cli.state.paths import PLAIN, make_paths
from cramp_cli.state.stencil import make_lists
from cramp_cli.transfer.sums import sum_mass_and_momentum

SQUARE = {
    "cramp": 1,
    "analysis": "plane_strain",
    "grid": {"cell": 1.0},
    "materials": {"m": {"law": "elastic", "density": 1.0, "E": 1.0, "nu": 0.3}},
    "bodies": [
        {
            "name": "square",
            "material": "m",
            "shape": {"type": "rectangle", "lower": [0, 0], "upper": [8, 8]},
        }
    ],
    "solver": {"end_time": 1.0},
}
SHAPES = pytest.mark.parametrize("shape", list(KINDS))
ON = 1e-9  # a point this near to a crack (cells) lies on it, that is below


def straight(*points, ends="edge"):
    return {"points": [list(map(float, p)) for p in points], "start": ends, "end": ends}


def sorted_out(cracks, shape="ugimp", moved=(0.0, 0.0), tips="sharp"):
    """Return model, state and scratch with all rows found, particles moved by some cells."""
    named = [{"name": f"c{n}", **crack} for n, crack in enumerate(cracks)]
    model, state, scratch = build_deck(SQUARE, cracks=named, solver={"shape": shape, "tips": tips})
    state.particles.position[:] += moved
    find_all(model, state, scratch)
    return model, state, scratch


def find_all(model, state, scratch):
    locate(model, state, scratch)
    sum_mass_and_momentum(model, state, scratch)
    find_openings(model, state, scratch)


def pairs(model, state, scratch):
    """Return particle, node and row of every pair with a weight above zero."""
    stencil, shape = scratch.stencil, model.blocks[0].shape
    steps, found = offsets(model.strides, shape), []
    spots = (stencil.base, stencil.near)
    for p, (base, line) in enumerate(zip(*spots, strict=True)):
        S = weights(place_of(shape, model.strides, stencil, p), shape)
        places = range(len(steps)) if line < 0 else stencil.which[line, : stencil.entries[line]]
        for e, k in enumerate(places):
            if S[k] > 0.0:
                node = int(base) + steps[k]
                found.append((p, node, node if line < 0 else int(stencil.table[line, e])))
    return found


def key(scratch, row):
    """Return the cracks that lie between a row's particles and its node."""
    e = row - len(scratch.rows.first)
    return () if e < 0 else tuple(int(c) for c in scratch.rows.crack[e] if c >= 0)


def left_of(places, start, end):
    """Return which places lie above a straight crack; those on it do not."""
    (x, y), (ex, ey) = (
        (places - start).T,
        np.subtract(end, start) / np.hypot(*np.subtract(end, start)),
    )
    return ex * y - ey * x > ON


def assert_sorted_by_straight_cracks(model, state, scratch, cracks):
    """Every pair has the row of exactly those cracks on whose two sides its ends lie.

    For cracks from edge to edge this is the definition of a velocity field (Nairn 2003).
    """
    here, there = state.particles.position, model.lattice.node_positions()
    ends = [(crack["points"][0], crack["points"][-1]) for crack in cracks]
    particle_side = np.array([left_of(here, *e) for e in ends])
    node_side = np.array([left_of(there, *e) for e in ends])
    rows = scratch.rows
    for p, node, row in pairs(model, state, scratch):
        wanted = tuple(np.flatnonzero(particle_side[:, p] != node_side[:, node]).tolist())
        assert key(scratch, row) == wanted, f"particle {here[p]}, node {there[node]}"
        if wanted:
            e = row - len(rows.first)
            assert rows.node[e] == node
            sides = [1 if particle_side[c, p] else -1 for c in wanted]
            assert rows.side[e, : len(wanted)].tolist() == sides
    assert rows.count[2] == rows.count[3] == 0


ONE = {
    "on a row of nodes": straight((-1, 4), (9, 4)),
    "on a row of nodes, backwards": straight((9, 4), (-1, 4)),
    "on a column of nodes": straight((4, -1), (4, 9)),
    "through particles": straight((-1, 3.75), (9, 3.75)),
    "between particles": straight((-1, 3.5), (9, 3.5)),
    "at 45 degrees through nodes and particles": straight((-1, -1), (9, 9)),
    "down at 45 degrees through nodes": straight((-1, 9), (9, -1)),
    "down at 45 degrees through particles": straight((-1, 8.5), (8.5, -1)),
    "at an angle of 1 to 2 through nodes": straight((-2, 1), (10, 7)),
    "anyhow": straight((-1, 2.137), (9, 5.713)),
}


MOVED = pytest.mark.parametrize("moved", [(0.0, 0.0), (0.05, 0.0), (-0.05, 0.03), (0.25, 0.25)])


@SHAPES
@MOVED
@pytest.mark.parametrize("crack", ONE.values(), ids=ONE.keys())
def test_no_row_has_particles_of_both_sides_of_a_crack(crack, moved, shape):
    assert_sorted_by_straight_cracks(*sorted_out([crack], shape, moved), [crack])


@SHAPES
@pytest.mark.parametrize("at", [(4.0, 4.0), (3.75, 3.75), (3.6, 4.2)])
@pytest.mark.parametrize("slope", [(1.0, 0.0), (1.0, 1.0), (2.0, 1.0)])
def test_two_crossing_cracks_make_four_rows(at, slope, shape):
    """Where two cracks cross, four pieces meet: none, one, the other, both cracks between."""
    along, across = np.array(slope), np.array([-slope[1], slope[0]])
    half = 7 / np.hypot(*slope)  # just beyond the body
    cracks = [straight(at - half * v, at + half * v) for v in (along, across)]
    model, state, scratch = sorted_out(cracks, shape)
    assert_sorted_by_straight_cracks(model, state, scratch, cracks)
    kinds = {}
    for _, node, row in pairs(model, state, scratch):
        kinds.setdefault(node, set()).add(key(scratch, row))
    assert max(map(len, kinds.values())) == 4


BENT = {
    "left at a node": [(-1, 4), (4, 4), (8.5, 8.5)],
    "right at a node": [(-1, 4), (4, 4), (8.5, -0.5)],
    "left at a particle": [(-1, 3.75), (3.75, 3.75), (8.5, 8.5)],
    "right at a particle": [(-1, 3.75), (3.75, 3.75), (7.75, -0.25)],
    "anywhere": [(-1, 3.3), (4.4, 4.1), (5.2, 9)],
    "up and on": [(-1, 3), (4, 3), (4, 5), (9, 5)],
}


@SHAPES
@pytest.mark.parametrize("corners", BENT.values(), ids=BENT.keys())
def test_no_row_has_particles_of_both_sides_of_a_bent_crack(corners, shape):
    """Bends on nodes, on particles and anywhere: a bend hides no node from either side."""
    model, state, scratch = sorted_out([straight(*corners)], shape)
    line = np.array(corners, dtype=float)
    above = np.array([_above(line, x) for x in state.particles.position])
    sides = {}
    for p, _, row in pairs(model, state, scratch):
        sides.setdefault(row, set()).add(bool(above[p]))
    assert [row for row, both in sides.items() if len(both) > 1] == []
    assert scratch.rows.count[2] == 0


def _above(line, point):
    """Return whether a point is left of a bent line that crosses the body; on it is below.

    Left of the nearest piece; at a bend of the one whose line is farther away.
    """
    a, b = line[:-1], line[1:]
    unit = (b - a) / np.hypot(*(b - a).T)[:, None]
    reach = np.clip(np.sum((point - a) * unit, axis=1), 0.0, np.hypot(*(b - a).T))
    away = np.hypot(*(point - a - reach[:, None] * unit).T)
    height = unit[:, 0] * (point - a)[:, 1] - unit[:, 1] * (point - a)[:, 0]
    nearest = away <= away.min() + ON
    return height[nearest][np.argmax(np.abs(height[nearest]))] > ON


@SHAPES
@pytest.mark.parametrize("at", [(4.0, 4.0), (4.1, 3.8)])
def test_three_cracks_that_meet_part_three_pieces(at, shape):
    """Three cracks with a common point: no row has particles of two of the three pieces.

    A line through the common point itself, which wide shape functions have, may cross any of them.
    """
    angles = np.radians([90.0, 210.0, 330.0])
    rays = [np.array([np.cos(a), np.sin(a)]) for a in angles]
    cracks = [
        {"points": [list(at), (at + 7 * ray).tolist()], "start": "plain", "end": "edge"}
        for ray in rays
    ]
    model, state, scratch = sorted_out(cracks, shape)
    away = state.particles.position - at
    piece = np.floor((np.degrees(np.arctan2(away[:, 1], away[:, 0])) - 90.0) % 360.0 / 120.0)
    seen = {}
    nodes = model.lattice.node_positions() - at
    for p, node, row in pairs(model, state, scratch):
        beside = min(abs(away[p, 0] * ray[1] - away[p, 1] * ray[0]) for ray in rays) > ON
        through = abs(away[p, 0] * nodes[node, 1] - away[p, 1] * nodes[node, 0]) <= ON
        if beside and not (through and away[p] @ nodes[node] < 0.0):
            seen.setdefault(row, set()).add(int(piece[p]))
    assert [row for row, pieces in seen.items() if len(pieces) > 1] == []


def test_a_third_crack_is_counted():
    """Rows know two cracks; a way across a third is counted, for the log to tell."""
    cracks = [straight((-1, y), (9, y)) for y in (4.3, 4.45, 4.6)]
    _, _, scratch = sorted_out(cracks)
    assert scratch.rows.count[3] > 0


@pytest.mark.parametrize("seed", range(3))
def test_the_order_of_particles_does_not_matter(seed):
    """Sums per node and cracks crossed are the same, but for the order in which they add up."""
    cracks = [straight((-1, 4), (9, 4)), straight((4.1, -1), (3.3, 9))]
    model, state, scratch = sorted_out(cracks)
    wanted = _sums(model, state, scratch)
    order = np.random.default_rng(seed).permutation(len(state.particles.mass))
    state.particles = type(state.particles)(*(array[order] for array in state.particles))
    find_all(model, state, scratch)
    got = _sums(model, state, scratch)
    assert got.keys() == wanted.keys()
    for name, sums in wanted.items():
        np.testing.assert_allclose(got[name], sums, rtol=1e-14, atol=1e-14, err_msg=str(name))


def _sums(model, state, scratch):
    """Return mass, place and normal directions of the rows, by node and cracks crossed."""
    rows, found = scratch.rows, {}
    for _, node, row in pairs(model, state, scratch):
        place, normal = (0.0, 0.0), (0.0,) * 4
        if rows.first[node] >= 0:
            place = rows.place[row]
        if row >= len(rows.first):
            normal = rows.normal[row - len(rows.first)].ravel()
        found[node, key(scratch, row)] = (scratch.grid.mass[row], *place, *normal)
    return found


@pytest.mark.parametrize(("start", "end", "normal"), [
    ((-1, 4), (9, 4), (0.0, -1.0)),
    ((9, 4), (-1, 4), (0.0, 1.0)),
    ((4, -1), (4, 9), (1.0, 0.0)),
    ((-1, -1), (9, 9), (0.5**0.5, -(0.5**0.5))),
])  # fmt: skip
def test_normals_point_from_above_to_below(start, end, normal):
    """From the left of the crack to its right."""
    _, _, scratch = sorted_out([straight(start, end)])
    normals = scratch.rows.normal[: scratch.rows.count[0], 0]
    np.testing.assert_allclose(
        normals / np.hypot(*normals.T)[:, None], np.tile(normal, (len(normals), 1)), atol=1e-15
    )


def test_ahead_of_a_tip_there_is_one_row():
    """No way crosses the crack, so the solid is whole there."""
    _, _, scratch = sorted_out([straight((-1, 4), (4.3, 4), ends="plain")])
    nodes = scratch.rows.node[: scratch.rows.count[0]] % 17  # 8 cells and 4 on either side
    assert nodes.max() * 1.0 - 4.0 < 4.3 + 1.25  # a particle reaches 1.25 cells past its centre


def test_room_for_rows_grows_with_the_cracks():
    """Arrays that are too short are made longer, and nothing is lost."""
    crack = straight((-1, 4), (9, 4))
    model, state, scratch = sorted_out([crack])
    scratch.stencil = scratch.stencil._replace(**make_lists(9, 2, 3))
    scratch.grid, scratch.rows = make_grid(model.lattice.node_count, 2, 5)
    scratch.segments = make_segments(model.lattice.node_count, 20, 7)
    find_all(model, state, scratch)
    assert_sorted_by_straight_cracks(model, state, scratch, [crack])


@SHAPES
@pytest.mark.parametrize("tip", [4.0, 4.3, 4.45, 4.9])
@pytest.mark.parametrize("height", [4.0, 3.75, 3.6])
def test_part_cut_particles_give_their_whole_weight(tip, height, shape):
    """cracks/tip_nodes.py: shares of a pair add up to 1; rows of a side hold that side."""
    crack = straight((-1, height), (tip, height)) | {"end": "tip"}
    model, state, scratch = sorted_out([crack], shape, tips="smooth")
    stencil, rows = scratch.stencil, scratch.rows
    shares = [s for n, s in zip(stencil.entries, stencil.share, strict=True) for s in s[:n]]
    assert 0.0 < min(shares) < 1.0
    for line in range(stencil.count[0]):
        n = stencil.entries[line]
        which, share, bend = (a[line, :n] for a in (stencil.which, stencil.share, stencil.bend))
        sums = np.bincount(which, share)[np.unique(which)]  # cpdi lists the nodes it touches
        np.testing.assert_allclose(sums, 1.0, rtol=1e-15)
        for along in bend.T:
            assert not np.bincount(which, along).any()
    count = scratch.row_count
    assert scratch.grid.mass[:count].sum() == pytest.approx(state.particles.mass.sum(), rel=1e-14)
    behind = state.particles.position[:, 0] < tip - 1.6
    for p, _, row in pairs(model, state, scratch):
        if row >= len(rows.first) and behind[p]:  # wholly cut
            above = state.particles.position[p, 1] > height + ON
            assert rows.side[row - len(rows.first), 0] == (1 if above else -1)


@pytest.mark.parametrize("ramp", [0.5, 1.5])
@pytest.mark.parametrize("half", [0.5, 0.25])
def test_the_cut_share_rises_behind_a_tip(half, ramp):
    """From 0 to 1; its gradient is the difference of shares, but for bends of their slope.

    The crack ends at 4.3, the share of a centre begins to rise 0.1 cells ahead of it.
    """
    line = np.array([[0.0, 4.0], [2.0, 4.0], [4.3, 4.0]])
    paths = make_paths([line], [(PLAIN, PLAIN)], [0], [(-1, 0)], 2)

    def share(x):
        return cut_share(paths, 1, x, 4.2, (half, half), 1.0, TipNodes(0.1 + half, ramp))

    begin, step = 4.4 + half, 1e-5
    assert share(begin) == (0.0, 0.0, 0.0)
    assert share(begin - ramp - 2 * half) == pytest.approx((1.0, 0.0, 0.0), abs=1e-14)
    places = np.linspace(begin - ramp - 2 * half, begin, 24)[1:-1]
    shares = [share(x)[0] for x in places]
    assert np.all(np.diff(shares) < 0.0)
    for x in places:
        slope = (share(x + step)[0] - share(x - step)[0]) / (2 * step)
        assert share(x)[1] == pytest.approx(slope, abs=step / (ramp * half))
