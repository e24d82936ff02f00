"""Which ways from a particle to a node cross a crack (Nairn 2003; ties: docs/theory/cracks.md)."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st
from shapely import LineString, Point

from cramp_cli.cracks.crossing import crossed_cracks, crossed_once, hidden_nodes, off_crack
from cramp_cli.cracks.lines import NO_CRACK
from cramp_cli.cracks.segments import ON_CRACK, list_segments, make_segments
from cramp_cli.state.lattice import Lattice
from cramp_cli.state.paths import EDGE, PLAIN, make_paths

LATTICE = Lattice((8, 8), 1.0, (-4.0, -4.0))
STRAIGHT = ((-1.0, 0.0), (0.0, 0.0), (1.0, 0.0))
ABOVE, BELOW, NONE = 1, -1, 0


def laid_out(cracks, lattice=LATTICE, ends=PLAIN):
    """Return the segments of cracks, listed by cell."""
    count = sum(len(line) - 1 for line in cracks)
    n = len(cracks)
    paths = make_paths(cracks, [(ends, ends)] * n, [0] * n, [(-1, 0)] * n, 2)
    segments = make_segments(lattice.node_count, count, 81 * count)
    place = (lattice.cells, lattice.width, lattice.lower, lattice.strides)
    assert list_segments(segments, paths, *place, 1, 4, np.zeros(paths.crack_count))
    return segments


def cell_of(point, lattice=LATTICE):
    """Return the lowest node of the cell of a point."""
    return int(np.floor((np.array(point) - lattice.lower) / lattice.width) @ lattice.strides)


def answer(cracks, particle, node, lattice=LATTICE, ends=PLAIN):
    """Return ((crack, side), ...) of the first two crossed cracks and the number of others."""
    segments, cell = laid_out(cracks, lattice, ends), cell_of(particle, lattice)
    points = tuple(map(float, (*particle, *node)))
    a, side_a, _, b, side_b, _, more = crossed_cracks(segments, cell, *points, ON_CRACK)
    return tuple((c, side) for c, side in ((a, side_a), (b, side_b)) if c >= 0), more


def side(line, particle, node, **more):
    """Return the side from which the line particle -> node crosses one crack, or NONE."""
    crossed, _ = answer([line], particle, node, **more)
    return crossed[0][1] if crossed else NONE


@pytest.mark.parametrize(
    ("particle", "node", "wanted"),
    [
        ((0.3, 1), (0.2, -1), ABOVE),
        ((0.3, -1), (0.2, 1), BELOW),
        ((0.3, 1), (0.2, 0), ABOVE),  # a node on the crack lies below it
        ((0.3, -1), (0.2, 0), NONE),
        ((0.3, 0), (0.2, 1), BELOW),  # and so does a particle
        ((0.3, 0), (0.2, -1), NONE),
        ((0.3, 0), (0.7, 0), NONE),
        ((0, 1), (0, -1), ABOVE),  # through a vertex: one of two segments has it
        ((0, -1), (0, 1), BELOW),
        ((0.5, 1), (-0.5, -1), ABOVE),
        ((0, 1), (0, 0), ABOVE),  # a vertex on the node
        ((0, -1), (0, 0), NONE),
        ((0, 0), (0, 1), BELOW),  # and on the particle
        ((2, 1), (2, -1), NONE),  # beside the crack
        ((1.5, 0), (-0.5, 0), NONE),  # along it
        ((0.3, 2), (0.2, 1), NONE),
    ],
)
def test_truth_table(particle, node, wanted):
    """Nairn (2003); where a point lies on the crack: below it, seen from everywhere."""
    assert side(STRAIGHT, particle, node) == wanted


@pytest.mark.parametrize("off", [-0.9, 0.9])
def test_a_hair_off_the_crack_is_on_it(off):
    """Points within 1e-9 cells lie on the crack, that is below; farther ones do not."""
    assert side(STRAIGHT, (0.3, off * 1e-9), (0.2, 1)) == BELOW
    assert side(STRAIGHT, (0.3, 1), (0.2, off * 1e-9)) == ABOVE
    assert side(STRAIGHT, (0.3, 1), (0.2, 1.1e-9)) == NONE


def test_an_edge_end_goes_on_into_free_space():
    """By four segment lengths."""
    assert side(STRAIGHT, (1.5, 0.5), (1.5, -0.5)) == NONE
    assert side(STRAIGHT, (1.5, 0.5), (1.5, -0.5), ends=EDGE) == ABOVE


@pytest.mark.parametrize("node", [(0, 0), (1, 0), (-1, 0)])
@pytest.mark.parametrize("end", [(1.0, 0.0), (1.0, 1.0), (1.0, -1.0), (0.3, 1.0), (-0.6, -1.0)])
def test_a_node_on_the_crack_is_below_from_everywhere(node, end):
    """Straight and bent cracks through a node: particles left of the crack cross it, others do not.

    The crack (-2, 0), (0, 0), end goes on straight at both ends, past the circle of particles.
    """
    line = ((-4.0, 0.0), (-2.0, 0.0), (0.0, 0.0), end, tuple(3.0 * np.array(end)))
    if node == (1, 0) and end != (1.0, 0.0):
        node = end
    wall = LineString(line)
    for angle in np.radians(np.arange(2.5, 360.0, 5.0)):
        particle = np.array(node) + 0.4 * np.array([np.cos(angle), np.sin(angle)])
        if wall.distance(Point(particle)) > 1e-3:
            wanted = ABOVE if _left_of(line, particle) else NONE
            assert side(line, particle, node) == wanted, f"{np.degrees(angle):.1f} degrees"


def _left_of(line, point):
    """Return whether a point is left of a polyline: of the nearest piece, at a bend of both."""
    a, b = np.array(line[:-1]), np.array(line[1:])
    share = np.clip(np.sum((point - a) * (b - a), 1) / np.sum((b - a) ** 2, 1), 0.0, 1.0)
    away = point - (a + share[:, None] * (b - a))
    near = np.hypot(*away.T) <= np.hypot(*away.T).min() + 1e-9
    turned = (b - a)[:, 0] * (point - a)[:, 1] - (b - a)[:, 1] * (point - a)[:, 0]
    # At a bend both pieces are equally near; the one whose line is farther away decides.
    return turned[near][np.argmax(np.abs(turned[near]))] > 0.0


coordinate = st.integers(-1900, 1900).map(lambda n: n / 1000)
CURL = [(0.0, -1.5), (-1.0, 0.0), (0.0, -1.0), (1.0, 0.0), (-1.0, 1.0), (0.0, 0.0)]
quarter = st.integers(-7, 7).map(lambda n: n / 4)  # many ties: through nodes, vertices, particles


def lines(number):
    return st.lists(st.tuples(number, number), min_size=2, max_size=7, unique=True)


def nodes_near(particle, draw_x, draw_y):
    """Return a node of the two by two cells around a particle, as shape functions see them."""
    return tuple(np.floor(particle) + (draw_x, draw_y))


near = st.integers(-1, 2)


def clear_of_ties(line, particle, node):
    """Return whether no end of the way lies on the crack and no crack point on the way."""
    crack, way = LineString(line), LineString([particle, node])
    ends = min(crack.distance(Point(particle)), crack.distance(Point(node)))
    return ends > 1e-6 and min(way.distance(Point(p)) for p in line) > 1e-6 and way.length > 1e-6


def clear_of_ends(line, particle, node):
    """Return whether the way passes no end of the crack within 1e-3."""
    way = LineString([particle, node])
    return way.length > 0.0 and min(way.distance(Point(line[end])) for end in (0, -1)) > 1e-3


@settings(max_examples=300)
@given(line=lines(coordinate), particle=st.tuples(coordinate, coordinate), i=near, j=near)
def test_as_many_crossings_as_shapely_finds(line, particle, i, j):
    """An even number of crossed segments is no crossing, an odd one is, if the crack is simple."""
    node = nodes_near(particle, i, j)
    assume(LineString(line).is_simple and clear_of_ties(line, particle, node))
    way = LineString([particle, node])
    pieces = map(LineString, zip(line, line[1:], strict=False))
    odd = sum(way.intersects(piece) for piece in pieces) % 2 == 1
    assert (side(line, particle, node) != NONE) == odd


@settings(max_examples=200)
@given(line=lines(coordinate), particle=st.tuples(coordinate, coordinate), i=near, j=near)
@example(CURL, (0.0, 0.25), -1, -1)
def test_the_side_is_that_of_the_particle_where_the_crack_winds(line, particle, i, j):
    """Crossings of a simple line alternate along the way: their sum is the particle's side."""
    node = nodes_near(particle, i, j)
    assume(LineString(line).is_simple and clear_of_ties(line, particle, node))
    total = 0
    for (ax, ay), (bx, by) in zip(line, line[1:], strict=False):
        if LineString([particle, node]).intersects(LineString([(ax, ay), (bx, by)])):
            left = (bx - ax) * (particle[1] - ay) - (by - ay) * (particle[0] - ax) > 0.0
            total += ABOVE if left else BELOW
    assert side(line, particle, node) == total


