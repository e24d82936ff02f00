"""A rigid body that touches between two nodes leans on both.

A roller on a face touches along less than a cell. The node nearest to it would bear all and move
the force by up to half a cell: 1.2 % of the moment of a beam whose rollers are 80 cells apart. So
where no other node along the surface touches, a pair acts at the place of the least gap, with the
normal there, and shares with the next node by the lever. Wider contacts are left to their nodes:
tied in between, neighbours would move in opposite ways.
"""

from math import sqrt

from cramp_cli.contact.separation import FLUSH
from cramp_cli.numerics.kernel import kernel

CLOSE = 1e-3  # cells; what touches so near to a node touches at it
ALONGSIDE = 0.5  # cells along the surface; nodes nearer to each other lie one behind the other


@kernel
def lean_on_neighbours(pairs, rigid, flat, width, strides):
    """Let pairs that touch alone lean on the next node; their gap and normal are those in between.

    rigid: (groups,) 1 for rigid bodies; flat: (nodes, dim) 1 along normals of symmetry planes
    """
    for i in range(pairs.used[0]):
        way = pairs.least[i, 0]
        me, sign = (1, -1.0) if rigid[pairs.group[i, 0]] else (0, 1.0)
        n = (sign * pairs.normal[i, 0], sign * pairs.normal[i, 1])
        if abs(way) > CLOSE and touches_alone(pairs, i, n, strides):
            find_next(pairs, i, me, n, way, flat, strides)
    for i in range(pairs.used[0]):
        if pairs.beside[i] >= 0:
            turn = pairs.least[i, 2]
            nx, ny, size = pairs.normal[i, 0], pairs.normal[i, 1], sqrt(1.0 + turn * turn)
            pairs.normal[i, 0] = (nx - turn * ny) / size
            pairs.normal[i, 1] = (ny + turn * nx) / size
            pairs.gap[i] = pairs.least[i, 1] - FLUSH * width


@kernel
def step_along(pairs, i, j, n, strides):
    """Return the way from the node of pair i to that of j along the surface, and in all (cells)."""
    step = pairs.node[j] - pairs.node[i]
    up = (step + strides[1] + 1) // strides[1] - 1
    right = step - up * strides[1]
    return up * n[0] - right * n[1], sqrt(float(right * right + up * up))


@kernel
def touches_alone(pairs, i, n, strides):
    """Tell whether no other node along the surface touches; n: unit normal."""
    for w in range(pairs.around[i]):
        j = pairs.window[i, w]
        along, _ = step_along(pairs, i, j, n, strides)
        if abs(along) > ALONGSIDE and pairs.gap[j] < 0.0:
            return False
    return True


@kernel
def find_next(pairs, i, me, n, way, flat, strides):
    """Find the row of the next node along the surface, and its share of what pair i gets.

    me: which of its rows is elastic; n: unit normal; way: along the surface to where it touches
    (cells). Nodes of symmetry planes are left out: what one gets its image would get as well
    """
    best = 0.5
    for w in range(pairs.around[i]):
        j = pairs.window[i, w]
        along, size = step_along(pairs, i, j, n, strides)
        along = along if way > 0.0 else -along
        if along > best * size and flat[pairs.node[j], 0] + flat[pairs.node[j], 1] == 0:
            best = along / size
            pairs.beside[i], pairs.lean[i] = pairs.row[j, me], abs(way) / along
