"""Prescribed velocities.

A prescribed velocity belongs to a part of a body's surface, so where a crack meets that part only
the rows whose particles lie in it are held: the far side of a notch beside a struck edge stays
free.
"""

from typing import NamedTuple

import numpy as np

from cramp_cli.numerics.kernel import kernel


class Held(NamedTuple):
    """Candidates for a prescribed velocity component: nodes on a plane, in or near the region."""

    node: np.ndarray  # (n,) nodes
    inside: np.ndarray  # (n,) 1 where the node itself lies in the region
    axis: int  # component of the velocity
    lower: np.ndarray  # (dim,) region for the mean position of a row's particles (m)
    upper: np.ndarray  # (dim,)


@kernel
def find_held_rows(held_rows, rows, mass, node, inside, lower, upper):
    """Write the rows that are held and return their number.

    The row of a node without cracks is held if the node lies in the region; at a node with several
    rows, each is held if the mean position of its particles lies in the region.
    """
    nodes = len(rows.first)
    place = rows.place
    n = 0
    for i in range(len(node)):
        row = node[i]
        if rows.first[row] < 0:
            if inside[i]:
                held_rows[n] = row
                n += 1
            continue
        while row >= 0:
            within = mass[row] > 0.0
            for d in range(len(lower)):
                mean = place[row, d] / mass[row] if mass[row] > 0.0 else 0.0
                within = within and lower[d] <= mean <= upper[d]
            if within and n < len(held_rows):
                held_rows[n] = row
                n += 1
            row = rows.first[row] if row < nodes else rows.next[row - nodes]
    return n


@kernel
def hold_momentum(momentum, mass, held_rows, count, axis, velocity):
    """Set p = m v in the held rows."""
    for i in range(count):
        momentum[held_rows[i], axis] = mass[held_rows[i]] * velocity


@kernel
def own_share(rows, share, row):
    """Return how much of what acts on a row acts on the body, not on its image."""
    nodes = len(rows.first)
    return share[row] if row < nodes else share[rows.node[row - nodes]]


@kernel
def hold_force(grid, rows, share, held_rows, count, axis, velocity, dt):
    """Change forces so that the coming momentum update gives the prescribed velocity.

    share: (nodes,) of a node's sums that are the body's: 1/2 on a symmetry plane, 0 beyond it

    The strain updates of the step already move these rows with the prescribed velocity: what the
    other forces of a row do over the difference is work of the boundary as well.

    returns: sum of the changes, the reaction of the boundary (N), and its work on the rows (J)
    """
    mass, momentum, force = grid.mass, grid.momentum, grid.force
    reaction, work = 0.0, 0.0
    for i in range(count):
        row = held_rows[i]
        if mass[row] > 0.0:
            wanted = (mass[row] * velocity - momentum[row, axis]) / dt
            change, before = wanted - force[row, axis], momentum[row, axis] / mass[row]
            twice = change * (velocity + before) - force[row, axis] * (velocity - before)
            own = own_share(rows, share, row)
            reaction += own * change
            work += own * 0.5 * dt * twice
            force[row, axis] = wanted
    return reaction, work


@kernel
def hold_again(grid, rows, share, held_rows, count, axis, velocity, dt):
    """Set p = m v in the held rows and the forces to match; return the sum of changes (N)."""
    mass, momentum, force = grid.mass, grid.momentum, grid.force
    reaction = 0.0
    for i in range(count):
        row = held_rows[i]
        change = mass[row] * velocity - momentum[row, axis]
        momentum[row, axis] += change
        force[row, axis] += change / dt
        reaction += own_share(rows, share, row) * change / dt
    return reaction


@kernel
def hold_zero(field, held_rows, count, axis):
    """Set a component to zero in the held rows (higher orders of XPIC and FMPM)."""
    for i in range(count):
        field[held_rows[i], axis] = 0.0
