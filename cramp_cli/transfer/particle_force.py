"""Forces on particles: their sum in the rows of the grid, and the work they do.

numbers: (n,) particles that are loaded; load: (n, dim) force on each under unit load (N)
index: where the particle of a number is, or DELETED
"""

from cramp_cli.numerics.kernel import kernel
from cramp_cli.numerics.vector import dot, times, vector
from cramp_cli.shapes.shape import offsets, place_of, weights
from cramp_cli.state.particles import DELETED
from cramp_cli.transfer.rows import add, row_and_weight, rows_seen


@kernel
def sum_particle_force(grid, numbers, load, index, stencil, shape, strides, factor):
    """Add f_i = sum S P_p, the forces P factor times the load."""
    steps = offsets(strides, shape)
    for c in range(len(numbers)):
        p = index[numbers[c]]
        if p == DELETED:
            continue
        S = weights(place_of(shape, strides, stencil, p), shape)
        P = times(vector(strides, load, c), factor)
        for e in range(rows_seen(stencil, p, steps)):
            row, w = row_and_weight(stencil, p, e, steps, S)
            add(grid.force, row, w, P)


@kernel
def load_times_place(position, numbers, load, index, strides):
    """Return the sum of load times place (J under unit load): its change is the work done."""
    total = 0.0
    for c in range(len(numbers)):
        p = index[numbers[c]]
        if p != DELETED:
            total += dot(vector(strides, load, c), vector(strides, position, p))
    return total
