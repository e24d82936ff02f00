"""Symmetric tensors of a particle as tuples of numbers: stress and strain.

Their order is xx, yy, zz, xy, yz, xz, of which a plane problem keeps the first four.
"""

from cramp_cli.numerics.dispatch import by_length
from cramp_cli.numerics.matrix import product, transposed


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
