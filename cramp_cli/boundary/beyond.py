"""Nodes beyond a held plane, where shape functions reach there (B-splines).

The velocity on the plane is a mean over the nodes on it and those to either side. It is the
prescribed one, V, if the nodes beyond move as v_beyond = 2 V - v_within: the motion goes on through
the plane oddly. So a node beyond is no unknown of its own; its mass and what acts on it belong,
mirrored, to the node within:

    (m_w + m_b) dv_w/dt = f_w - f_b     for constant V

This holds from the first sums of a step on, as at a symmetry plane: were it brought about by the
forces, particles would take a part of every correction, and a plate drawn evenly would not stay so.
Left to themselves the nodes beyond would take the stress off the first particles; held at V they
would move the plane by an eighth (quadratic) or a sixth (cubic) of a cell.
"""

from typing import NamedTuple

import numpy as np

from cramp_cli.boundary.velocity import own_share
from cramp_cli.numerics.kernel import kernel


class Beyond(NamedTuple):
    """Nodes one line beyond a held plane, and their images within the body; the held component.

    Pairs with a node that has several rows are left alone: there the crack decides.
    """

    axis: int  # component of the velocity
    node: np.ndarray  # (n,) nodes beyond
    image: np.ndarray  # (n,) nodes within


@kernel
def is_pair(rows, mass, b, w):
    """Return whether node b has mass and it and its image w have a single row each."""
    return mass[b] > 0.0 and rows.first[b] < 0 and rows.first[w] < 0


@kernel
def follow_momentum(momentum, rows, mass, beyond, velocity):
    """Make the momenta of every pair odd about the prescribed velocity."""
    axis = beyond.axis
    for i in range(len(beyond.node)):
        b, w = beyond.node[i], beyond.image[i]
        if is_pair(rows, mass, b, w):
            relative = momentum[w, axis] - momentum[b, axis] + 2.0 * mass[b] * velocity
            v = relative / (mass[b] + mass[w])
            momentum[w, axis] = mass[w] * v
            momentum[b, axis] = mass[b] * (2.0 * velocity - v)


@kernel
def follow_force(grid, rows, share, beyond, velocity, dt):
    """Change forces so that the coming momentum update makes every pair odd.

    share: (nodes,) of a node's sums that are the body's (boundary/velocity.py)
    returns: sum of the changes, part of the reaction of the boundary (N)
    """
    mass, momentum, force, axis = grid.mass, grid.momentum, grid.force, beyond.axis
    reaction = 0.0
    for i in range(len(beyond.node)):
        b, w = beyond.node[i], beyond.image[i]
        if not is_pair(rows, mass, b, w):
            continue
        relative = momentum[w, axis] - momentum[b, axis] + 2.0 * mass[b] * velocity
        v = (relative + dt * (force[w, axis] - force[b, axis])) / (mass[b] + mass[w])
        new_w = (mass[w] * v - momentum[w, axis]) / dt
        new_b = (mass[b] * (2.0 * velocity - v) - momentum[b, axis]) / dt
        own = own_share(rows, share, w)
        reaction += own * (new_w - force[w, axis] + new_b - force[b, axis])
        force[w, axis], force[b, axis] = new_w, new_b
    return reaction


@kernel
def follow_increment(field, rows, mass, beyond):
    """Make a field of velocity increments odd about zero (higher orders of XPIC and FMPM)."""
    axis = beyond.axis
    for i in range(len(beyond.node)):
        b, w = beyond.node[i], beyond.image[i]
        if is_pair(rows, mass, b, w):
            v = mass[w] * field[w, axis] - mass[b] * field[b, axis]
            field[w, axis] = v / (mass[b] + mass[w])
            field[b, axis] = -field[w, axis]
