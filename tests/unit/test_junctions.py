"""Cracks that branch and join: sectors are told apart however the deck writes the arms."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from support import advance, build_deck
from test_rows import SQUARE, pairs, sorted_out

from cramp_cli.cracks.branches import left_of_arm
from cramp_cli.cracks.room import find_room, through_joints
from cramp_cli.cracks.tips import tips_of
from cramp_cli.state.paths import PLAIN, TIP

CLEAR = 1e-6  # cells; particles nearer to an arm than this are not asked for their sector
BEYOND = (-2.0, 10.0)  # where arms end, beyond the body of 8 by 8 cells (m)
PLACES = st.one_of(
    st.sampled_from([(4.0, 4.0), (3.75, 3.75), (4.0, 3.75), (4.5, 4.25), (4.0, 4.0 + 1e-8)]),
    st.tuples(st.floats(3.0, 5.0), st.floats(3.0, 5.0)),
)


@st.composite
def stars(draw, fewest=2, most=5):
    """Return a place, the angles of arms (degrees, ascending) and cracks that make the star."""
    place, count = draw(PLACES), draw(st.integers(fewest, most))
    grid = draw(st.booleans())
    gaps = [draw(st.integers(6, 12) if grid else st.floats(30.0, 80.0)) for _ in range(count)]
    turns = np.cumsum(gaps) / sum(gaps) * 360.0
    if grid:  # along grid lines and diagonals
        turns = np.array(sorted(draw(st.permutations(range(0, 360, 45)))[:count]), dtype=float)
    ends = [_end(place, angle) for angle in turns]
    order = draw(st.permutations(range(count)))
    through = draw(st.integers(0, count // 2))
    lines = [[ends[order[2 * k]], place, ends[order[2 * k + 1]]] for k in range(through)]
    lines += [[place, ends[k]] for k in order[2 * through :]]
    lines = [line[::-1] if draw(st.booleans()) else line for line in lines]
    return place, turns, lines


def _end(place, angle):
    way, low, high = _unit(angle), *BEYOND
    far = min(
        ((high if w > 0.0 else low) - x) / w for x, w in zip(place, way, strict=True) if w != 0.0
    )
    return (place[0] + far * way[0], place[1] + far * way[1])


def _unit(angle):
    """Return the unit vector at an angle (degrees), exact along grid lines."""
    x, y = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    return np.array([0.0 if abs(x) < 1e-12 else x, 0.0 if abs(y) < 1e-12 else y])


def cracks_along(lines):
    return [{"points": [list(map(float, p)) for p in line]} for line in lines]


def sector_of(places, centre, angles):
    """Return the number of the sector of every place (n, 2), and which are clear of the arms."""
    away = places - np.asarray(centre)
    turned = np.degrees(np.arctan2(away[:, 1], away[:, 0])) % 360.0
    sector = np.searchsorted(angles, turned) % len(angles)
    clear = np.ones(len(places), dtype=bool)
    for angle in angles:
        x, y = _unit(angle)
        ahead, beside = away @ (x, y), away @ (-y, x)
        clear &= (np.abs(beside) > CLEAR) | (ahead < -CLEAR)
    return sector, clear


@pytest.mark.parametrize("shape", ["ugimp", "bspline3"])
@settings(max_examples=40, deadline=None)
@given(star=stars())
def test_every_sector_of_a_star_has_one_row_at_a_node(shape, star):
    """No row has particles of two sectors, no sector has two rows, a node's own row is its own."""
    place, angles, lines = star
    model, state, scratch = sorted_out(cracks_along(lines), shape)
    sector, clear = sector_of(state.particles.position, place, angles)
    at_node, node_clear = sector_of(model.lattice.node_positions(), place, angles)
    rows, seen = {}, {}
    for p, node, row in pairs(model, state, scratch):
        if clear[p]:
            seen.setdefault(row, set()).add(int(sector[p]))
            rows.setdefault((node, int(sector[p])), set()).add(row)
            if node_clear[node]:
                assert (row == node) == (sector[p] == at_node[node]), (place, angles, lines)
    assert [row for row, found in seen.items() if len(found) > 1] == [], (place, angles, lines)
    assert [key for key, found in rows.items() if len(found) > 1] == [], (place, angles, lines)
    assert scratch.rows.count[2] == scratch.rows.count[3] == 0


