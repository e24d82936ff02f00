"""Cubic B-splines on the grid, at the particle's position (Steffen, Kirby, Berzins 2008)."""

from math import floor
from typing import NamedTuple

from cramp_cli.shapes.shape import along_axis, first_node, node_steps, reaches_beyond, support


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
