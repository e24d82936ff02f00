"""Uniform GIMP: linear functions averaged over a particle that keeps its initial size.

Bardenhagen and Kober (2004), The generalized interpolation material point method.
"""

from math import floor
from typing import NamedTuple

from cramp_cli.shapes.shape import (
    along_axis,
    first_node,
    node_steps,
    plane,
    reaches_beyond,
    support,
)


class UniformGimp(NamedTuple):
    """A particle is a box of fixed size, at most as large as a cell."""

    half: tuple  # half size of the particle along each axis, in cells, <= 1/2


@support.implement(UniformGimp)
def _(shape):
    return 3


@reaches_beyond.implement(UniformGimp)
def _(shape):
    return False


@first_node.implement(UniformGimp)
def _(shape, axis, x):
    return int(floor(x - shape.half[axis]))


@node_steps.implement(UniformGimp)
def _(shape, stride):
    return (0, stride, 2 * stride)


@along_axis.implement(UniformGimp)
def _(shape, axis, r):
    # Up to 1 - l from its first node a particle is linear; beyond, it reaches into the next cell.
    # Written with maxima, the functions need no branch, which no processor could guess. Where a
    # particle hardly sees its first or last node, value and slope come from the same small number:
    # their ratio decides whether schemes without a second extrapolation are stable.
    l = shape.half[axis]  # noqa: E741 - the letter of the paper
    left = 1.0 + l - r
    within = min(left, 2.0 * l)
    beyond = max(0.0, r - (1.0 - l))
    d_first, d_last = within * (0.5 / l), beyond * (0.5 / l)
    first, last = 0.5 * within * d_first + (left - within), 0.5 * beyond * d_last
    return (first, 1.0 - first - last, last), (-d_first, d_first - d_last, d_last)


def _in_a_ring(shape, slopes, radius):
    # The mean of N' with the weight r over a box of half size l around the radius R: where a share
    # a of the box lies in the cell of a node, its slope +-a becomes +-a (1 -+ (1 - a) l/R).
    a, b, weight = -slopes[0], slopes[2], shape.half[0] / radius
    first, last = a * (1.0 - a) * weight, b * (1.0 - b) * weight
    return (first - a, a - b - first - last, b + last)


plane(UniformGimp, slopes_in_a_ring=_in_a_ring)
