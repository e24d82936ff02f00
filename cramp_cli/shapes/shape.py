"""What a shape function answers.

A particle sees `support` nodes along each axis from `first_node` on. In most shapes S_ip is the
product of functions of one axis, its gradient has one of them replaced by the slope (algorithm:
Bardenhagen and Kober 2004): the place of a particle is a point, a tuple. Of a shape with domains
(cpdi.py) it is a record, for which `factors`, `weights`, `gradients` and others have bodies of
their own.
"""

from cramp_cli.numerics.dispatch import by_length, generic
from cramp_cli.numerics.vector import outer, outer_sum, plus, times, vector

# What `lay_out` did with the domain of a particle; NOWHERE: it is no number
AS_IT_IS, SHORTENED, NOWHERE = 0, 1, 2


@generic
def first_node(shape, axis, x):
    """Return the number of the first node along `axis` that a particle at `x` (in cells) sees."""


@generic
def along_axis(shape, axis, r):
    """Return the values and the slopes (per cell) at the nodes of an axis, two tuples.

    r: distance of the particle from its first node, in cells
    """


@generic
def node_steps(shape, stride):
    """Return the steps in node number from the first node to every node of an axis."""


@generic
def support(shape):
    """Return how many nodes a particle sees along an axis."""


@generic
def reaches_beyond(shape):
    """Return whether a particle whose box ends on a line of nodes sees nodes beyond that line.

    Where velocities are held on the line, those nodes have to follow (boundary/beyond.py).
    """


@generic
def is_ring(shape):
    """Return whether particles are rings about an axis (ring.py)."""


@generic
def has_domain(shape):
    """Return whether particles have domains that are strained with them (cpdi.py)."""


@generic
def lay_out(shape, stencil, F, p):
    """Note the domain of a particle as its F has strained it; return what was done with it."""


@generic
def own_shape(shape, stencil, p):
    """Return the shape of one particle, with its own size (sized.py)."""


@generic
def place_of(shape, strides, stencil, p):
    """Return where a particle is, in cells from its first node: a point, or its domain."""


@generic
def seen_from(shape, base, local):
    """Return the shape for the slopes of one particle: that of a ring knows its radius.

    base: lowest node of the particle's nodes; local: its place from there, in cells
    """


@generic
def ring_slopes(shape, slopes, radius):
    """Return slopes along the radius (cells), weighed by it: those of a point do not change."""


@generic
def hoop_pull(shape, like, hoop):
    """Return the force of a hoop stress towards the axis, to be weighed by S; none in the plane.

    like: a vector; hoop: stress times volume over the cell width, with the sign of the force
    """


@generic
def store_hoop(shape, v, per_cell, L, p):
    """Write the rate of hoop strain v_r/r of a ring behind its velocity gradient; v = sum S v_i."""


@generic
def at_point(shape, r):
    """Return the functions of a point at the nodes of an axis of the particle that holds it.

    r: place of the point from the first of these nodes, in cells
    """


@by_length
def first_nodes(x, shape, axis):
    """Return the number of the first node along every axis from `axis` on; x: place in cells."""
    return (first_node(shape, axis, x[0]),) + first_nodes(x[1:], shape, axis + 1)


@first_nodes.implement(1)
def _(x, shape, axis):
    return (first_node(shape, axis, x[0]),)


@by_length
def factors(local, shape):
    """Return values and slopes (per cell) at the nodes of every axis: a pair of tuples per axis."""


@factors.implement(2)
def _(local, shape):
    return along_axis(shape, 0, local[0]), along_axis(shape, 1, local[1])


@factors.implement(3)
def _(local, shape):
    x, y = along_axis(shape, 0, local[0]), along_axis(shape, 1, local[1])
    return x, y, along_axis(shape, 2, local[2])


@by_length
def weights(local, shape):
    """Return S_ip at all nodes of the particle, x running fastest."""


@weights.implement(2)
def _(local, shape):
    return outer(along_axis(shape, 1, local[1])[0], along_axis(shape, 0, local[0])[0])


@weights.implement(3)
def _(local, shape):
    x, y = along_axis(shape, 0, local[0])[0], along_axis(shape, 1, local[1])[0]
    return outer(along_axis(shape, 2, local[2])[0], outer(y, x))


@by_length
def gradients(local, shape):
    """Return the gradient of S_ip times the cell width: one flat tuple per axis."""


@gradients.implement(2)
def _(local, shape):
    x, dx = along_axis(shape, 0, local[0])
    y, dy = along_axis(shape, 1, local[1])
    return outer(y, dx), outer(dy, x)


@gradients.implement(3)
def _(local, shape):
    x, dx = along_axis(shape, 0, local[0])
    y, dy = along_axis(shape, 1, local[1])
    z, dz = along_axis(shape, 2, local[2])
    return outer(z, outer(y, dx)), outer(z, outer(dy, x)), outer(dz, outer(y, x))


@by_length
def hats(like, r):
    """Return the linear functions max(0, 1 - |r - k|) of nodes k = 0, 1, ... as long as `like`."""
    return (max(0.0, 1.0 - abs(r)),) + hats(like[1:], r - 1.0)


@hats.implement(1)
def _(like, r):
    return (max(0.0, 1.0 - abs(r)),)


@by_length
def point_weights(local, shape, away):
    """Return the functions of a point at the nodes of the particle that holds it.

    away: from the centre of the particle to the point at the start, in cells
    """


@point_weights.implement(2)
def _(local, shape, away):
    point = plus(local, 1.0, away)
    return outer(at_point(shape, point[1]), at_point(shape, point[0]))


@point_weights.implement(3)
def _(local, shape, away):
    point = plus(local, 1.0, away)
    x, y = at_point(shape, point[0]), at_point(shape, point[1])
    return outer(at_point(shape, point[2]), outer(y, x))


@by_length
def sees(local, shape, k):
    """Return whether node `k` of a particle may have a weight; a point sees all its nodes."""
    return True


@by_length
def in_ring(local, radius):
    """Return the place of a ring with what its radius (cells) does to gradients."""
    return local


@by_length
def offsets(strides, shape):
    """Return the steps in node number from the base node to all nodes of a particle."""


@offsets.implement(2)
def _(strides, shape):
    return outer_sum(node_steps(shape, strides[1]), node_steps(shape, strides[0]))


@offsets.implement(3)
def _(strides, shape):
    plane = outer_sum(node_steps(shape, strides[1]), node_steps(shape, strides[0]))
    return outer_sum(node_steps(shape, strides[2]), plane)


def _linear(shape, r):
    return hats(node_steps(shape, 1), r)


def _unchanged(shape, slopes, radius):
    return slopes


def plane(kind, slopes_in_a_ring=_unchanged, of_a_point=_linear) -> None:
    """Declare a shape of the plane: what it answers, alone and as part of a ring."""
    is_ring.implement(kind)(lambda shape: False)
    has_domain.implement(kind)(lambda shape: False)
    own_shape.implement(kind)(lambda shape, stencil, p: shape)
    lay_out.implement(kind)(lambda shape, stencil, F, p: AS_IT_IS)
    place_of.implement(kind)(lambda shape, strides, stencil, p: vector(strides, stencil.local, p))
    seen_from.implement(kind)(lambda shape, base, local: shape)
    ring_slopes.implement(kind)(slopes_in_a_ring)
    hoop_pull.implement(kind)(lambda shape, like, hoop: times(like, 0.0))
    store_hoop.implement(kind)(lambda shape, v, per_cell, L, p: None)
    at_point.implement(kind)(of_a_point)
