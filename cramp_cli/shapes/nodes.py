"""What a particle away from cracks gives to its nodes and takes from them.

Weights are products of one factor per axis, so all sums go axis by axis: the nodes of a line along
x, which follow each other in memory, the lines of a plane, the planes of a box. That takes half the
arithmetic of a list of nodes, and no list. The recursions end when numba compiles.

Of all functions: factors is a pair of tuples per axis, values and slopes (per cell) at the nodes of
that axis (shapes/shape.py); strides: steps in node number along the axes; first: the lowest node of
the particle; field: a (rows, dim) array. An index of type `uint64` is known not to count from the
end of an array, which would be asked at every access.
"""

from numpy import uint64

from cramp_cli.numerics.dispatch import by_length
from cramp_cli.numerics.vector import plus, times, vector


@by_length
def give(factors, strides, first, field, V):
    """Add S V to the nodes; V is a vector."""
    values = factors[-1][0]
    give_in_turn(values, factors[:-1], strides, first, field, V)


@give.implement(1)
def _(factors, strides, first, field, V):
    give_to_line(factors[0][0], first, field, V)


@by_length
def give_in_turn(values, inner, strides, first, field, V):
    """Give along the last axis: to each line, or plane, its share of V."""
    give(inner, strides, first, field, times(V, values[0]))
    give_in_turn(values[1:], inner, strides, first + strides[len(inner)], field, V)


@give_in_turn.implement(1)
def _(values, inner, strides, first, field, V):
    give(inner, strides, first, field, times(V, values[0]))


@by_length
def give_to_line(values, row, field, V):
    """Add S V to the nodes of a line."""
    add_to(V, field, row, values[0])
    give_to_line(values[1:], row + 1, field, V)


@give_to_line.implement(1)
def _(values, row, field, V):
    add_to(V, field, row, values[0])


@by_length
def add_to(V, field, row, s):
    """Add s V to a row of the field."""


@add_to.implement(1)
def _(V, field, row, s):
    field[uint64(row)] += s * V[0]


@add_to.implement(2)
def _(V, field, row, s):
    i = uint64(row)
    field[i, 0] += s * V[0]
    field[i, 1] += s * V[1]


@add_to.implement(3)
def _(V, field, row, s):
    i = uint64(row)
    field[i, 0] += s * V[0]
    field[i, 1] += s * V[1]
    field[i, 2] += s * V[2]


@by_length
def give_gradient(factors, strides, first, field, W, T):
    """Add S W + T grad S to the nodes; T is a tuple of columns, one for every axis."""
    give_gradient_in_turn(*factors[-1], factors[:-1], strides, first, field, W, T)


@give_gradient.implement(1)
def _(factors, strides, first, field, W, T):
    give_gradient_to_line(*factors[0], first, field, W, T[0])


@by_length
def give_gradient_in_turn(values, slopes, inner, strides, first, field, W, T):
    """Give along the last axis: its slope passes one column of T on as a vector."""
    pass_on(values, slopes, inner, strides, first, field, W, T)
    above = first + strides[len(inner)]
    give_gradient_in_turn(values[1:], slopes[1:], inner, strides, above, field, W, T)


@give_gradient_in_turn.implement(1)
def _(values, slopes, inner, strides, first, field, W, T):
    pass_on(values, slopes, inner, strides, first, field, W, T)


@by_length
def pass_on(values, slopes, inner, strides, first, field, W, T):
    """Give the first line, or plane, of an axis what is its."""
    both = plus(times(W, values[0]), slopes[0], T[-1])
    give_gradient(inner, strides, first, field, both, all_times(T[:-1], values[0]))


@by_length
def all_times(vectors, s):
    """Return a tuple of vectors, each times s."""
    return (times(vectors[0], s),) + all_times(vectors[1:], s)


@all_times.implement(1)
def _(vectors, s):
    return (times(vectors[0], s),)


@by_length
def give_gradient_to_line(values, slopes, row, field, W, t):
    """Add S W + dS/dx t to the nodes of a line."""
    add_to(plus(times(W, values[0]), slopes[0], t), field, row, 1.0)
    give_gradient_to_line(values[1:], slopes[1:], row + 1, field, W, t)


@give_gradient_to_line.implement(1)
def _(values, slopes, row, field, W, t):
    add_to(plus(times(W, values[0]), slopes[0], t), field, row, 1.0)


@by_length
def take(factors, strides, first, field):
    """Return sum S v over the nodes, a vector."""
    return take_in_turn(factors[-1][0], factors[:-1], strides, first, field)


@take.implement(1)
def _(factors, strides, first, field):
    return take_from_line(factors[0][0], strides, first, field)


@by_length
def take_in_turn(values, inner, strides, first, field):
    """Take along the last axis."""
    below = times(take(inner, strides, first, field), values[0])
    above = take_in_turn(values[1:], inner, strides, first + strides[len(inner)], field)
    return plus(below, 1.0, above)


@take_in_turn.implement(1)
def _(values, inner, strides, first, field):
    return times(take(inner, strides, first, field), values[0])


@by_length
def take_from_line(values, like, row, field):
    """Return sum S v over the nodes of a line; vectors are as long as `like`."""
    rest = take_from_line(values[1:], like, row + 1, field)
    return plus(rest, values[0], vector(like, field, uint64(row)))


@take_from_line.implement(1)
def _(values, like, row, field):
    return times(vector(like, field, uint64(row)), values[0])


@by_length
def take_both(factors, strides, first, field):
    """Return sum S v and the tuple of its derivatives along the axes (per cell)."""
    return take_both_in_turn(*factors[-1], factors[:-1], strides, first, field)


@take_both.implement(1)
def _(factors, strides, first, field):
    value, slope = take_both_from_line(*factors[0], strides, first, field)
    return value, (slope,)


@by_length
def take_both_in_turn(values, slopes, inner, strides, first, field):
    """Take along the last axis, whose slope makes a derivative of each value."""
    value, slope = share_of(values, slopes, inner, strides, first, field)
    above = first + strides[len(inner)]
    rest, more = take_both_in_turn(values[1:], slopes[1:], inner, strides, above, field)
    return plus(value, 1.0, rest), all_plus(slope, more)


@take_both_in_turn.implement(1)
def _(values, slopes, inner, strides, first, field):
    return share_of(values, slopes, inner, strides, first, field)


@by_length
def share_of(values, slopes, inner, strides, first, field):
    """Return what the first line, or plane, of an axis adds to value and derivatives."""
    value, derivatives = take_both(inner, strides, first, field)
    new = (times(value, slopes[0]),)
    return times(value, values[0]), all_times(derivatives, values[0]) + new


@by_length
def all_plus(a, b):
    """Return the sums of the vectors of two tuples."""
    return (plus(a[0], 1.0, b[0]),) + all_plus(a[1:], b[1:])


@all_plus.implement(1)
def _(a, b):
    return (plus(a[0], 1.0, b[0]),)


@by_length
def take_both_from_line(values, slopes, like, row, field):
    """Return sum S v and sum dS/dx v over the nodes of a line."""
    rest, more = take_both_from_line(values[1:], slopes[1:], like, row + 1, field)
    v = vector(like, field, uint64(row))
    return plus(rest, values[0], v), plus(more, slopes[0], v)


@take_both_from_line.implement(1)
def _(values, slopes, like, row, field):
    v = vector(like, field, uint64(row))
    return times(v, values[0]), times(v, slopes[0])