def masses(scratch):
    """Return the masses in the rows of every node, ascending."""
    rows, found = scratch.rows, []
    for node in rows.shared[: rows.count[1]]:
        at, row = [scratch.grid.mass[node]], rows.first[node]
        while row >= 0:
            at.append(scratch.grid.mass[row])
            row = rows.next[row - len(rows.first)]
        found.append((int(node), tuple(sorted(at))))
    return sorted(found)


WAYS = {
    "three": [[(4, 4), (7, 4)], [(4, 4), (2.5, 6.6)], [(4, 4), (2.5, 1.4)]],
    "three, against": [[(7, 4), (4, 4)], [(4, 4), (2.5, 6.6)], [(2.5, 1.4), (4, 4)]],
    "one bent, one": [[(2.5, 1.4), (4, 4), (2.5, 6.6)], [(4, 4), (7, 4)]],
    "another bent": [[(7, 4), (4, 4), (2.5, 6.6)], [(2.5, 1.4), (4, 4)]],
    "not quite there": [[(2.5, 1.4), (4, 4), (2.5, 6.6)], [(4.03, 4), (7, 4)]],
}


@pytest.mark.parametrize("off", [(0.0, 0.0), (0.1, 0.13), (0.31, -0.17)])
@pytest.mark.parametrize("tips", ["smooth", "sharp"])
def test_a_junction_is_one_object_however_the_deck_writes_it(tips, off):
    """The same masses in the rows of the same nodes."""
    found = []
    for lines in WAYS.values():
        moved = [[(x + off[0], y + off[1]) for x, y in line] for line in lines]
        _, _, scratch = sorted_out(cracks_along(moved), tips=tips)
        found.append(masses(scratch))
    for one, other in pairwise(found):
        assert [node for node, _ in one] == [node for node, _ in other]
        for (_, a), (_, b) in zip(one, other, strict=True):
            np.testing.assert_allclose(a, b, rtol=1e-12)


@pytest.mark.parametrize("joint", [4.0, 3.75, 4.3])
@pytest.mark.parametrize("against", [False, True])
def test_two_cracks_end_to_end_are_one(joint, against):
    """Rows of both cracks together are those of one crack, wherever they meet."""
    halves = [[(1.0, 4.0), (joint, 4.0)], [(joint, 4.0), (7.0, 4.0)]]
    halves[1] = halves[1][::-1] if against else halves[1]
    _, _, whole = sorted_out(cracks_along([[(1.0, 4.0), (7.0, 4.0)]]), tips="smooth")
    _, _, parts = sorted_out(cracks_along(halves), tips="smooth")
    one, two = masses(whole), masses(parts)
    assert [node for node, _ in one] == [node for node, _ in two]
    for (_, a), (_, b) in zip(one, two, strict=True):
        np.testing.assert_allclose(a, b, rtol=1e-12)
    e = parts.rows.count[0]
    assert set(parts.rows.crack[:e, 0].tolist()) == {0}


def test_arms_stay_together_in_motion():
    """Points of all arms at a junction are one point, after steps of a body that is torn apart."""
    data = SQUARE | {"grid": {"cell": 1.0, "margin": 3}}
    cracks = [{"name": f"c{n}", **c} for n, c in enumerate(cracks_along(WAYS["three"]))]
    model, state, scratch = build_deck(data, cracks=cracks)
    away = state.particles.position - 4.0
    state.particles.velocity[:] = 0.01 * away + 0.002 * away[:, ::-1] ** 2
    advance(model, state, scratch, 20)
    at = state.paths.point[state.paths.joint == 0]
    assert len(at) == 3
    assert (at == at[0]).all()
    assert np.hypot(*(at[0] - 4.0)) > 1e-6


