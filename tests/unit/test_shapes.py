"""Properties that every shape function has, and the values of each (docs/theory/step.md)."""

from math import comb, factorial

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cramp_cli.build.model import SHAPES
from cramp_cli.numerics.vector import vector
from cramp_cli.shapes.linear import Linear
from cramp_cli.shapes.shape import (
    along_axis,
    at_point,
    first_node,
    gradients,
    has_domain,
    node_steps,
    offsets,
    point_weights,
    support,
    weights,
)
from cramp_cli.shapes.ugimp import UniformGimp
from cramp_cli.state.lattice import Lattice
from cramp_cli.state.stencil import make_stencil
from cramp_cli.transfer.to_particles import locate

HALVES = (0.5, 0.25, 0.125)  # half size of a particle in cells: 1, 2 and 4 particles per cell side
# those that are products of functions of one axis; for the others see test_cpdi.py
PRODUCTS = {name: kind for name, kind in SHAPES.items() if not has_domain(kind((0.25,) * 3))}
ALL_SHAPES = pytest.mark.parametrize(
    "shape",
    [kind((half,) * 3) for kind in PRODUCTS.values() for half in HALVES],
    ids=[f"{name}-{half}" for name in PRODUCTS for half in HALVES],
)
DIMENSIONS = pytest.mark.parametrize("dim", [2, 3])
LATTICES = {
    2: Lattice((7, 6), 0.5, (-1.0, 2.0)),
    3: Lattice((7, 6, 6), 0.5, (-1.0, 2.0, 0.0)),
}
ROUND_OFF = 1e-15
place = st.floats(1.0, 4.0)  # in cells, far enough from the grid's border for every shape


def on_axis(shape, x):
    """Return value and slope of the nodes that a particle at x (cells) sees, by node."""
    first = first_node(shape, 0, x)
    values, slopes = along_axis(shape, 0, x - first)
    nodes = [first + step for step in node_steps(shape, 1)]
    return {n: (v, s) for n, v, s in zip(nodes, values, slopes, strict=True)}


def gone(stencil, position, shape, lattice):
    """Locate particles in a grid without cracks; return one that is not in it, or -1."""
    cracks = (np.full(lattice.node_count, -1), np.zeros(lattice.node_count, dtype=np.uint8))
    grid = (lattice.lower, lattice.strides, lattice.nodes, lattice.width)
    report, everyone = np.zeros((1, 4), dtype=np.int64), np.array([[0, len(position), 0]])
    F = np.tile(np.eye(position.shape[1]).ravel(), (len(position), 1))
    locate(stencil, position, F, shape, *grid, *cracks, 0, report, everyone)
    return report[0, 0]


def in_space(shape, lattice, cells):
    """Return weights, gradients (1/m), node positions (m) and the position (m) of one particle."""
    dim = len(lattice.cells)
    x = np.array(lattice.lower) + lattice.width * np.array(cells[:dim])
    stencil = make_stencil(1, dim, support(shape) ** dim, 1)
    assert gone(stencil, x[None], shape, lattice) == -1
    local = vector(lattice.strides, stencil.local, 0)
    nodes = stencil.base[0] + np.array(offsets(lattice.strides, shape))
    G = np.array(gradients(local, shape)).T / lattice.width
    return np.array(weights(local, shape)), G, lattice.node_positions()[nodes], x


@ALL_SHAPES
@DIMENSIONS
@settings(max_examples=25)
@given(cells=st.tuples(place, place, place))
def test_a_constant_and_a_linear_field_are_exact(shape, dim, cells):
    """sum S = 1, sum G = 0, sum S x_i = x, sum x_i G = 1, to round-off (coordinates below 5)."""
    S, G, x_i, x = in_space(shape, LATTICES[dim], cells)
    assert S.sum() == pytest.approx(1.0, abs=10 * ROUND_OFF)
    np.testing.assert_allclose(G.sum(axis=0), 0.0, atol=20 * ROUND_OFF)
    np.testing.assert_allclose(S @ x_i, x, atol=50 * ROUND_OFF)
    np.testing.assert_allclose(x_i.T @ G, np.eye(dim), atol=100 * ROUND_OFF)


@ALL_SHAPES
@settings(max_examples=25)
@given(x=place)
def test_weights_are_never_negative(shape, x):
    assert min(value for value, _ in on_axis(shape, x).values()) >= 0.0


