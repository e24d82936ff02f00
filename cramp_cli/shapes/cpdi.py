"""CPDI: particles are parallelograms that are stretched, sheared and turned with the solid.

Sadeghirad, Brannon and Burghardt (2011), A convected particle domain interpolation technique to
extend applicability of the material point method for problems involving massive deformations. In a
domain a grid function is taken to be bilinear between its values N_i at the four corners, so the
means over the domain of it and of its gradient are

    S_i = sum_k N_i(x_k) / 4,    G_i = sum_k N_i(x_k) g_k,
    g_k = (xi_k (b_y, -b_x) + eta_k (-a_y, a_x)) / A,    A = 4 (a_x b_y - a_y b_x),

with half sides a = F (l_x, 0) and b = F (0, l_y), corners x_k = x + xi_k a + eta_k b, and xi, eta =
-1 or 1. Neighbours have their corners in common as long as they are strained alike, so a solid may
be stretched many times before gaps open in it.

A ring weighs the slope along the radius r by it, as the other shapes do (ring.py): the mean of that
of a bilinear function has xi_k (1 + eta_k b_x / 3r) and eta_k (1 + xi_k a_x / 3r) for xi_k, eta_k.
"""

from math import floor, inf, sqrt
from typing import NamedTuple

from cramp_cli.numerics.kernel import inlined_kernel
from cramp_cli.numerics.vector import added, dot, outer, plus, scaled, store, times, vector, whole
from cramp_cli.shapes.corners import SHARE, Corner, Corners
from cramp_cli.shapes.shape import (
    AS_IT_IS,
    NOWHERE,
    SHORTENED,
    factors,
    first_node,
    gradients,
    has_domain,
    hats,
    in_ring,
    lay_out,
    node_steps,
    place_of,
    plane,
    point_weights,
    reaches_beyond,
    sees,
    support,
    weights,
)

# A domain reaches at most this far from its centre (cells): longer diagonals are cut (Homel,
# Brannon and Guilkey 2016). A little less than a cell, so that no round-off carries a corner out of
# the 3 x 3 cells around the particle, whose nodes are those it can see.
LONGEST = 0.999
ALONG_AXIS = (0, 1, 2, 3)  # nodes


class ConvectedDomain(NamedTuple):
    """A particle is a box at the start and goes with the deformation gradient."""

    half: tuple  # half size of the box along each axis, in cells


class Domain(NamedTuple):
    """Where a particle is and how it lies, in cells from its first node."""

    x: float
    y: float
    a: tuple  # half side that lay along x at the start
    b: tuple  # half side that lay along y
    lean_a: float  # a_x / 3r of a ring at radius r, otherwise 0
    lean_b: float  # b_x / 3r


@support.implement(ConvectedDomain)
def _(shape):
    return 4


@reaches_beyond.implement(ConvectedDomain)
def _(shape):
    return False


@first_node.implement(ConvectedDomain)
def _(shape, axis, x):
    return int(floor(x)) - 1


@node_steps.implement(ConvectedDomain)
def _(shape, stride):
    return (0, stride, 2 * stride, 3 * stride)


@inlined_kernel
def kept_share(diagonal):
    """Return the share of half a diagonal that is kept; 0 if its length is no number."""
    size = sqrt(dot(diagonal, diagonal))
    if size <= LONGEST:
        return 1.0
    return LONGEST / size if size < inf else 0.0


def _lay_out(shape, stencil, F, p):
    hx, hy = shape.half[0], shape.half[1]
    a, b = (F[p, 0] * hx, F[p, 2] * hx), (F[p, 1] * hy, F[p, 3] * hy)
    up, down = plus(a, 1.0, b), plus(a, -1.0, b)
    keep_up, keep_down = kept_share(up), kept_share(down)
    how = AS_IT_IS
    if not keep_up == keep_down == 1.0:
        up, down = times(up, 0.5 * keep_up), times(down, 0.5 * keep_down)
        a, b = plus(up, 1.0, down), plus(up, -1.0, down)
        how = SHORTENED if min(keep_up, keep_down) > 0.0 else NOWHERE
    store(a, stencil.sides, p, 0)
    store(b, stencil.sides, p, 2)
    return how


