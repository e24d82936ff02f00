"""Quadratic B-splines on the grid, at the particle's position (Steffen, Kirby, Berzins 2008).

Slopes are continuous, so a particle that passes from cell to cell feels no jump of force.
"""

from math import floor
from typing import NamedTuple

from cramp_cli.numerics.kernel import inlined_kernel
from cramp_cli.numerics.vector import shared_out
from cramp_cli.shapes.shape import (
    along_axis,
    first_node,
    node_steps,
    plane,
    reaches_beyond,
    support,
)


class QuadraticSpline(NamedTuple):
    """A particle is a point."""

    half: tuple  # half size of the particle along each axis, in cells; not used by the values


@support.implement(QuadraticSpline)
def _(shape):
    return 3


@reaches_beyond.implement(QuadraticSpline)
def _(shape):
    return True


@first_node.implement(QuadraticSpline)
def _(shape, axis, x):
    return int(floor(x - 0.5))


@node_steps.implement(QuadraticSpline)
def _(shape, stride):
    return (0, stride, 2 * stride)


@along_axis.implement(QuadraticSpline)
def _(shape, axis, r):
    # The particle is nearest to its second node: 1/2 <= r < 3/2.
    left, right = 1.5 - r, r - 0.5
    first, last = 0.5 * left * left, 0.5 * right * right
    return (first, 1.0 - first - last, last), (-left, left - right, right)


@inlined_kernel
def spline(a):
    """Return the spline at a distance a (cells) from its node."""
    return 0.5 * max(0.0, 1.5 - a) ** 2 - 1.5 * max(0.0, 0.5 - a) ** 2


def _of_a_point(shape, r):
    # Of a point at the edge of a particle that has moved, a node may lie outside those of the
    # particle, with a weight of a few percent: the others take its share.
    return shared_out((spline(abs(r)), spline(abs(r - 1.0)), spline(abs(r - 2.0))))


plane(QuadraticSpline, of_a_point=_of_a_point)
