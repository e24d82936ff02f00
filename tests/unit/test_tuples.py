"""Tensors as tuples against numpy, plain and compiled, in two and three dimensions."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import expm, polar

from cramp_cli.numerics import matrix as mat
from cramp_cli.numerics import symmetric as sym
from cramp_cli.numerics import vector as vec
from cramp_cli.numerics.kernel import kernel

DIMENSIONS = pytest.mark.parametrize("dim", [2, 3])
ROUND_OFF = 1e-15  # of sums of a few numbers below 1 in size
PLACES = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))  # xx, yy, zz, xy, yz, xz


def numbers(*shape, seed=1):
    """Return numbers between -1 and 1."""
    return np.random.default_rng(seed).uniform(-1.0, 1.0, shape)


def flat(a):
    return tuple(np.ravel(a).tolist())


def square(values):
    """Return a matrix of a tuple of 4 or 9 entries, or the symmetric one of 6."""
    values = np.array(values)
    if len(values) != 6:
        return values.reshape(int(len(values) ** 0.5), -1)
    full = np.zeros((3, 3))
    for value, (i, j) in zip(values, PLACES, strict=True):
        full[i, j] = full[j, i] = value
    return full


def solid(A):
    """Return a matrix of the plane with nothing normal to it, or that of the solid as it is."""
    full = np.zeros((3, 3))
    full[: len(A), : len(A)] = A
    return full


def stresses(dim, seed=7):
    """Return one row of stress as particles hold it, and the same as a matrix of the solid."""
    row = numbers(1, 4 if dim == 2 else 6, seed=seed)
    return row, square(np.concatenate([row[0], np.zeros(6 - row.shape[1])]))


def close(got, wanted):
    np.testing.assert_allclose(np.ravel(got), np.ravel(wanted), rtol=0.0, atol=4 * ROUND_OFF)


@DIMENSIONS
def test_vectors(dim):
    a, b = numbers(2, dim)
    A = numbers(dim, dim, seed=2)
    close(vec.plus(flat(a), 0.3, flat(b)), a + 0.3 * b)
    close(vec.times(flat(a), -2.0), -2.0 * a)
    close(vec.scaled(flat(A), 0.7), 0.7 * A)
    close(vec.dot(flat(a), flat(b)), a @ b)
    close(mat.add_outer(flat(a), flat(b), flat(A)), A + np.outer(a, b))
    close(mat.zero_matrix(flat(a)), np.zeros((dim, dim)))


@pytest.mark.parametrize(("m", "n"), [(1, 1), (2, 2), (3, 3), (3, 9), (4, 2)])
def test_all_products_and_sums_run_fastest_over_the_second_tuple(m, n):
    b, a = numbers(m, seed=3), numbers(n, seed=4)
    close(vec.outer(flat(b), flat(a)), np.outer(b, a))
    close(vec.outer_sum(flat(b), flat(a)), np.add.outer(b, a))


@DIMENSIONS
def test_rows_of_arrays(dim):
    like, vectors, matrices = (0.0,) * dim, numbers(4, dim), numbers(4, dim * dim, seed=2)
    assert vec.vector(like, vectors, 2) == flat(vectors[2])
    assert mat.matrix((0.0,) * dim**2, matrices, 3) == flat(matrices[3])
    assert sym.symmetric(like, numbers(4, 6), 1) == flat(numbers(4, 6)[1, : 4 if dim == 2 else 6])
    assert vec.pick(tuple(map(flat, vectors.T)), 1) == flat(vectors[1])


@DIMENSIONS
def test_symmetric_tensor_times_vector(dim):
    row, T = stresses(dim)
    g = numbers(dim)
    close(sym.apply(flat(g), flat(row)), (T[:dim, :dim] @ g))


@DIMENSIONS
def test_matrices(dim):
    A, B = numbers(2, dim, dim)
    close(mat.product(flat(A), flat(B)), A @ B)
    close(mat.determinant(flat(A)), np.linalg.det(A))


@DIMENSIONS
def test_increment_is_the_exponential_to_second_order(dim):
    """What is left out is bounded by |dU|^3 / 6 exp |dU|, the rest of the series."""
    dU = 1e-2 * numbers(dim, dim)
    size = np.linalg.norm(dU, 2)
    wrong = np.linalg.norm(square(mat.increment(flat(dU))) - expm(dU), 2)
    assert 0.0 < wrong < size**3 / 6.0 * np.exp(size)


@DIMENSIONS
def test_strain_is_the_symmetric_part(dim):
    dU = numbers(dim, dim)
    wanted = solid(0.5 * (dU + dU.T))
    if dim == 2:
        wanted[2, 2] = 0.4
    close(square(sym.solid_strain(flat(dU), 0.4)), wanted)


@DIMENSIONS
def test_turn_rotates_stress_by_the_cayley_transform_of_the_spin(dim):
    """R = (1 - W/2)^-1 (1 + W/2) with W = (dU - dU^T)/2 (Hughes and Winget 1980)."""
    dU = numbers(dim, dim)
    row, T = stresses(dim)
    W = solid(0.5 * (dU - dU.T))
    R = np.linalg.solve(np.eye(3) - 0.5 * W, np.eye(3) + 0.5 * W)
    close(square(sym.turn(flat(dU), sym.six(flat(dU), row, 0, 0))), R @ T @ R.T)


@DIMENSIONS
def test_turn_is_the_rotation_of_the_spin_to_second_order(dim):
    """tan(angle/2) = w/2: the angle is short of the spin w by w^3/12; twice that times stress."""
    dU = 0.02 * numbers(dim, dim)
    row, T = stresses(dim)
    W = solid(0.5 * (dU - dU.T))
    w = np.linalg.norm(W, 2)
    wrong = square(sym.turn(flat(dU), sym.six(flat(dU), row, 0, 0))) - expm(W) @ T @ expm(W).T
    assert np.linalg.norm(wrong, 2) < 1.01 * w**3 / 6.0 * np.linalg.norm(T, 2)


@settings(max_examples=50)
@given(st.lists(st.floats(-10.0, 10.0), min_size=9, max_size=9))
def test_any_turn_keeps_the_principal_stresses(entries):
    """A rotation leaves eigenvalues alone; sums of nine products of numbers below 1, twice."""
    for dim in (2, 3):
        row, T = stresses(dim)
        dU = tuple(entries[: dim * dim])
        turned = square(sym.turn(dU, sym.six(dU, row, 0, 0)))
        np.testing.assert_allclose(
            np.linalg.eigvalsh(turned), np.linalg.eigvalsh(T), rtol=0.0, atol=30 * ROUND_OFF
        )


def test_work_is_the_mean_stress_times_the_strain():
    a, b, strain = (flat(numbers(6, seed=n)) for n in (1, 2, 3))
    wanted = 0.5 * np.sum((square(a) + square(b)) * square(strain))
    assert sym.work_of(a, b, strain) == pytest.approx(wanted, abs=8 * ROUND_OFF)


@pytest.mark.parametrize("angle", [0.0, 0.4, 2.0, -3.0])
def test_rotation_of_a_deformation(angle):
    """The polar decomposition F = R U of scipy."""
    turned = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    F = turned @ np.array([[1.3, 0.2], [0.2, 0.8]])
    close(mat.rotation_of(flat(F)), polar(F)[0])


@kernel
def _all_of_them(v, g, A, stress, strain, like):
    """Use every function that has a body for each dimension."""
    T = sym.symmetric(v, stress, 0)
    u = vec.plus(vec.times(v, 0.5), vec.dot(v, g), sym.apply(g, T))
    B = mat.add_outer(u, g, mat.product(A, mat.increment(A)))
    turned = sym.turn(A, sym.six(A, stress, 0, 0))
    work = sym.work_of(turned, sym.solid_strain(B, 0.1), strain)
    return (
        vec.scaled(vec.outer(u, B), mat.determinant(B)),
        vec.outer_sum(g, mat.zero_matrix(v)),
        work,
    )


@DIMENSIONS
def test_compiled_and_plain_bodies_agree(dim):
    """Numba may fuse a product and a sum, so the last bits differ."""
    row, _ = stresses(dim)
    v, g, A = flat(numbers(dim)), flat(numbers(dim, seed=2)), flat(numbers(dim, dim, seed=3))
    arguments = (v, g, A, row, flat(numbers(6, seed=4)), v)
    plain = getattr(_all_of_them, "py_func", _all_of_them)
    for got, wanted in zip(_all_of_them(*arguments), plain(*arguments), strict=True):
        np.testing.assert_allclose(got, wanted, rtol=1e-13, atol=1e-14)
