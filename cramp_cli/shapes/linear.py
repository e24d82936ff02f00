"""Classic MPM: linear shape functions at the particle's position (Sulsky, Chen, Schreyer 1994)."""

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


class Linear(NamedTuple):
    """A particle is a point."""

    half: tuple  # half size of the particle along each axis, in cells; not used by the values


plane(Linear)


@support.implement(Linear)
def _(shape):
    return 2


@reaches_beyond.implement(Linear)
def _(shape):
    return False


@first_node.implement(Linear)
def _(shape, axis, x):
    return int(floor(x))


@node_steps.implement(Linear)
def _(shape, stride):
    return (0, stride)


@along_axis.implement(Linear)
def _(shape, axis, r):
    return (1.0 - r, r), (-1.0, 1.0)
