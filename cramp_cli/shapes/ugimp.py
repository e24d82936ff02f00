"""Uniform GIMP: linear functions averaged over a particle that keeps its initial size.

Bardenhagen and Kober (2004), The generalized interpolation material point method.
"""

from math import floor
from typing import NamedTuple

from cramp_cli.shapes.shape import along_axis, first_node, node_steps, support


class UniformGimp(NamedTuple):
    """A particle is a box of fixed size, at most as large as a cell."""

    half: tuple  # half size of the particle along each axis, in cells, <= 1/2


@support.implement(UniformGimp)
def _(shape):
    return 3


@first_node.implement(UniformGimp)
def _(shape, axis, x):
    return int(floor(x - shape.half[axis]))


@node_steps.implement(UniformGimp)
def _(shape, stride):
    return (0, stride, 2 * stride)


@along_axis.implement(UniformGimp)
def _(shape, axis, r):
    # Up to 1 - l from its first node a particle is linear; beyond, it reaches into the next cell.
    # Written with a maximum, the functions need no branch, which no processor could guess.
    l = shape.half[axis]  # noqa: E741 - the letter of the paper
    beyond = max(0.0, r - (1.0 - l))
    d_last = beyond * (0.5 / l)
    last = 0.5 * beyond * d_last
    return (1.0 - r + last, r - 2.0 * last, last), (d_last - 1.0, 1.0 - 2.0 * d_last, d_last)
