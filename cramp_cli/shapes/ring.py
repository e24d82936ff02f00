"""Shape functions of a body of revolution: any plane shape, with slopes weighed by the radius.

A particle is a ring. Forces and strains are integrals over its volume 2 pi r dA, so the gradient of
a GIMP function is its mean with the weight r (Nairn and Guilkey 2015). That of v_r/r, with the same
weight, is the plain mean of v_r over the radius of the particle: no third function is needed. With
both a uniform state of stress is in balance at every node, wherever the particles are.

Values are the plain ones, not weighed as in that paper: v = a r then moves every particle with
exactly a r_p. Momentum and energy are kept with any values, for they serve both ways.
"""

from math import inf
from typing import Any, NamedTuple

from cramp_cli.numerics.kernel import inlined_kernel
from cramp_cli.shapes.shape import (
    along_axis,
    at_point,
    first_node,
    has_domain,
    hoop_pull,
    in_ring,
    is_ring,
    lay_out,
    node_steps,
    own_shape,
    place_of,
    reaches_beyond,
    ring_slopes,
    seen_from,
    store_hoop,
    support,
)


class Ring(NamedTuple):
    """A plane shape and where the axis is."""

    plain: Any  # record of the shape in the plane
    half: tuple  # of the plain shape
    axis: int  # grid line of r = 0, counted from the first; below 0 if left of the grid
    columns: int  # nodes along r
    radius: float = inf  # of a particle, in cells; inf: the slopes of the plane


@support.implement(Ring)
def _(shape):
    return support(shape.plain)


@reaches_beyond.implement(Ring)
def _(shape):
    return reaches_beyond(shape.plain)


@is_ring.implement(Ring)
def _(shape):
    return True


@has_domain.implement(Ring)
def _(shape):
    return has_domain(shape.plain)


@lay_out.implement(Ring)
def _(shape, stencil, F, p):
    return lay_out(shape.plain, stencil, F, p)


@own_shape.implement(Ring)
def _(shape, stencil, p):
    own = own_shape(shape.plain, stencil, p)
    return Ring(own, shape.half, shape.axis, shape.columns, shape.radius)


@inlined_kernel
def radius_of(shape, base, x):
    """Return the radius of a particle in cells; x: place along r from its first node `base`."""
    return x + (base % shape.columns - shape.axis)


@place_of.implement(Ring)
def _(shape, strides, stencil, p):
    radius = radius_of(shape, stencil.base[p], stencil.local[p, 0])
    return in_ring(place_of(shape.plain, strides, stencil, p), radius)


@first_node.implement(Ring)
def _(shape, axis, x):
    return first_node(shape.plain, axis, x)


@at_point.implement(Ring)
def _(shape, r):
    return at_point(shape.plain, r)


@node_steps.implement(Ring)
def _(shape, stride):
    return node_steps(shape.plain, stride)


@along_axis.implement(Ring)
def _(shape, axis, r):
    values, slopes = along_axis(shape.plain, axis, r)
    if axis == 0:
        return values, ring_slopes(shape.plain, slopes, shape.radius)
    return values, slopes


@seen_from.implement(Ring)
def _(shape, base, local):
    radius = radius_of(shape, base, local[0])
    return Ring(shape.plain, shape.half, shape.axis, shape.columns, radius)


@hoop_pull.implement(Ring)
def _(shape, like, hoop):
    return (hoop / shape.radius, 0.0)


@store_hoop.implement(Ring)
def _(shape, v, per_cell, L, p):
    L[p, 4] = per_cell * v[0] / shape.radius
