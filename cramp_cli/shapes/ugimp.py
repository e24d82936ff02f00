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
    l = shape.half[axis]  # noqa: E741 - the letter of the paper
    if r <= 1.0 - l:
        first, d_first = 1.0 - r, -1.0
    else:
        reach = 1.0 + l - r
        first, d_first = reach * reach * (0.25 / l), -reach * (0.5 / l)
    if r > 1.0 - l:
        reach = r - (1.0 - l)
        last, d_last = reach * reach * (0.25 / l), reach * (0.5 / l)
    else:
        last, d_last = 0.0, 0.0
    return (first, 1.0 - first - last, last), (d_first, -d_first - d_last, d_last)
