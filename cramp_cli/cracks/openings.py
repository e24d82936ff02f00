"""How far the two sides of a node are apart, told so that a turn of the body opens nothing.

The particles of two sides lie up to a cell apart. In a body that turns they move differently though
no face parts: the difference of their displacements alone (Bardenhagen et al. 2001; Nairn 2003)
would be as large as a cell after a quarter of a turn. So what rotation alone does to their distance
is taken off (docs/theory/cracks.md).
"""

from math import sqrt

from cramp_cli.numerics.kernel import inlined_kernel, kernel
from cramp_cli.numerics.vector import plus, times, vector
from cramp_cli.shapes.shape import offsets, place_of, weights
from cramp_cli.transfer.rows import add

FLUSH = 1e-9  # of the distance of the particles of two sides; faces as near to each other touch


@kernel
def clear_openings(rows):
    """Set the sums below to zero in all rows of nodes with several rows."""
    nodes = len(rows.first)
    for i in range(rows.count[1]):
        row = rows.shared[i]
        while row >= 0:
            rows.weight[row] = 0.0
            for d in range(rows.place.shape[1]):
                rows.displacement[row, d] = rows.place[row, d] = 0.0
            rows.turn[row, 0] = rows.turn[row, 1] = 0.0
            row = rows.first[row] if row < nodes else rows.next[row - nodes]


@kernel
def sum_openings(rows, particles, stencil, shape, strides, lo, hi):
    """Add weight, displacement, place and turn of particles lo..hi to rows of shared nodes."""
    first, base, near, which = rows.first, stencil.base, stencil.near, stencil.which
    table, share = stencil.table, stencil.share
    steps = offsets(strides, shape)
    for i in range(stencil.count[1]):
        p = stencil.around[i]
        if p < lo or p >= hi or not is_any_shared(first, base[p], steps):
            continue
        S = weights(place_of(shape, strides, stencil, p), shape)
        m, line = particles.mass[p], near[p]
        if line < 0:
            for k in range(len(steps)):
                if first[base[p] + steps[k]] >= 0:
                    _add_one(rows, base[p] + steps[k], m * S[k], particles, p, strides)
            continue
        for e in range(stencil.entries[line]):
            k = which[line, e]
            if first[base[p] + steps[k]] >= 0:
                w = m * share[line, e] * S[k]
                _add_one(rows, table[line, e], w, particles, p, strides)


@inlined_kernel
def _add_one(rows, row, w, particles, p, strides):
    """Add particle p with the weight w (kg) to a row."""
    F = particles.F
    x, X = vector(strides, particles.position, p), vector(strides, particles.origin, p)
    rows.weight[row] += w
    add(rows.displacement, row, w, plus(x, -1.0, X))
    add(rows.place, row, w, x)
    rows.turn[row, 0] += w * (F[p, 0] + F[p, 3])
    rows.turn[row, 1] += w * (F[p, 2] - F[p, 1])


@inlined_kernel
def is_any_shared(first, lowest, steps):
    """Return whether one of the nodes of a particle has several rows; lowest: the first of them."""
    shared = False
    for k in range(len(steps)):
        shared = shared or first[lowest + steps[k]] >= 0
    return shared


@kernel
def rotation_of_row(rows, row):
    """Return cosine and sine of the angle by which the particles of a row have turned."""
    c, s = rows.turn[row, 0], rows.turn[row, 1]
    size = sqrt(c * c + s * s)
    return (c / size, s / size) if size > 0.0 else (1.0, 0.0)


@kernel
def apart(rows, a, b, strides):
    """Return how far row b is apart from row a, a vector (m), and what is too little to tell (m).

    Each side is carried on to the place midway between both as a rigid body turned by the mean
    rotation of its own particles: u_b - u_a - (R - 1)(X_b - X_a) with the mean R of both.
    """
    wa, wb = rows.weight[a], rows.weight[b]
    if wa <= 0.0 or wb <= 0.0:
        return times(vector(strides, rows.displacement, a), 0.0), 0.0
    moved = plus(
        times(vector(strides, rows.displacement, b), 1.0 / wb),
        -1.0 / wa,
        vector(strides, rows.displacement, a),
    )
    between = plus(
        times(vector(strides, rows.place, b), 1.0 / wb),
        -1.0 / wa,
        vector(strides, rows.place, a),
    )
    X, Y = plus(between, -1.0, moved)
    (ca, sa), (cb, sb) = rotation_of_row(rows, a), rotation_of_row(rows, b)
    c, s = 0.5 * (ca + cb) - 1.0, 0.5 * (sa + sb)
    return plus(moved, -1.0, (c * X - s * Y, s * X + c * Y)), FLUSH * sqrt(X * X + Y * Y)
