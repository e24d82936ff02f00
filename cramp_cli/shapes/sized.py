"""Particles of one kind, each of a size of its own: those at the border of a body are parts.

Where the border passes, a particle is smaller than the others, or has a sliver beside it as well.
With the size of a full one it would reach beyond the body and into its neighbours, and a uniform
stress would not be in balance at the nodes around. All else is asked of the kind itself, with the
size of the particle; where all particles are full, the kind serves alone, at no cost.
"""

from typing import Any, NamedTuple

from cramp_cli.numerics.dispatch import generic
from cramp_cli.numerics.vector import vector
from cramp_cli.shapes.cpdi import ConvectedDomain
from cramp_cli.shapes.ring import Ring
from cramp_cli.shapes.shape import (
    at_point,
    factors,
    gradients,
    has_domain,
    node_steps,
    own_shape,
    place_of,
    plane,
    point_weights,
    reaches_beyond,
    support,
    weights,
)
from cramp_cli.shapes.ugimp import UniformGimp


class Sized(NamedTuple):
    """A kind of particles whose half sizes are in the stencil."""

    plain: Any  # record of the kind, with the half size of a full particle
    half: tuple  # that one, in cells


class Box(NamedTuple):
    """Where a particle is, in cells from its first node, and how large."""

    x: float
    y: float
    half: tuple  # half size along each axis, in cells


@generic
def with_half(shape, half):
    """Return the shape for particles of half size `half` (cells)."""


@generic
def placed(kind, strides, stencil, p):
    """Return where a particle of a kind is: its box, or its domain."""


@with_half.implement(Sized)
def _(shape, half):
    return with_half(shape.plain, half)


@with_half.implement(UniformGimp)
def _(shape, half):
    return UniformGimp(half)


@with_half.implement(ConvectedDomain)
def _(shape, half):
    return ConvectedDomain(half)


@with_half.implement(Ring)
def _(shape, half):
    return Ring(with_half(shape.plain, half), half, shape.axis, shape.columns, shape.radius)


@placed.implement(UniformGimp)
def _(kind, strides, stencil, p):
    x = vector(strides, stencil.local, p)
    return Box(x[0], x[1], vector(kind.half, stencil.half, p))


@placed.implement(ConvectedDomain)
def _(kind, strides, stencil, p):
    return place_of(kind, strides, stencil, p)


plane(Sized)


@own_shape.implement(Sized)
def _(shape, stencil, p):
    return with_half(shape.plain, vector(shape.half, stencil.half, p))


@place_of.implement(Sized)
def _(shape, strides, stencil, p):
    return placed(shape.plain, strides, stencil, p)


@support.implement(Sized)
def _(shape):
    return support(shape.plain)


@reaches_beyond.implement(Sized)
def _(shape):
    return reaches_beyond(shape.plain)


@has_domain.implement(Sized)
def _(shape):
    return has_domain(shape.plain)


@node_steps.implement(Sized)
def _(shape, stride):
    return node_steps(shape.plain, stride)


@at_point.implement(Sized)
def _(shape, r):
    return at_point(shape.plain, r)


@factors.implement(Box)
def _(place, shape):
    return factors((place.x, place.y), with_half(shape, place.half))


@weights.implement(Box)
def _(place, shape):
    return weights((place.x, place.y), with_half(shape, place.half))


@gradients.implement(Box)
def _(place, shape):
    return gradients((place.x, place.y), with_half(shape, place.half))


@point_weights.implement(Box)
def _(place, shape, away):
    return point_weights((place.x, place.y), with_half(shape, place.half), away)
