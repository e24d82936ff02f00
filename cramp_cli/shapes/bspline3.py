"""Cubic B-splines on the grid, at the particle's position (Steffen, Kirby, Berzins 2008)."""

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


class CubicSpline(NamedTuple):
    """A particle is a point."""

    half: tuple  # half size of the particle along each axis, in cells; not used by the values


@support.implement(CubicSpline)
def _(shape):
    return 4


@reaches_beyond.implement(CubicSpline)
def _(shape):
    return True


@first_node.implement(CubicSpline)
def _(shape, axis, x):
    return int(floor(x)) - 1


@node_steps.implement(CubicSpline)
def _(shape, stride):
    return (0, stride, 2 * stride, 3 * stride)


@along_axis.implement(CubicSpline)
def _(shape, axis, r):
    # The particle is between its second and its third node: 1 <= r < 2.
    left, right = 2.0 - r, r - 1.0
    d_first, d_last = -0.5 * left * left, 0.5 * right * right
    first, last = left * left * left / 6.0, right * right * right / 6.0
    second = 2.0 / 3.0 - right * right * (1.0 - 0.5 * right)
    d_second = right * (1.5 * right - 2.0)
    values = (first, second, 1.0 - first - second - last, last)
    return values, (d_first, d_second, -d_first - d_second - d_last, d_last)


@inlined_kernel
def spline(a):
    """Return the spline at a distance a (cells) from its node."""
    return (max(0.0, 2.0 - a) ** 3 - 4.0 * max(0.0, 1.0 - a) ** 3) / 6.0


def _of_a_point(shape, r):
    # Of a point at the edge of a particle that has moved, a node may lie outside those of the
    # particle, with a weight of a few percent: the others take its share.
    first, second = spline(abs(r)), spline(abs(r - 1.0))
    return shared_out((first, second, spline(abs(r - 2.0)), spline(abs(r - 3.0))))


plane(CubicSpline, of_a_point=_of_a_point)