def test_ends_of_arms_are_neither_tips_nor_edges():
    _, state, _ = sorted_out(cracks_along(WAYS["one bent, one"]))
    assert state.paths.ends.tolist() == [[TIP, TIP], [PLAIN, TIP]]
    assert (state.paths.joint >= 0).sum() == 2


def test_left_of_an_arm_is_above_where_it_runs_out():
    _, _, scratch = sorted_out(cracks_along(WAYS["three, against"]))
    segments = scratch.segments
    arms = segments.arms[: segments.first_arm[1]]
    assert [left_of_arm(segments, int(arm)) for arm in arms] == [-1, 1, -1]


def test_sectors_side_by_side_are_paired_across_the_arm_between_them():
    """A node in one of three sectors sees the other two; the third arm lies between these."""
    _, _, scratch = sorted_out(cracks_along(WAYS["three"]))
    rows, segments = scratch.rows, scratch.segments
    assert rows.count[5] > 0
    arm_of = {int(segments.crack[arm // 2]): int(arm) for arm in segments.arms[:3]}
    for n in range(rows.count[5]):
        labels = [rows.crack[row - len(rows.first), 0] for row in rows.pair[n]]
        crack = int(rows.pair_crack[n])
        assert sorted([*map(int, labels), crack]) == [0, 1, 2]
        arm = arm_of[crack] // 2
        x0, y0, x1, y1 = segments.ends[arm]
        np.testing.assert_allclose(rows.pair_normal[n], [y1 - y0, x0 - x1])


@pytest.mark.parametrize("written", ["three", "one bent, one"])
def test_faces_at_a_junction_bear_on_each_other(written):
    """A body that is pressed together on glued arms bears as one without cracks, within 10 %.

    Not to round-off, as with one crack: pairs of sectors meet one after the other, once each.
    """
    cracks = [
        {"name": f"c{n}", "contact": {"law": "glued"}, **c}
        for n, c in enumerate(cracks_along(WAYS[written]))
    ]
    inward = []
    for some in (cracks, []):
        model, state, scratch = build_deck(SQUARE, cracks=some)
        state.particles.velocity[:] = -0.01 * (state.particles.position - 4.0)
        advance(model, state, scratch, 12)
        near = np.hypot(*(state.particles.position - 4.0).T) < 1.5
        inward.append(state.particles.stress[near].mean(axis=0)[:2])
    assert inward[1][0] < 0.0
    np.testing.assert_allclose(inward[0], inward[1], rtol=0.1)


def test_a_domain_goes_through_a_joint_as_along_one_crack():
    """Two cracks end to end leave a tip the room of one crack; a third arm ends the domain."""
    _, whole, _ = sorted_out(cracks_along([[(0, 4), (6, 4)]]))
    model, parts, _ = sorted_out(cracks_along([[(0, 4), (3, 4)], [(6, 4), (3, 4)]]))
    (tip,) = tips_of(parts.paths)
    points, own = through_joints(parts.paths, tip)
    assert own == [1, 0]
    np.testing.assert_allclose(
        parts.paths.origin[points], whole.paths.origin[::-1], rtol=0, atol=1e-14
    )
    assert find_room(model, parts.paths, tip, (6.0, 4.0), 0.5)[1] != "crack c0"
    arms = [[(0, 4), (3, 4)], [(6, 4), (3, 4)], [(3, 4), (3, 6)]]
    model, three, _ = sorted_out(cracks_along(arms))
    tip = next(one for one in tips_of(three.paths) if one.crack == 1)
    assert find_room(model, three.paths, tip, (6.0, 4.0), 0.5) == (3.0, "crack c0")
