"""Vectors and other tuples of numbers: no allocation, any dimension.

A vector is a tuple of 2 or 3 numbers. Functions for tuples of any length go through them entry by
entry; the recursion ends when numba compiles.
"""

from math import floor

from cramp_cli.numerics.dispatch import by_length


@by_length
def scaled(a, s):
    """Return every entry of the tuple `a` times `s`."""
    return (a[0] * s,) + scaled(a[1:], s)


@scaled.implement(1)
def _(a, s):
    return (a[0] * s,)


@by_length
def shifted(a, s):
    """Return every entry of the tuple `a` plus `s`."""
    return (a[0] + s,) + shifted(a[1:], s)


@shifted.implement(1)
def _(a, s):
    return (a[0] + s,)


@by_length
def added(a, s, b):
    """Return a + s b for tuples of any length."""
    return (a[0] + s * b[0],) + added(a[1:], s, b[1:])


@added.implement(1)
def _(a, s, b):
    return (a[0] + s * b[0],)


@by_length
def total(a):
    """Return the sum of the entries of a tuple."""
    return a[0] + total(a[1:])


@total.implement(1)
def _(a):
    return a[0]


@by_length
def shared_out(a):
    """Return a tuple in proportion to `a` whose entries sum to 1."""
    return scaled(a, 1.0 / total(a))


@by_length
def store(values, a, i, at):
    """Write the tuple `values` to row `i` of the array `a`, from column `at` on."""
    a[i, at] = values[0]
    store(values[1:], a, i, at + 1)


@store.implement(0)
def _(values, a, i, at):
    pass


@by_length
def in_cells(x, lower, width):
    """Return the place x (m) counted in cells from the lower corner of the grid."""
    return ((x[0] - lower[0]) / width,) + in_cells(x[1:], lower[1:], width)


@in_cells.implement(1)
def _(x, lower, width):
    return ((x[0] - lower[0]) / width,)


@by_length
def whole(x):
    """Return the whole numbers not above those of the tuple x."""
    return (int(floor(x[0])),) + whole(x[1:])


@whole.implement(1)
def _(x):
    return (int(floor(x[0])),)


@by_length
def within(first, count, limits):
    """Return whether `count` whole numbers from each of `first` on lie between 0 and its limit."""
    return 0 <= first[0] <= limits[0] - count and within(first[1:], count, limits[1:])


@within.implement(1)
def _(first, count, limits):
    return 0 <= first[0] <= limits[0] - count


@by_length
def outer(b, a):
    """Return all products a_i b_j as one flat tuple, `a` running fastest."""
    return scaled(a, b[0]) + outer(b[1:], a)


@outer.implement(1)
def _(b, a):
    return scaled(a, b[0])


@by_length
def outer_sum(b, a):
    """Return all sums a_i + b_j as one flat tuple, `a` running fastest."""
    return shifted(a, b[0]) + outer_sum(b[1:], a)


@outer_sum.implement(1)
def _(b, a):
    return shifted(a, b[0])


@by_length
def vector(like, a, i):
    """Return row `i` of the array `a` as a tuple as long as `like`."""


@vector.implement(2)
def _(like, a, i):
    return (a[i, 0], a[i, 1])


@vector.implement(3)
def _(like, a, i):
    return (a[i, 0], a[i, 1], a[i, 2])


@by_length
def vector_of(like, a, i, j):
    """Return the vector in row `i`, place `j` of the array `a` as a tuple as long as `like`."""


@vector_of.implement(2)
def _(like, a, i, j):
    return (a[i, j, 0], a[i, j, 1])


@vector_of.implement(3)
def _(like, a, i, j):
    return (a[i, j, 0], a[i, j, 1], a[i, j, 2])


@by_length
def pick(axes, k):
    """Return entry `k` of each of the tuples in `axes`."""


@pick.implement(2)
def _(axes, k):
    return (axes[0][k], axes[1][k])


@pick.implement(3)
def _(axes, k):
    return (axes[0][k], axes[1][k], axes[2][k])


@by_length
def plus(a, s, b):
    """Return a + s b."""


@plus.implement(2)
def _(a, s, b):
    return (a[0] + s * b[0], a[1] + s * b[1])


@plus.implement(3)
def _(a, s, b):
    return (a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2])


@by_length
def dot(a, b):
    """Return the scalar product of two vectors."""


@dot.implement(2)
def _(a, b):
    return a[0] * b[0] + a[1] * b[1]


@dot.implement(3)
def _(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@by_length
def times(v, number):
    """Return the vector `v` times a number."""


@times.implement(1)
def _(v, number):
    return (v[0] * number,)


@times.implement(2)
def _(v, number):
    return (v[0] * number, v[1] * number)


@times.implement(3)
def _(v, number):
    return (v[0] * number, v[1] * number, v[2] * number)
