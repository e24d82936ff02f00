"""Sums over particles in grid rows: mass, momentum, forces.

A particle far from cracks has its nodes for rows (nodes.py); a particle near one has a list of
entries (state/stencil.py). So each sum is written twice: plain MPM for those far, and for those
near the same with rows instead of nodes. In the order of the particles they are done run by run.

parts: (k, 3) runs of particles, first and last + 1, and the band they belong to (state/bands.py)
"""

from numpy import uint64

from cramp_cli.numerics.kernel import kernel, particle_kernel
from cramp_cli.numerics.symmetric import apply, columns, symmetric
from cramp_cli.numerics.vector import (
    plus,
    scaled,
    times,
    vector,
)
from cramp_cli.shapes.nodes import give, give_gradient, take
from cramp_cli.shapes.shape import (
    factors,
    gradients,
    hoop_pull,
    is_ring,
    place_of,
    seen_from,
    weights,
)
from cramp_cli.transfer.rows import add, entry_gradient, first_line


@kernel
def clear(array, count):
    """Set the first `count` rows of a (rows,) or (rows, dim) array to zero."""
    array[:count] = 0.0


@kernel
def clear_sums(grid, count):
    """Set mass, momentum and force of the first `count` rows to zero."""
    grid.mass[:count] = 0.0
    grid.momentum[:count] = 0.0
    grid.force[:count] = 0.0


@particle_kernel
def sum_mass_and_momentum(grid, particles, stencil, shape, strides, parts):
    """Add m_i = sum S m_p and p_i = sum S m_p v_p."""
    for part in range(len(parts)):
        run = (parts[part, 0], parts[part, 1])
        _mass_and_momentum_far(grid, particles, stencil, shape, strides, run)
        _mass_and_momentum_near(grid, particles, stencil, shape, strides, run)


@particle_kernel
def _mass_and_momentum_far(grid, particles, stencil, shape, strides, run):
    mass, momentum = grid.mass, grid.momentum
    m, v = particles.mass, particles.velocity
    base, near = stencil.base, stencil.near
    for number in range(run[0], run[1]):
        p = uint64(number)
        if near[p] < 0:
            along = factors(place_of(shape, strides, stencil, p), shape)
            give(along, strides, base[p], mass, (m[p],))
            give(along, strides, base[p], momentum, times(vector(strides, v, p), m[p]))


@particle_kernel
def _mass_and_momentum_near(grid, particles, stencil, shape, strides, run):
    mass, momentum = grid.mass, grid.momentum
    m, v = particles.mass, particles.velocity
    which, table, share = stencil.which, stencil.table, stencil.share
    for line in range(first_line(stencil, run[0]), first_line(stencil, run[1])):
        p = stencil.listed[line]
        S = weights(place_of(shape, strides, stencil, p), shape)
        P = times(vector(strides, v, p), m[p])
        for e in range(stencil.entries[line]):
            w = share[line, e] * S[which[line, e]]
            mass[table[line, e]] += w * m[p]
            add(momentum, table[line, e], w, P)


@particle_kernel
def sum_internal_force(grid, particles, stencil, shape, strides, width, parts):
    """Add f_i = -sum V_p tau_p grad S, with Kirchhoff stress tau and initial volume V.

    Rings pull towards the axis as well: -sum V_p tau_hoop S/r.
    """
    for part in range(len(parts)):
        run = (parts[part, 0], parts[part, 1])
        _internal_force_far(grid, particles, stencil, shape, strides, width, run)
        _internal_force_near(grid, particles, stencil, shape, strides, width, run)


@particle_kernel
def _internal_force_far(grid, particles, stencil, shape, strides, width, run):
    force, per_cell = grid.force, -1.0 / width
    stress, volume = particles.stress, particles.volume
    base, near = stencil.base, stencil.near
    for number in range(run[0], run[1]):
        p = uint64(number)
        if near[p] < 0:
            T = columns(scaled(symmetric(strides, stress, p), volume[p] * per_cell))
            place = place_of(shape, strides, stencil, p)
            seen = seen_from(shape, base[p], place)
            pull = hoop_pull(seen, strides, stress[p, 2] * volume[p] * per_cell)
            give_gradient(factors(place, seen), strides, base[p], force, pull, T)


@particle_kernel
def _internal_force_near(grid, particles, stencil, shape, strides, width, run):
    force, per_cell = grid.force, -1.0 / width
    stress, volume, table = particles.stress, particles.volume, stencil.table
    for line in range(first_line(stencil, run[0]), first_line(stencil, run[1])):
        p = stencil.listed[line]
        T = scaled(symmetric(strides, stress, p), volume[p] * per_cell)
        place = place_of(shape, strides, stencil, p)
        seen = seen_from(shape, stencil.base[p], place)
        pull = hoop_pull(seen, strides, stress[p, 2] * volume[p] * per_cell)
        S, G = weights(place, seen), gradients(place, seen)
        for e in range(stencil.entries[line]):
            g = entry_gradient(stencil, strides, line, e, S, G)
            add(force, table[line, e], 1.0, apply(g, T))
            if is_ring(shape):
                w = stencil.share[line, e] * S[stencil.which[line, e]]
                add(force, table[line, e], w, pull)


@particle_kernel
def smooth(target, field, particles, stencil, shape, strides, parts):
    """Add sum m_p S_ip (sum_j S_jp v_j): the step of XPIC and FMPM from grid to particles and back.

    target, field: (rows, dim); divided by the row mass, target is S+ S v (Nairn and Hammerquist
    2021)
    """
    for part in range(len(parts)):
        run = (parts[part, 0], parts[part, 1])
        _smooth_far(target, field, particles.mass, stencil, shape, strides, run)
        _smooth_near(target, field, particles.mass, stencil, shape, strides, run)


@particle_kernel
def _smooth_far(target, field, m, stencil, shape, strides, run):
    base, near = stencil.base, stencil.near
    for number in range(run[0], run[1]):
        p = uint64(number)
        if near[p] < 0:
            along = factors(place_of(shape, strides, stencil, p), shape)
            v = take(along, strides, base[p], field)
            give(along, strides, base[p], target, times(v, m[p]))


@particle_kernel
def _smooth_near(target, field, m, stencil, shape, strides, run):
    which, table, share = stencil.which, stencil.table, stencil.share
    for line in range(first_line(stencil, run[0]), first_line(stencil, run[1])):
        p = stencil.listed[line]
        S = weights(place_of(shape, strides, stencil, p), shape)
        v = times(strides, 0.0)
        for e in range(stencil.entries[line]):
            w = share[line, e] * S[which[line, e]]
            v = plus(v, w, vector(strides, field, table[line, e]))
        for e in range(stencil.entries[line]):
            add(target, table[line, e], m[p] * share[line, e] * S[which[line, e]], v)
