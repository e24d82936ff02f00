"""What a particle with four corners gives to its nodes and takes from them, corner by corner.

The four functions of nodes.py for convected domains (cpdi.py). A corner is a point with the linear
functions of the cell that holds it.
"""

from typing import NamedTuple

from cramp_cli.numerics.kernel import inlined_kernel
from cramp_cli.numerics.vector import dot, plus, times
from cramp_cli.shapes.nodes import all_plus, give, give_gradient, take, take_both

SHARE = 0.25  # of each corner in the weight of its particle


class Corner(NamedTuple):
    """A corner of a particle."""

    cell: tuple  # cells along the axes from the first node of the particle
    linear: tuple  # values and slopes of the linear functions there, a pair of tuples per axis
    slope: tuple  # what it counts in the gradients of its particle: a vector, per cell


class Corners(NamedTuple):
    """All corners of a particle."""

    one: Corner
    two: Corner
    three: Corner
    four: Corner


@inlined_kernel
def give_to(corner, strides, first, field, V):
    """Add N V to the nodes of a corner."""
    give(corner.linear, strides, first + dot(corner.cell, strides), field, V)


@inlined_kernel
def velocity_of(corner, strides, first, field):
    """Return sum N v over the nodes of a corner."""
    return take(corner.linear, strides, first + dot(corner.cell, strides), field)


@inlined_kernel
def force_on(corner, W, T):
    """Return the force on a corner: W + T slope; T is a tuple of columns."""
    return plus(plus(W, corner.slope[0], T[0]), corner.slope[1], T[1])


@give.implement(Corners)
def _(along, strides, first, field, V):
    part = times(V, SHARE)
    give_to(along.one, strides, first, field, part)
    give_to(along.two, strides, first, field, part)
    give_to(along.three, strides, first, field, part)
    give_to(along.four, strides, first, field, part)


@give_gradient.implement(Corners)
def _(along, strides, first, field, W, T):
    part = times(W, SHARE)
    give_to(along.one, strides, first, field, force_on(along.one, part, T))
    give_to(along.two, strides, first, field, force_on(along.two, part, T))
    give_to(along.three, strides, first, field, force_on(along.three, part, T))
    give_to(along.four, strides, first, field, force_on(along.four, part, T))


@take.implement(Corners)
def _(along, strides, first, field):
    one = velocity_of(along.one, strides, first, field)
    two = velocity_of(along.two, strides, first, field)
    three = velocity_of(along.three, strides, first, field)
    four = velocity_of(along.four, strides, first, field)
    return times(plus(plus(one, 1.0, two), 1.0, plus(three, 1.0, four)), SHARE)


@take_both.implement(Corners)
def _(along, strides, first, field):
    one = velocity_of(along.one, strides, first, field)
    two = velocity_of(along.two, strides, first, field)
    three = velocity_of(along.three, strides, first, field)
    four = velocity_of(along.four, strides, first, field)
    mean = times(plus(plus(one, 1.0, two), 1.0, plus(three, 1.0, four)), SHARE)
    lower = all_plus(sloped(along.one, one), sloped(along.two, two))
    return mean, all_plus(lower, all_plus(sloped(along.three, three), sloped(along.four, four)))


@inlined_kernel
def sloped(corner, v):
    """Return what the velocity of a corner adds to the derivatives along the axes (per cell)."""
    return times(v, corner.slope[0]), times(v, corner.slope[1])