@settings(max_examples=100)
@given(line=lines(coordinate), particle=st.tuples(coordinate, coordinate), i=near, j=near)
def test_a_crack_read_backwards_has_its_sides_swapped(line, particle, i, j):
    node = nodes_near(particle, i, j)
    assume(LineString(line).is_simple and clear_of_ties(line, particle, node))
    assert side(line[::-1], particle, node) == -side(line, particle, node)


@settings(max_examples=200)
@given(line=lines(quarter), particle=st.tuples(quarter, quarter), i=near, j=near)
def test_whole_cells_do_not_matter(line, particle, i, j):
    """Quarters of cells are exact numbers, so every tie must have the same answer elsewhere.

    Left out: ways past an end of the crack.
    """
    node = nodes_near(particle, i, j)
    assume(clear_of_ends(line, particle, node))
    shift = np.array([3.0, -2.0])
    moved = LATTICE._replace(lower=tuple(LATTICE.lower + shift))
    there = (list(map(tuple, line + shift)), particle + shift, node + shift)
    assert side(*there, lattice=moved) == side(line, particle, node)


@settings(max_examples=300)
@given(line=lines(quarter), particle=st.tuples(quarter, quarter), i=near, j=near)
@example([(0.0, 0.0), (0.0, 0.25), (0.25, 0.0)], (0.0, 0.25), 0, 1)  # a bend on the particle
def test_ties_are_those_of_a_crack_a_hair_above(line, particle, i, j):
    """The rule of cracks/crossing.py, with exact fractions: the crack 1e-6 cells to its left.

    Left out: ways that begin, end or pass within 1e-3 of an end of the crack, and folded cracks.
    """
    node = nodes_near(particle, i, j)
    assume(LineString(line).is_simple and clear_of_ends(line, particle, node))
    assert (side(line, particle, node) != NONE) == _odd(_hair_above(line), particle, node)