def _place(shape, strides, stencil, p):
    x, sides = vector(strides, stencil.local, p), stencil.sides
    return Domain(x[0], x[1], (sides[p, 0], sides[p, 1]), (sides[p, 2], sides[p, 3]), 0.0, 0.0)


plane(ConvectedDomain)
has_domain.implement(ConvectedDomain)(lambda shape: True)
lay_out.implement(ConvectedDomain)(_lay_out)
place_of.implement(ConvectedDomain)(_place)


@in_ring.implement(Domain)
def _(place, radius):
    third = 1.0 / (3.0 * radius)
    return Domain(place[0], place[1], place.a, place.b, place.a[0] * third, place.b[0] * third)


@inlined_kernel
def inside(domain, xi, eta):
    """Return the place of a point of a domain; its corners have xi, eta = -1 or 1."""
    return plus(plus((domain.x, domain.y), xi, domain.a), eta, domain.b)


@inlined_kernel
def slope_of(domain, xi, eta):
    """Return g_k of a corner (per cell)."""
    (ax, ay), (bx, by) = domain.a, domain.b
    per_area = SHARE / (ax * by - ay * bx)
    along_r = xi * (1.0 + eta * domain.lean_b) * by - eta * (1.0 + xi * domain.lean_a) * ay
    return along_r * per_area, (eta * ax - xi * bx) * per_area


@inlined_kernel
def corner_of(domain, xi, eta):
    """Return a corner with its linear functions and its slope."""
    place = inside(domain, xi, eta)
    cell = whole(place)
    x, y = place[0] - cell[0], place[1] - cell[1]
    linear = ((1.0 - x, x), (-1.0, 1.0)), ((1.0 - y, y), (-1.0, 1.0))
    return Corner(cell, linear, slope_of(domain, xi, eta))


@factors.implement(Domain)
def _(place, shape):
    one, two = corner_of(place, -1.0, -1.0), corner_of(place, 1.0, -1.0)
    return Corners(one, two, corner_of(place, 1.0, 1.0), corner_of(place, -1.0, 1.0))


@inlined_kernel
def linear_weights(place):
    """Return the linear functions at a place of all nodes that a particle can see."""
    return outer(hats(ALONG_AXIS, place[1]), hats(ALONG_AXIS, place[0]))


@inlined_kernel
def mixed(domain, one, two, three, four):
    """Return the linear functions at the corners, each times its number, summed."""
    low = scaled(linear_weights(inside(domain, -1.0, -1.0)), one)
    low = added(low, two, linear_weights(inside(domain, 1.0, -1.0)))
    high = scaled(linear_weights(inside(domain, 1.0, 1.0)), three)
    return added(low, 1.0, added(high, four, linear_weights(inside(domain, -1.0, 1.0))))


@weights.implement(Domain)
def _(place, shape):
    return mixed(place, SHARE, SHARE, SHARE, SHARE)


@gradients.implement(Domain)
def _(place, shape):
    g, h = slope_of(place, -1.0, -1.0), slope_of(place, 1.0, -1.0)
    i, j = slope_of(place, 1.0, 1.0), slope_of(place, -1.0, 1.0)
    return mixed(place, g[0], h[0], i[0], j[0]), mixed(place, g[1], h[1], i[1], j[1])


@point_weights.implement(Domain)
def _(place, shape, away):
    return linear_weights(inside(place, away[0] / shape.half[0], away[1] / shape.half[1]))


@sees.implement(Domain)
def _(place, shape, k):
    reach_x = abs(place.a[0]) + abs(place.b[0])
    reach_y = abs(place.a[1]) + abs(place.b[1])
    along_x = floor(place.x - reach_x) <= k % 4 <= floor(place.x + reach_x) + 1
    return along_x and floor(place.y - reach_y) <= k // 4 <= floor(place.y + reach_y) + 1
