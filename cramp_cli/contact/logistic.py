"""Normals by logistic regression over the particles around a node (Nairn et al. 2020).

The plane n.x + c = 0 that best parts the particles of two bodies: q = -1 for those of a and +1 for
those of b is fitted by f(z) = 2/(1 + exp(-z)) - 1 = tanh(z/2), z = n.x + c, with a small penalty on
n. Places count from the node, in cells. The first guess is twice the linear regression.

J. A. Nairn, C. C. Hammerquist, G. D. Smith, CMAME 362 (2020) 112859.
"""

from math import sqrt, tanh

from cramp_cli.contact.clouds import particle_of
from cramp_cli.numerics.kernel import kernel

PENALTY = 1e-7  # on the square of n, per cell
SAME = 1e-5  # 1 - cos of the angle between two normals that are one
MOST = 15  # iterations


@kernel
def solve(A, b):
    """Return the solution of a symmetric system of three; A: xx, yy, cc, xy, yc, xc."""
    xx, yy, cc, xy, yc, xc = A
    minor_x, minor_y, minor_c = yy * cc - yc * yc, xc * yc - xy * cc, xy * yc - yy * xc
    det = xx * minor_x + xy * minor_y + xc * minor_c
    x = minor_x * b[0] + minor_y * b[1] + minor_c * b[2]
    y = minor_y * b[0] + (xx * cc - xc * xc) * b[1] + (xy * xc - xx * yc) * b[2]
    c = minor_c * b[0] + (xy * xc - xx * yc) * b[1] + (xx * yy - xy * xy) * b[2]
    return x / det, y / det, c / det


@kernel
def add_terms(A, b, w, r, x, y):
    """Return the sums of w X X and r X with those of one particle, X = (x, y, 1)."""
    xx, yy, cc, xy, yc, xc = A
    wx, wy = w * x, w * y
    more = (xx + wx * x, yy + wy * y, cc + w, xy + wx * y, yc + wy, xc + wx)
    return more, (b[0] + r * x, b[1] + r * y, b[2] + r)


@kernel
def fit_plane(clouds, stencil, position, pairs, i, place, width, beta, linear):
    """Return the next n_x, n_y, c: the linear regression, or a step of Gauss and Newton from beta.

    i: the pair; place: of its node (m)
    """
    A = (PENALTY, PENALTY, 0.0, 0.0, 0.0, 0.0)
    rhs = (-PENALTY * beta[0], -PENALTY * beta[1], 0.0)
    for w in range(pairs.around[i]):
        j = pairs.window[i, w]
        for body in range(2):
            q, entry = 2.0 * body - 1.0, clouds.head[pairs.row[j, body]]
            while entry >= 0:
                p = particle_of(stencil, entry)
                x, y = (position[p, 0] - place[0]) / width, (position[p, 1] - place[1]) / width
                f = 0.0 if linear else tanh(0.5 * (beta[0] * x + beta[1] * y + beta[2]))
                phi = 1.0 if linear else 0.5 * (1.0 - f * f)
                A, rhs = add_terms(A, rhs, phi * phi, phi * (q - f), x, y)
                entry = clouds.link[entry]
    step = solve(A, rhs)
    return beta[0] + step[0], beta[1] + step[1], beta[2] + step[2]


@kernel
def logistic_normal(clouds, stencil, position, pairs, i, place, width):
    """Return a vector from body a to body b; that of the linear regression if the fit fails.

    i: the pair, with the window of those around it; place: of its node (m)
    """
    places = (clouds, stencil, position, pairs, i, place, width)
    first = fit_plane(*places, (0.0, 0.0, 0.0), True)
    beta = (2.0 * first[0], 2.0 * first[1], 2.0 * first[2])
    for _ in range(MOST):
        new = fit_plane(*places, beta, False)
        sizes = sqrt((new[0] ** 2 + new[1] ** 2) * (beta[0] ** 2 + beta[1] ** 2))
        turned = 1.0 - (new[0] * beta[0] + new[1] * beta[1]) / sizes
        if not turned < 2.1:  # no number
            return first[0], first[1]
        beta = new
        if turned < SAME:
            break
    return beta[0], beta[1]