def _hair_above(line):
    """Return the crack with every piece moved to its left by about 1e-6, mitred at its bends."""
    points = np.array(line)
    step = np.diff(points, axis=0)
    left = np.stack([-step[:, 1], step[:, 0]], 1) / np.hypot(*step.T)[:, None]
    first, last = left[[0, *range(len(left))]], left[[*range(len(left)), len(left) - 1]]
    both = first + last
    mitre = both / np.maximum(1e-9, np.sum(both * last, axis=1))[:, None]
    return points + 1e-6 * mitre


def _odd(line, particle, node):
    """Return whether the way crosses an odd number of pieces, with exact numbers."""
    exact = [tuple(map(Fraction, map(float, p))) for p in (*line, particle, node)]
    *crack, p, n = exact

    def turn(a, b, c):
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])

    hits = 0
    for a, b in zip(crack, crack[1:], strict=False):
        apart = (turn(a, b, p) > 0) != (turn(a, b, n) > 0)
        hits += apart and (turn(p, n, a) > 0) != (turn(p, n, b) > 0)
    return hits % 2 == 1


def test_two_cracks_and_more():
    """The first two cracks by number; further ones are counted."""
    levels = [((-2.0, y), (2.0, y)) for y in (0.5, -0.2, 0.2)]
    assert answer(levels, (0.1, 0.9), (0.0, 0.0)) == (((0, ABOVE), (2, ABOVE)), 0)
    assert answer(levels, (0.1, 0.9), (0.0, -1.0)) == (((0, ABOVE), (1, ABOVE)), 1)
    assert answer(levels, (0.1, -0.4), (0.0, 0.0)) == (((1, BELOW),), 0)


def quick_and_exact(cracks, particle, side=4):
    """Return for the nodes around a particle: its quick answer, or None; and the exact one."""
    segments, cell = laid_out(cracks), cell_of(particle)
    lowest = tuple(map(float, np.floor(particle) - 1.0))
    x, y = map(float, particle)
    hidden, unsure = hidden_nodes(segments, cell, x, y, lowest, 1.0, side, ON_CRACK)
    x, y = off_crack(segments, cell, x, y, ON_CRACK)
    for k in range(side * side):
        quick = crossed_once(segments, k) if hidden >> k & 1 else NO_CRACK
        n = (lowest[0] + k % side, lowest[1] + k // side)
        n = off_crack(segments, cell, *n, ON_CRACK)
        exact = crossed_cracks(segments, cell, x, y, *n, ON_CRACK)
        yield None if unsure >> k & 1 else quick, exact


some_lines = st.lists(lines(coordinate) | lines(quarter), min_size=1, max_size=3)
anywhere = st.tuples(coordinate, coordinate) | st.tuples(quarter, quarter)


@settings(max_examples=600)
@given(cracks=some_lines, particle=anywhere)
@example([[(-2.0, 0.0), (2.0, 0.0)], [(0.0, -2.0), (0.0, 2.0)]], (-0.5, 0.5))  # cross at a node
@example([[(-2.0, -2.0), (2.0, 2.0)]], (0.25, 0.5))  # nodes on the crack
def test_the_quick_answer_is_the_exact_one_where_there_is_one(cracks, particle):
    for quick, exact in quick_and_exact(cracks, particle):
        assert quick is None or quick == exact


@pytest.mark.parametrize(
    "line", [((-1.6, 0.0), (0.7, 0.0)), ((-1.9, -1.3), (0.1, 0.2), (1.7, 1.9))]
)
@pytest.mark.parametrize("particle", [(0.25, 0.25), (-0.3, -0.7), (0.4, -0.2)])
def test_most_nodes_have_a_quick_answer(line, particle):
    """In line with an end of a segment, nodes want a closer look: few do."""
    answers = list(quick_and_exact([line], particle))
    assert sum(quick is None for quick, _ in answers) <= 1
    assert any(quick not in (None, NO_CRACK) for quick, _ in answers)
