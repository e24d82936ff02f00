"""Normal and separation of every pair of rows.

One node sees too few particles of an inclined or curved surface: its normal was off by 8 to 18
degrees where these were steps of half a cell (root mean square along planes at 5 to 77 degrees),
whatever the method. So a normal is found from what the node and those around it see.
"""

from math import inf, sqrt

from cramp_cli.contact.gradient import average_gradient, larger_gradient
from cramp_cli.contact.laws import AVERAGE, LARGER
from cramp_cli.contact.lean import lean_on_neighbours
from cramp_cli.contact.logistic import logistic_normal
from cramp_cli.contact.outline import piece_beside
from cramp_cli.contact.separation import FLUSH, separation
from cramp_cli.contact.surface import outline_gap
from cramp_cli.cracks.contact import FRICTIONAL, GLUED, STICK
from cramp_cli.numerics.kernel import kernel


@kernel
def list_windows(pairs, strides):
    """List for every pair those of the same two groups at its node and at the nodes around it."""
    used, node, of_node = pairs.used[0], pairs.node, pairs.of_node
    for i in range(used - 1, -1, -1):
        of_node[node[i]] = i  # the first: those of a node follow each other
    for i in range(used):
        pairs.around[i] = 0
        for up in range(-1, 2):
            for right in range(-1, 2):
                _add_to_window(pairs, i, node[i] + up * strides[1] + right * strides[0])
    for i in range(used):
        of_node[node[i]] = -1


@kernel
def _add_to_window(pairs, i, node):
    j = pairs.of_node[node] if 0 <= node < len(pairs.of_node) else -1
    while 0 <= j < pairs.used[0] and pairs.node[j] == node:
        same = pairs.group[j, 0] == pairs.group[i, 0] and pairs.group[j, 1] == pairs.group[i, 1]
        if same and pairs.around[i] < pairs.window.shape[1]:
            pairs.window[i, pairs.around[i]] = j
            pairs.around[i] += 1
        j += 1


@kernel
def find_normals(
    pairs, clouds, stencil, particles, sizes, laws, kind, rigid, flat, lattice, strides
):
    """Find normal and separation of all pairs; a pair without a normal is left apart.

    sizes: half axes of the particle of each number (n, 2), m, and the surface of elastic bodies;
    kind: of fitted normals; rigid: (groups,) 1 for rigid bodies, their outlines, and which way they
    have gone (groups, dim), m; flat: (nodes, dim) 1 along the normals of symmetry planes through a
    node, along which no normal points; lattice: lower corner (m) and width (m)
    """
    (lower, width), (half, surface) = lattice, sizes
    for i in range(pairs.used[0]):
        node, a, b = pairs.node[i], pairs.row[i, 0], pairs.row[i, 1]
        pairs.normal[i, :], pairs.gap[i], pairs.least[i, :] = 0.0, width, 0.0
        if laws.kind[pairs.group[i, 0], pairs.group[i, 1]] == GLUED:
            continue
        place = (lower[0] + width * (node % strides[1]), lower[1] + width * (node // strides[1]))
        x = particles.position
        s, nx, ny = piece_beside(clouds, stencil, x, pairs, i, place, width, *rigid)
        if s < 0:
            nx, ny = fitted_normal(clouds, stencil, x, pairs, i, place, width, kind, strides)
        nx, ny = nx * (1 - flat[node, 0]), ny * (1 - flat[node, 1])
        size = sqrt(nx * nx + ny * ny)
        if size > 0.0:
            pairs.normal[i, 0], pairs.normal[i, 1] = nx / size, ny / size
            apart = inf
            if s >= 0:
                around = (clouds, stencil, particles, surface, pairs)
                apart = gap_beside(*around, i, (*place, width), flat, s, laws, rigid, strides)
            if apart == inf:
                n = (nx / size, ny / size)
                apart = separation(clouds, stencil, particles, half, a, b, *n)
            pairs.gap[i] = apart - FLUSH * width
    lean_on_neighbours(pairs, rigid[0], flat, width, strides)


@kernel
def gap_beside(clouds, stencil, particles, surface, pairs, i, place, flat, s, laws, rigid, strides):
    """Return how far the elastic body of pair i is from piece s of the rigid one's outline (m).

    The pair keeps where along the surface that is least.
    """
    (flags, outlines, ways), node = rigid, pairs.node[i]
    me, sign = (1, -1.0) if flags[pairs.group[i, 0]] else (0, 1.0)
    n = (sign * pairs.normal[i, 0], sign * pairs.normal[i, 1])
    group, row = pairs.group[i, 1 - me], pairs.row[i, me]
    on, way = flat[node, 0] + flat[node, 1] > 0, (ways[group, 0], ways[group, 1])
    gap, least, narrow, turn = outline_gap(
        clouds, stencil, particles, surface, row, place, on, n, s, outlines, way
    )
    if laws.kind[pairs.group[i, 0], pairs.group[i, 1]] in (FRICTIONAL, STICK):
        pairs.least[i, 0], pairs.least[i, 1], pairs.least[i, 2] = least / place[2], narrow, turn
    return gap


@kernel
def fitted_normal(clouds, stencil, position, pairs, i, place, width, kind, strides):
    """Return a vector from body a to body b of pair i, told by the particles of both."""
    if kind == AVERAGE:
        return average_gradient(clouds, pairs, i, strides)
    if kind == LARGER:
        return larger_gradient(clouds, pairs, i, strides)
    return logistic_normal(clouds, stencil, position, pairs, i, place, width)
