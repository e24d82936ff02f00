"""Forces on particles: their sum in the rows of the grid, and the work they do.

numbers: (n,) particles that are loaded; load: (n, dim) force on each under unit load (N)
index: where the particle of a number is, or DELETED
"""

from cramp_cli.numerics.kernel import kernel
from cramp_cli.numerics.vector import dot, scaled, vector
from cramp_cli.shapes.shape import offsets, place_of, weights
from cramp_cli.state.particles import DELETED
from cramp_cli.transfer.rows import add


@kernel
def sum_particle_force(grid, numbers, load, index, stencil, shape, strides, factor):
    """Add f_i = sum S P_p, the forces P factor times the load."""
    force = grid.force
    base, near = stencil.base, stencil.near
    entries, which, table, share = stencil.entries, stencil.which, stencil.table, stencil.share
    steps = offsets(strides, shape)
    for c in range(len(numbers)):
        p = index[numbers[c]]
        if p == DELETED:
            continue
        S = scaled(weights(place_of(shape, strides, stencil, p), shape), factor)
        P = vector(strides, load, c)
        first, line = base[p], near[p]
        if line < 0:
            for k in range(len(steps)):
                add(force, first + steps[k], S[k], P)
        else:
            for e in range(entries[line]):
                add(force, table[line, e], share[line, e] * S[which[line, e]], P)


@kernel
def load_times_place(position, numbers, load, index, strides):
    """Return the sum of load times place (J under unit load): its change is the work done."""
    total = 0.0
    for c in range(len(numbers)):
        p = index[numbers[c]]
        if p != DELETED:
            total += dot(vector(strides, load, c), vector(strides, position, p))
    return total