@ALL_SHAPES
@pytest.mark.parametrize("border", np.arange(8, 33) / 8.0)
def test_no_jump_where_a_particle_meets_other_nodes(shape, border):
    """A slope is at most 1 per cell; the places are where values change their formula or nodes."""
    step = 2.0**-30
    before, after = on_axis(shape, border - step), on_axis(shape, border + step)
    for node in set(before) | set(after):
        jump = before.get(node, (0.0, 0.0))[0] - after.get(node, (0.0, 0.0))[0]
        assert abs(jump) <= 2.0 * step + ROUND_OFF


@pytest.mark.parametrize("half", HALVES)
@pytest.mark.parametrize("border", np.arange(8, 33) / 8.0)
def test_gimp_slopes_have_no_jump(half, border):
    """The second derivative is at most 1/half."""
    step, shape = 2.0**-30, UniformGimp((half,))
    before, after = on_axis(shape, border - step), on_axis(shape, border + step)
    for node in set(before) | set(after):
        jump = before.get(node, (0.0, 0.0))[1] - after.get(node, (0.0, 0.0))[1]
        assert abs(jump) <= 2.0 * step / half + ROUND_OFF


@ALL_SHAPES
@DIMENSIONS
def test_gradients_are_differences_of_weights(shape, dim):
    """Differences of five points are exact for cubics; the places avoid changes of formula."""
    step, lattice = 1e-3, LATTICES[dim]
    cells = np.array([2.0 + 1 / 16, 1.0 + 5 / 16, 3.0 - 3 / 16])[:dim]
    _, G, _, _ = in_space(shape, lattice, cells)
    for d in range(dim):
        move, slope = step * np.eye(dim)[d], 0.0
        for far, share in ((1.0, 8.0 / 12.0), (2.0, -1.0 / 12.0)):
            ahead, _, _, x1 = in_space(shape, lattice, cells + far * move)
            behind, _, _, x0 = in_space(shape, lattice, cells - far * move)
            slope += share * 2.0 * far * (ahead - behind) / (x1[d] - x0[d])
        np.testing.assert_allclose(G[:, d], slope, atol=10 * ROUND_OFF / (step * lattice.width))


@pytest.mark.parametrize("half", HALVES)
@settings(max_examples=50)
@given(x=place)
def test_gimp_is_the_mean_of_linear_functions_over_the_particle(half, x):
    """S = (1/2l) int N, G = (N(x + l) - N(x - l))/2l (Bardenhagen and Kober 2004, box particles).

    N is linear between nodes, so the trapezoidal rule on those pieces is exact.
    """
    seen = on_axis(UniformGimp((half,)), x)
    low, high = x - half, x + half
    pieces = np.array([low, *np.arange(np.ceil(low), np.ceil(high)), high])
    for node in range(int(x) - 2, int(x) + 4):
        N = np.maximum(0.0, 1.0 - np.abs(pieces - node))
        value, slope = seen.get(node, (0.0, 0.0))
        assert value == pytest.approx(np.trapezoid(N, pieces) / (2.0 * half), abs=20 * ROUND_OFF)
        assert slope == pytest.approx((N[-1] - N[0]) / (2.0 * half), abs=40 * ROUND_OFF)


@pytest.mark.parametrize(("name", "degree"), [("bspline2", 2), ("bspline3", 3)])
@settings(max_examples=50)
@given(x=place)
def test_splines_are_those_of_de_boor(name, degree, x):
    """Cardinal splines from truncated powers (de Boor 1978): sum (-1)^k C(n, k) (t - k)_+^(n-1)."""
    seen, order = on_axis(SHAPES[name]((0.25,)), x), degree + 1
    for node in range(int(x) - 3, int(x) + 5):
        t = x - node + 0.5 * order
        powers = [(-1) ** k * comb(order, k) * max(t - k, 0.0) ** degree for k in range(order + 1)]
        value, _ = seen.get(node, (0.0, 0.0))
        assert value == pytest.approx(sum(powers) / factorial(degree), abs=500 * ROUND_OFF)


