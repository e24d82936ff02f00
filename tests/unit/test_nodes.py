"""Sums axis by axis are the sums over all nodes."""

import numpy as np
import pytest

from cramp_cli.build.model import SHAPES
from cramp_cli.numerics.matrix import from_columns
from cramp_cli.numerics.symmetric import columns
from cramp_cli.shapes.bspline3 import CubicSpline
from cramp_cli.shapes.linear import Linear
from cramp_cli.shapes.nodes import give, give_gradient, take, take_both
from cramp_cli.shapes.shape import factors, gradients, has_domain, offsets, weights

EVERYWHERE = pytest.mark.parametrize(
    ("shape", "dim"),
    [(k, dim) for k in SHAPES.values() for dim in (2, 3) if not has_domain(k((0.25, 0.25)))],
)
FIRST = 4


def one_particle(kind, dim):
    """Return factors, weights, gradients, strides and nodes of a particle, and random fields."""
    shape, place = kind((0.25, 0.2, 0.3)[:dim]), (0.8, 0.55, 1.1)[:dim]
    first = {Linear: 0.0, CubicSpline: 1.0}  # others see both nodes beside the nearest one
    place = tuple(first[kind] + x % 1.0 for x in place) if kind in first else place
    strides = (1, 7, 42)[:dim]
    nodes = FIRST + np.array(offsets(strides, shape))
    field = np.random.default_rng(3).normal(size=(200, dim))
    S, G = np.array(weights(place, shape)), np.array(gradients(place, shape)).T
    return factors(place, shape), S, G, strides, nodes, field


@EVERYWHERE
def test_what_nodes_receive(shape, dim):
    along, S, G, strides, nodes, field = one_particle(shape, dim)
    wanted, V = field.copy(), (2.0, -3.0, 0.5)[:dim]
    wanted[nodes] += S[:, None] * np.array(V)
    give(along, strides, FIRST, field, V)
    np.testing.assert_allclose(field, wanted, rtol=1e-14, atol=1e-15)


@EVERYWHERE
def test_what_nodes_receive_of_a_tensor(shape, dim):
    along, S, G, strides, nodes, field = one_particle(shape, dim)
    wanted, V = field.copy(), (2.0, -3.0, 0.5)[:dim]
    T = (1.0, 2.0, 3.0, -0.4, 0.7, 0.2)[: 2 * dim]
    c = columns(T)
    wanted[nodes] += S[:, None] * np.array(V) + G @ np.array(c)
    give_gradient(along, strides, FIRST, field, V, c)
    np.testing.assert_allclose(field, wanted, rtol=1e-14, atol=1e-15)
    full = [[T[0], T[3]], [T[3], T[1]]] if dim == 2 else None
    full = full or [[T[0], T[3], T[5]], [T[3], T[1], T[4]], [T[5], T[4], T[2]]]
    np.testing.assert_array_equal(np.array(c).T, full)


@EVERYWHERE
def test_what_particles_receive(shape, dim):
    along, S, G, strides, nodes, field = one_particle(shape, dim)
    value, slopes = take_both(along, strides, FIRST, field)
    np.testing.assert_allclose(value, S @ field[nodes], rtol=1e-13)
    np.testing.assert_allclose(take(along, strides, FIRST, field), value, rtol=1e-13)
    gradient = np.reshape(from_columns(slopes), (dim, dim))
    np.testing.assert_allclose(gradient, field[nodes].T @ G, rtol=1e-13)
