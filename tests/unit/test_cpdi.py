"""Convected particle domains: weights of parallelograms, their limits, threads, checkpoints."""

from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from runs import Listener, Rows
from support import advance, build_deck, locate, read

from cramp_cli.boundary.conditions import add_loads
from cramp_cli.build import build
from cramp_cli.scratch import make_scratch
from cramp_cli.shapes.cpdi import LONGEST, ConvectedDomain
from cramp_cli.shapes.nodes import give, give_gradient, take, take_both
from cramp_cli.shapes.ring import Ring
from cramp_cli.shapes.shape import (
    AS_IT_IS,
    NOWHERE,
    SHORTENED,
    factors,
    gradients,
    lay_out,
    offsets,
    place_of,
    point_weights,
    sees,
    weights,
)
from cramp_cli.shapes.ugimp import UniformGimp
from cramp_cli.simulation import simulate
from cramp_cli.state.failure import NumericalFailure
from cramp_cli.state.stencil import make_stencil
from cramp_cli.transfer.sums import sum_internal_force, sum_mass_and_momentum
from cramp_cli.transfer.to_grid import clear

HALF = (0.25, 0.2)  # cells
STRIDES = (1, 7)
FIRST = 9  # node (2, 1) of the grid
STEPS = np.array(offsets(STRIDES, ConvectedDomain(HALF)))
NODES = np.stack([STEPS % 7, STEPS // 7], axis=1)  # from the first one, in cells
ROUND_OFF = 1e-15

angle = st.floats(-np.pi, np.pi)
stretch = st.floats(0.4, 3.0)
# a turn after a stretch after a shear after a turn
strained = st.builds(
    lambda after, a, b, shear, before: (
        turned(after) @ np.diag([a, b]) @ np.array([[1.0, shear], [0.0, 1.0]]) @ turned(before)
    ),
    angle, stretch, stretch, st.floats(-1.5, 1.5), angle,
)  # fmt: skip
local = st.tuples(*[st.floats(1.0, 2.0, exclude_max=True)] * 2)


class Particle(NamedTuple):
    """One particle: how its domain was made, and what it is."""

    how: int
    place: tuple
    shape: tuple


def turned(angle):
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


def particle(F, local, shape=None):
    shape = shape or ConvectedDomain(HALF)
    stencil = make_stencil(1, 2, 16, 1, domains=True)
    stencil.base[0], stencil.local[0] = FIRST, local
    how = lay_out(shape, stencil, np.reshape(F, (1, 4)), 0)
    return Particle(how, place_of(shape, STRIDES, stencil, 0), shape)


def whole(F, local, shape=None):
    """Return a particle that was not shortened."""
    found = particle(F, local, shape)
    assume(found.how == AS_IT_IS)
    return found


def values(p):
    """Return weights and gradients (per cell) at all nodes."""
    return np.array(weights(p.place, p.shape)), np.array(gradients(p.place, p.shape)).T


def hats(x):
    """Return the linear functions of all nodes at places x (n, 2), shape (n, nodes)."""
    return np.prod(np.maximum(0.0, 1.0 - np.abs(x[:, None] - NODES)), axis=2)


def means(F, local, radius=None):
    """Return the means over the domain, weighed by the radius if there is one, by quadrature.

    Of a function that is bilinear between its values N at the corners: two points of Gauss along
    each side are exact for it, for its gradient, and for both times the radius.
    """
    sides = F * np.array(HALF)
    signs = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    N = hats(local + signs @ sides.T)
    S, G, total = 0.0, 0.0, 0.0
    for xi, eta in signs / np.sqrt(3.0):
        weight = 1.0 if radius is None else radius + sides[0] @ (xi, eta)
        x, y = 0.5 * (1.0 + signs[:, 0] * xi), 0.5 * (1.0 + signs[:, 1] * eta)
        slope = np.stack([0.5 * signs[:, 0] * y, 0.5 * signs[:, 1] * x])
        S += x * y @ N
        G += weight * np.linalg.inv(sides).T @ slope @ N
        total += weight
    return S / 4.0, G.T / total


@given(F=strained, local=local)
def test_a_constant_and_a_linear_field_are_exact(F, local):
    """sum S = 1, sum G = 0, sum S x_i = x, sum x_i G = 1: stretched, sheared, turned, shortened."""
    p = particle(F, local)
    assert p.how in (AS_IT_IS, SHORTENED)
    S, G = values(p)
    area = abs(p.place.a[0] * p.place.b[1] - p.place.a[1] * p.place.b[0])
    assert S.min() >= 0.0
    assert S.sum() == pytest.approx(1.0, abs=10 * ROUND_OFF)
    np.testing.assert_allclose(S @ NODES, local, atol=20 * ROUND_OFF)
    np.testing.assert_allclose(G.sum(axis=0), 0.0, atol=20 * ROUND_OFF / area)
    np.testing.assert_allclose(NODES.T @ G, np.eye(2), atol=40 * ROUND_OFF / area)


@given(F=strained, local=local)
def test_values_and_gradients_are_means_over_the_domain(F, local):
    """Sadeghirad et al. (2011): of functions bilinear between the corners, by quadrature."""
    p = whole(F, local)
    S, G = values(p)
    wanted_S, wanted_G = means(F, np.array(local))
    np.testing.assert_allclose(S, wanted_S, atol=1e-14)
    np.testing.assert_allclose(G, wanted_G, atol=1e-13)


@given(F=strained, local=local)
def test_slopes_of_rings_along_the_radius_are_means_weighed_by_it(F, local):
    """Those along the axis are plain, as in ring.py.

    The axis is the line before the first node, so the radius is x + 1.
    """
    ring = Ring(ConvectedDomain(HALF), HALF, 1, 7)
    p = whole(F, local, ring)
    plain, weighed = means(F, np.array(local))[1], means(F, np.array(local), local[0] + 1.0)[1]
    np.testing.assert_allclose(values(p)[1][:, 0], weighed[:, 0], atol=1e-13)
    np.testing.assert_allclose(values(p)[1][:, 1], plain[:, 1], atol=1e-13)


@given(local=local)
def test_an_unstrained_domain_in_one_cell_is_that_of_gimp(local):
    """A box that meets no grid line: the mean of a linear function over it."""
    box = np.array(HALF)
    assume(np.all(np.floor(local - box) == np.floor(local + box)))
    p = whole(np.eye(2), local)
    gimp, start = UniformGimp(HALF), np.floor(local - box)
    near = tuple(np.array(local) - start)
    for mine, theirs in zip(
        (values(p)[0], *values(p)[1].T),
        (weights(near, gimp), *gradients(near, gimp)),
        strict=True,
    ):
        block = np.zeros((6, 6))
        i, j = start.astype(int)
        block[j : j + 3, i : i + 3] = np.reshape(theirs, (3, 3))
        np.testing.assert_allclose(np.reshape(mine, (4, 4)), block[:4, :4], atol=1e-14)


@given(F=strained, local=local)
def test_sums_by_corners_are_those_over_all_nodes(F, local):
    p = particle(F, local)
    (S, G), nodes, along = values(p), FIRST + STEPS, factors(p.place, p.shape)
    field = np.random.default_rng(3).normal(size=(60, 2))
    V, T = (2.0, -3.0), ((1.0, -0.4), (0.3, 2.0))
    size = 1e-13 * (1.0 + np.abs(G).max())
    given_to, wanted = field.copy(), field.copy()
    give(along, STRIDES, FIRST, given_to, V)
    wanted[nodes] += S[:, None] * V
    np.testing.assert_allclose(given_to, wanted, atol=size)
    give_gradient(along, STRIDES, FIRST, given_to, V, T)
    wanted[nodes] += S[:, None] * V + G @ np.array(T)
    np.testing.assert_allclose(given_to, wanted, atol=size)
    v, slopes = take_both(along, STRIDES, FIRST, field)
    np.testing.assert_allclose(v, S @ field[nodes], atol=size)
    np.testing.assert_allclose(take(along, STRIDES, FIRST, field), v, atol=size)
    np.testing.assert_allclose(slopes, G.T @ field[nodes], atol=size)


@given(F=strained, local=local)
def test_a_node_with_a_weight_is_seen(F, local):
    p = particle(F, local)
    seen = np.array([sees(p.place, p.shape, k) for k in range(len(STEPS))])
    assert not np.any(values(p)[0][~seen])


@given(F=strained, local=local, corner=st.sampled_from([(1, 1), (-1, 1), (1, -1), (-1, -1)]))
def test_a_load_at_a_corner_goes_with_it(F, local, corner):
    p = whole(F, local)
    away = np.array(corner) * HALF
    S = np.array(point_weights(p.place, p.shape, tuple(away)))
    np.testing.assert_allclose(S @ NODES, local + F @ away, atol=50 * ROUND_OFF)


def test_long_diagonals_are_shortened_and_others_kept():
    """Half sides 3 and 0.1 along the axes: both half diagonals become LONGEST, their ways stay."""
    p = particle(np.diag([12.0, 0.5]), (1.3, 1.6))
    assert p.how == SHORTENED
    a, b = np.array(p.place.a), np.array(p.place.b)
    for diagonal, way in ((a + b, (3.0, 0.1)), (a - b, (3.0, -0.1))):
        np.testing.assert_allclose(diagonal, LONGEST * np.array(way) / np.hypot(*way), rtol=1e-14)
    assert particle(np.diag([3.9, 1.0]), (1.3, 1.6)).how == AS_IT_IS


@pytest.mark.filterwarnings("ignore:invalid value")
@pytest.mark.parametrize("number", [np.nan, np.inf])
def test_a_domain_that_is_no_number_is_nowhere(number):
    assert particle(np.diag([number, 1.0]), (1.3, 1.6)).how == NOWHERE


BLOCK = """
cramp: 1
analysis: plane_strain
grid: {cell: 1, margin: 14}
materials: {m: {law: neo_hookean, density: 1, E: 3, nu: 0.2}}
bodies: [{name: block, material: m, shape: {type: rectangle, lower: [0, 0], upper: [24, 6]}}]
loads: [{type: traction, body: block, where: {x: 24}, traction: [0.01, 0]}]
solver: {end_time: 1, shape: cpdi}
"""


def strained_block(F):
    """Return model, state and scratch of a block strained evenly."""
    model, state, scratch = build_deck(BLOCK)
    p = state.particles
    p.F[:] = np.ravel(F)
    p.position[:] = p.origin @ np.transpose(F)
    return model, state, scratch


def test_an_even_stress_leaves_inner_nodes_without_force():
    """Domains that are strained alike have no gaps: what the neighbours give a node is zero."""
    F = np.array([[1.1, 0.3], [-0.2, 1.2]])
    model, state, scratch = strained_block(F)
    locate(model, state, scratch)
    sum_mass_and_momentum(model, state, scratch)
    p, x = state.particles, model.lattice.node_positions()
    p.stress[:] = np.linalg.det(F) * np.array([1.0, -2.0, 0.0, 0.5])
    clear(scratch.grid.force, scratch.row_count)
    sum_internal_force(model, state, scratch)
    X = x @ np.linalg.inv(F).T
    deep = np.all((X > 2.0) & (X < (22.0, 4.0)), axis=1)
    assert deep.sum() > 20
    force = scratch.grid.force[: len(x)]
    assert np.abs(force[deep]).max() < 1e-13
    assert np.abs(force).max() > 0.1


def test_a_traction_acts_at_the_face_where_it_has_gone():
    """Moments: sum f_i x_i = force times the middle of the strained face."""
    F = np.array([[1.1, 0.3], [0.2, 1.0]])
    model, state, scratch = strained_block(F)
    locate(model, state, scratch)
    clear(scratch.grid.force, scratch.row_count)
    add_loads(model, scratch, state)
    force = scratch.grid.force[: model.lattice.node_count]
    moments = force.T @ model.lattice.node_positions()
    np.testing.assert_allclose(moments, np.outer([0.06, 0.0], F @ [24.0, 3.0]), atol=1e-12)


def test_a_particle_without_numbers_ends_the_run():
    model, state, scratch = build_deck(BLOCK)
    state.particles.F[7, 1] = np.nan
    with pytest.raises(NumericalFailure, match="a position or a shape that is no number"):
        locate(model, state, scratch)


def test_shortened_domains_are_told_once():
    """The balance is let be: it does not know of the energy of a stretch that no force made."""
    deck = read(BLOCK, solver={"end_time": 8.0, "energy_error": {"stop": 1e9}})
    model, state = build(deck)
    state.particles.F[3] = (9.0, 0.0, 0.0, 1.0)
    told = Listener()
    simulate(deck, model, state, Rows(), told)
    mine = [text for text in told.warnings if "domains are shortened" in text]
    assert len(mine) == 1
    assert "1 particles are longer than two cells" in mine[0]


def test_threads_do_not_change_a_bit():
    motions = []
    for threads in (1, 2, 4):
        model, state, _ = strained_block(np.diag([1.4, 0.9]))
        scratch = make_scratch(model, state, threads)
        advance(model, state, scratch, 20)
        motions.append(state.particles.position[np.argsort(state.particles.id)].tobytes())
    assert motions[0] == motions[1] == motions[2]


def test_all_that_goes_on_is_in_the_state():
    """Domains are scratch paper: with a new one after ten steps not a bit changes."""
    places = []
    for steps in ((20,), (10, 10)):
        model, state, _ = strained_block(np.diag([1.4, 0.9]))
        for count in steps:
            advance(model, state, make_scratch(model, state), count)
        places.append(state.particles.position.tobytes())
    assert places[0] == places[1]