@pytest.mark.parametrize("name", ["bspline2", "bspline3"])
@pytest.mark.parametrize("border", np.arange(8, 33) / 8.0)
def test_slopes_of_splines_have_no_jump(name, border):
    """The second derivative is at most 2."""
    step, shape = 2.0**-30, SHAPES[name]((0.25,))
    before, after = on_axis(shape, border - step), on_axis(shape, border + step)
    for node in set(before) | set(after):
        jump = before.get(node, (0.0, 0.0))[1] - after.get(node, (0.0, 0.0))[1]
        assert abs(jump) <= 4.0 * step + ROUND_OFF


@settings(max_examples=50)
@given(x=place)
def test_linear_is_the_hat_of_the_nearest_nodes(x):
    for node, (value, _) in on_axis(SHAPES["linear"]((0.25,)), x).items():
        assert value == pytest.approx(max(0.0, 1.0 - abs(x - node)), abs=ROUND_OFF)


@pytest.mark.parametrize(
    "shape", [SHAPES[name]((half,) * 3) for name in ("linear", "ugimp") for half in HALVES], ids=str
)
@DIMENSIONS
@settings(max_examples=25)
@given(cells=st.tuples(place, place, place), share=st.tuples(*[st.floats(-1.0, 1.0)] * 3))
def test_a_point_of_a_particle_has_linear_weights_at_its_nodes(shape, dim, cells, share):
    """A point in the particle's box (linear functions: the particle): sum S x_i is the point."""
    lattice = LATTICES[dim]
    _, _, x_i, x = in_space(shape, lattice, cells)
    box = 0.0 if isinstance(shape, Linear) else shape.half[0]
    point = x + lattice.width * box * np.array(share[:dim])
    local = (point - x_i[0]) / lattice.width
    S = np.array(point_weights(tuple(local.tolist()), shape, (0.0,) * dim))
    hats = np.prod(np.maximum(0.0, 1.0 - np.abs(point - x_i) / lattice.width), axis=1)
    np.testing.assert_allclose(S, hats, atol=20 * ROUND_OFF)
    np.testing.assert_allclose(S @ x_i, point, atol=50 * ROUND_OFF)


@pytest.mark.parametrize("name", ["bspline2", "bspline3"])
@settings(max_examples=50)
@given(cell=st.integers(1, 4), part=st.integers(0, 1), end=st.sampled_from([-1.0, 1.0]))
def test_ends_of_a_particle_have_their_splines_at_its_nodes(name, cell, part, end):
    """Two particles along a cell at their first places: all nodes of their ends are their own."""
    shape, x = SHAPES[name]((0.25,)), cell + 0.25 + 0.5 * part
    first, point = first_node(shape, 0, x), x + 0.25 * end
    values, seen = at_point(shape, point - first), on_axis(shape, point)
    assert sum(values) == pytest.approx(1.0, abs=4 * ROUND_OFF)
    for step, value in enumerate(values):
        assert value == pytest.approx(seen.get(first + step, (0.0, 0.0))[0], abs=4 * ROUND_OFF)


@ALL_SHAPES
@pytest.mark.parametrize("x", [(0.2, 0.2), (6.9, 3.0), (3.0, -0.1), (3.0, 9.0), (np.nan, 3.0)])
def test_a_particle_without_all_its_nodes_is_found(shape, x):
    """Particle 1 of 3; the second half of the places is out of the grid for every shape."""
    lattice = LATTICES[2]
    cells = np.array([(3.0, 3.0), x, (2.0, 2.0)])
    position = np.array(lattice.lower) + lattice.width * cells
    stencil = make_stencil(3, 2, support(shape) ** 2, 1)
    inside = all(
        0 <= first_node(shape, d, c) <= lattice.nodes[d] - support(shape)
        for d, c in enumerate(np.nan_to_num(x, nan=-1.0))
    )
    assert gone(stencil, position, shape, lattice) == (-1 if inside else 1)


@pytest.mark.parametrize("away", [1e-3, 1e-6, 1e-9, 1e-12])
def test_value_and_slope_of_a_node_hardly_seen_belong_together(away):
    """S = l (dS/dx)^2 at either end: what USL without second sums divides by must not be noise."""
    shape = UniformGimp((0.25, 0.25))
    for place, node in ((1.25 - away, 0), (0.75 + away, 2)):
        values, slopes = along_axis(shape, 0, place)
        assert values[node] == pytest.approx(0.25 * slopes[node] ** 2, rel=1e-12)
        assert abs(slopes[node]) == pytest.approx(2.0 * away, rel=1e-3)
