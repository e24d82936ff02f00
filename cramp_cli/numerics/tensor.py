"""Tensors of a particle as tuples of numbers: no allocation, any dimension.

A matrix is stored row by row (4 or 9 numbers); a symmetric tensor in the order xx, yy, zz, xy, yz,
xz, of which a plane problem keeps the first four.
"""

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
def kept(like, T):
    """Return the components that are stored of a symmetric tensor of six; `like` is a matrix."""


@kept.implement(4)
def _(like, T):
    return T[:4]


@kept.implement(9)
def _(like, T):
    return T


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
def symmetric(like, a, i):
    """Return row `i` of an array of symmetric tensors: 4 components for vectors of 2, 6 for 3."""


@symmetric.implement(2)
def _(like, a, i):
    return (a[i, 0], a[i, 1], a[i, 2], a[i, 3])


@symmetric.implement(3)
def _(like, a, i):
    return (a[i, 0], a[i, 1], a[i, 2], a[i, 3], a[i, 4], a[i, 5])


@by_length
def apply(g, T):
    """Return the symmetric tensor T (as read by `symmetric`) times the vector `g`."""


@apply.implement(2)
def _(g, T):
    return (T[0] * g[0] + T[3] * g[1], T[3] * g[0] + T[1] * g[1])


@apply.implement(3)
def _(g, T):
    return (
        T[0] * g[0] + T[3] * g[1] + T[5] * g[2],
        T[3] * g[0] + T[1] * g[1] + T[4] * g[2],
        T[5] * g[0] + T[4] * g[1] + T[2] * g[2],
    )


@by_length
def columns(T):
    """Return the columns of the plane part of a symmetric tensor of four, or of one of six."""


@columns.implement(4)
def _(T):
    return ((T[0], T[3]), (T[3], T[1]))


@columns.implement(6)
def _(T):
    return ((T[0], T[3], T[5]), (T[3], T[1], T[4]), (T[5], T[4], T[2]))


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
def solid_strain(dU, zz):
    """Return the strain step (xx, yy, zz, xy, yz, xz; tensor shear) of the gradient step dU.

    In a plane problem the strain step normal to the plane is `zz`; in a solid it is part of dU.
    """


@solid_strain.implement(4)
def _(dU, zz):
    return (dU[0], dU[3], zz, 0.5 * (dU[1] + dU[2]), 0.0, 0.0)


@solid_strain.implement(9)
def _(dU, zz):
    return (
        dU[0], dU[4], dU[8],
        0.5 * (dU[1] + dU[3]), 0.5 * (dU[5] + dU[7]), 0.5 * (dU[2] + dU[6]),
    )  # fmt: skip


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
def six(dU, a, i, at):
    """Return the symmetric tensor in row `i` of the array `a`, from column `at` on.

    It has six components; for the dU of a plane problem yz and xz are zero and not read.
    """


@six.implement(4)
def _(dU, a, i, at):
    return (a[i, at], a[i, at + 1], a[i, at + 2], a[i, at + 3], 0.0, 0.0)


@six.implement(9)
def _(dU, a, i, at):
    return (a[i, at], a[i, at + 1], a[i, at + 2], a[i, at + 3], a[i, at + 4], a[i, at + 5])


@by_length
def turn(dU, T):
    """Return the symmetric tensor T (six components) turned by the rotation of the step dU.

    The rotation is the Cayley transform of the spin: orthogonal to round-off, so a spinning body
    keeps its stress (Hughes and Winget 1980). In a plane problem yz and xz of T are zero.
    """


@turn.implement(4)
def _(dU, T):
    half = 0.25 * (dU[2] - dU[1])
    scale = 1.0 / (1.0 + half * half)
    c, s = (1.0 - half * half) * scale, 2.0 * half * scale
    xx, yy, zz, xy = T[0], T[1], T[2], T[3]
    cc, ss, cs = c * c, s * s, c * s
    return (
        cc * xx + ss * yy - 2.0 * cs * xy,
        ss * xx + cc * yy + 2.0 * cs * xy,
        zz,
        cs * (xx - yy) + (cc - ss) * xy,
        0.0,
        0.0,
    )


@turn.implement(9)
def _(dU, T):
    a, b, c = 0.25 * (dU[7] - dU[5]), 0.25 * (dU[2] - dU[6]), 0.25 * (dU[3] - dU[1])
    f = 2.0 / (1.0 + a * a + b * b + c * c)
    R = (
        1.0 - f * (b * b + c * c), f * (a * b - c), f * (a * c + b),
        f * (a * b + c), 1.0 - f * (a * a + c * c), f * (b * c - a),
        f * (a * c - b), f * (b * c + a), 1.0 - f * (a * a + b * b),
    )  # fmt: skip
    return congruent(R, T)


@by_length
def congruent(R, T):
    """Return R T R^T for a matrix of nine and a symmetric tensor of six components."""


@congruent.implement(9)
def _(R, T):
    xx, yy, zz, xy, yz, xz = T
    A = product(product(R, (xx, xy, xz, xy, yy, yz, xz, yz, zz)), transposed(R))
    return (A[0], A[4], A[8], A[1], A[5], A[2])


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
def left_cauchy_green(F):
    """Return b = F F^T of a matrix of nine components, as six."""


@left_cauchy_green.implement(9)
def _(F):
    return (
        F[0] * F[0] + F[1] * F[1] + F[2] * F[2],
        F[3] * F[3] + F[4] * F[4] + F[5] * F[5],
        F[6] * F[6] + F[7] * F[7] + F[8] * F[8],
        F[0] * F[3] + F[1] * F[4] + F[2] * F[5],
        F[3] * F[6] + F[4] * F[7] + F[5] * F[8],
        F[0] * F[6] + F[1] * F[7] + F[2] * F[8],
    )


@by_length
def squared(T):
    """Return T T of a symmetric tensor of six components."""


@squared.implement(6)
def _(T):
    return left_cauchy_green((T[0], T[3], T[5], T[3], T[1], T[4], T[5], T[4], T[2]))


@by_length
def deviator(T):
    """Return a symmetric tensor of six components without its mean."""


@deviator.implement(6)
def _(T):
    mean = (T[0] + T[1] + T[2]) / 3.0
    return (T[0] - mean, T[1] - mean, T[2] - mean, T[3], T[4], T[5])


@by_length
def square_of(T):
    """Return T : T for a symmetric tensor of six components."""


@square_of.implement(6)
def _(T):
    normal = T[0] * T[0] + T[1] * T[1] + T[2] * T[2]
    return normal + 2.0 * (T[3] * T[3] + T[4] * T[4] + T[5] * T[5])


@by_length
def work_of(a, b, strain):
    """Return (a + b)/2 : strain for symmetric tensors of six components, tensor shear."""
    normal = (a[0] + b[0]) * strain[0] + (a[1] + b[1]) * strain[1] + (a[2] + b[2]) * strain[2]
    shear = (a[3] + b[3]) * strain[3] + (a[4] + b[4]) * strain[4] + (a[5] + b[5]) * strain[5]
    return 0.5 * normal + shear


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
