"""Matrices of a particle as tuples of numbers, stored row by row: 4 in the plane, 9 in a solid."""

from math import atan2, cos, sin

from cramp_cli.numerics.dispatch import by_length
from cramp_cli.numerics.vector import added


@by_length
def add_outer(v, g, A):
    """Return the matrix A + v g^T."""


@add_outer.implement(2)
def _(v, g, A):
    return (A[0] + v[0] * g[0], A[1] + v[0] * g[1], A[2] + v[1] * g[0], A[3] + v[1] * g[1])


@add_outer.implement(3)
def _(v, g, A):
    return (
        A[0] + v[0] * g[0], A[1] + v[0] * g[1], A[2] + v[0] * g[2],
        A[3] + v[1] * g[0], A[4] + v[1] * g[1], A[5] + v[1] * g[2],
        A[6] + v[2] * g[0], A[7] + v[2] * g[1], A[8] + v[2] * g[2],
    )  # fmt: skip


@by_length
def zero_matrix(like):
    """Return a matrix of zeros for vectors as long as `like`."""


@zero_matrix.implement(2)
def _(like):
    return (0.0, 0.0, 0.0, 0.0)


@zero_matrix.implement(3)
def _(like):
    return (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@by_length
def matrix(like, a, i):
    """Return row `i` of the array `a` as a tuple as long as the matrix `like`."""


@matrix.implement(4)
def _(like, a, i):
    return (a[i, 0], a[i, 1], a[i, 2], a[i, 3])


@matrix.implement(9)
def _(like, a, i):
    return (
        a[i, 0], a[i, 1], a[i, 2], a[i, 3], a[i, 4], a[i, 5], a[i, 6], a[i, 7], a[i, 8],
    )  # fmt: skip


@by_length
def from_columns(c):
    """Return the matrix with the given columns."""


@from_columns.implement(2)
def _(c):
    return (c[0][0], c[1][0], c[0][1], c[1][1])


@from_columns.implement(3)
def _(c):
    return (
        c[0][0], c[1][0], c[2][0], c[0][1], c[1][1], c[2][1], c[0][2], c[1][2], c[2][2],
    )  # fmt: skip


@by_length
def product(A, B):
    """Return the matrix product A B."""


@product.implement(4)
def _(A, B):
    return (
        A[0] * B[0] + A[1] * B[2], A[0] * B[1] + A[1] * B[3],
        A[2] * B[0] + A[3] * B[2], A[2] * B[1] + A[3] * B[3],
    )  # fmt: skip


@product.implement(9)
def _(A, B):
    return (
        A[0] * B[0] + A[1] * B[3] + A[2] * B[6],
        A[0] * B[1] + A[1] * B[4] + A[2] * B[7],
        A[0] * B[2] + A[1] * B[5] + A[2] * B[8],
        A[3] * B[0] + A[4] * B[3] + A[5] * B[6],
        A[3] * B[1] + A[4] * B[4] + A[5] * B[7],
        A[3] * B[2] + A[4] * B[5] + A[5] * B[8],
        A[6] * B[0] + A[7] * B[3] + A[8] * B[6],
        A[6] * B[1] + A[7] * B[4] + A[8] * B[7],
        A[6] * B[2] + A[7] * B[5] + A[8] * B[8],
    )


@by_length
def increment(dU):
    """Return exp(dU) to second order, the deformation gradient of one step."""


@increment.implement(4)
def _(dU):
    Q = product(dU, dU)
    return (
        1.0 + dU[0] + 0.5 * Q[0], dU[1] + 0.5 * Q[1],
        dU[2] + 0.5 * Q[2], 1.0 + dU[3] + 0.5 * Q[3],
    )  # fmt: skip


@increment.implement(9)
def _(dU):
    Q = product(dU, dU)
    return (
        1.0 + dU[0] + 0.5 * Q[0], dU[1] + 0.5 * Q[1], dU[2] + 0.5 * Q[2],
        dU[3] + 0.5 * Q[3], 1.0 + dU[4] + 0.5 * Q[4], dU[5] + 0.5 * Q[5],
        dU[6] + 0.5 * Q[6], dU[7] + 0.5 * Q[7], 1.0 + dU[8] + 0.5 * Q[8],
    )  # fmt: skip


@by_length
def determinant(A):
    """Return the determinant of a matrix."""


@determinant.implement(4)
def _(A):
    return A[0] * A[3] - A[1] * A[2]


@determinant.implement(9)
def _(A):
    return (
        A[0] * (A[4] * A[8] - A[5] * A[7])
        - A[1] * (A[3] * A[8] - A[5] * A[6])
        + A[2] * (A[3] * A[7] - A[4] * A[6])
    )


@by_length
def solid_matrix(F, zz):
    """Return F with nine components; in a plane problem `zz` is that normal to the plane."""


@solid_matrix.implement(4)
def _(F, zz):
    return (F[0], F[1], 0.0, F[2], F[3], 0.0, 0.0, 0.0, zz)


@solid_matrix.implement(9)
def _(F, zz):
    return F


@by_length
def transposed(A):
    """Return the transposed matrix."""


@transposed.implement(4)
def _(A):
    return (A[0], A[2], A[1], A[3])


@transposed.implement(9)
def _(A):
    return (A[0], A[3], A[6], A[1], A[4], A[7], A[2], A[5], A[8])


@by_length
def rotation_of(F):
    """Return the rotation R of the polar decomposition F = R U."""


@rotation_of.implement(4)
def _(F):
    angle = atan2(F[2] - F[1], F[0] + F[3])
    return (cos(angle), -sin(angle), sin(angle), cos(angle))


@rotation_of.implement(9)
def _(F):
    # Newton's iteration R = (R + R^-T)/2 (Higham 1986): the last passes square the error.
    R = F
    for _ in range(20):
        j = 0.5 / determinant(R)
        new = (
            0.5 * R[0] + j * (R[4] * R[8] - R[5] * R[7]),
            0.5 * R[1] + j * (R[5] * R[6] - R[3] * R[8]),
            0.5 * R[2] + j * (R[3] * R[7] - R[4] * R[6]),
            0.5 * R[3] + j * (R[2] * R[7] - R[1] * R[8]),
            0.5 * R[4] + j * (R[0] * R[8] - R[2] * R[6]),
            0.5 * R[5] + j * (R[1] * R[6] - R[0] * R[7]),
            0.5 * R[6] + j * (R[1] * R[5] - R[2] * R[4]),
            0.5 * R[7] + j * (R[2] * R[3] - R[0] * R[5]),
            0.5 * R[8] + j * (R[0] * R[4] - R[1] * R[3]),
        )
        change = added(new, -1.0, R)
        R = new
        size = 0.0
        for entry in change:
            size += abs(entry)
        if size < 1e-9:  # its square is round-off
            break
    return R
