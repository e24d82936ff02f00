"""Sums over particles in grid rows: mass, momentum, forces.

A particle far from cracks has its nodes for rows; a particle near one has a list of entries (see
state/stencil.py). That is the only difference between the two loops of a kernel.
"""

from cramp_cli.numerics.kernel import kernel
from cramp_cli.numerics.tensor import (
    apply,
    pick,
    plus,
    scaled,
    symmetric,
    times,
    vector,
    vector_of,
)
from cramp_cli.shapes.shape import gradients, offsets, weights


@kernel
def clear(array, count):
    """Set the first `count` rows of a (rows,) or (rows, dim) array to zero."""
    array[:count] = 0.0


@kernel
def add(field, row, s, v):
    """Add s v to a row of a (rows, dim) array."""
    for d in range(len(v)):
        field[row, d] += s * v[d]


@kernel
def sum_mass_and_momentum(grid, particles, stencil, shape, strides, lo, hi):
    """Add m_i = sum S m_p and p_i = sum S m_p v_p of particles lo..hi."""
    mass, momentum = grid.mass, grid.momentum
    m, v = particles.mass, particles.velocity
    base, local, near = stencil.base, stencil.local, stencil.near
    entries, which, table, share = stencil.entries, stencil.which, stencil.table, stencil.share
    steps = offsets(strides, shape)
    for p in range(lo, hi):
        S = scaled(weights(vector(strides, local, p), shape), m[p])
        V = vector(strides, v, p)
        first, line = base[p], near[p]
        if line < 0:
            for k in range(len(steps)):
                mass[first + steps[k]] += S[k]
                add(momentum, first + steps[k], S[k], V)
        else:
            for e in range(entries[line]):
                w = share[line, e] * S[which[line, e]]
                mass[table[line, e]] += w
                add(momentum, table[line, e], w, V)


@kernel
def sum_momentum(grid, particles, stencil, shape, strides, lo, hi):
    """Add p_i = sum S m_p v_p of the moved particles lo..hi, with the first weights of the step."""
    m, v = particles.mass, particles.velocity
    sum_vectors(grid.momentum, m, v, stencil, shape, strides, lo, hi)


@kernel
def sum_vectors(field, m, v, stencil, shape, strides, lo, hi):
    """Add sum S m_p v_p of particles lo..hi to a (rows, dim) array."""
    base, local, near = stencil.base, stencil.local, stencil.near
    entries, which, table, share = stencil.entries, stencil.which, stencil.table, stencil.share
    steps = offsets(strides, shape)
    for p in range(lo, hi):
        S = scaled(weights(vector(strides, local, p), shape), m[p])
        V = vector(strides, v, p)
        first, line = base[p], near[p]
        if line < 0:
            for k in range(len(steps)):
                add(field, first + steps[k], S[k], V)
        else:
            for e in range(entries[line]):
                add(field, table[line, e], share[line, e] * S[which[line, e]], V)


@kernel
def sum_internal_force(grid, particles, stencil, shape, strides, width, lo, hi):
    """Add f_i = -sum V_p tau_p grad S, with Kirchhoff stress tau and initial volume V."""
    force = grid.force
    stress, volume = particles.stress, particles.volume
    base, local, near = stencil.base, stencil.local, stencil.near
    entries, which, table, share = stencil.entries, stencil.which, stencil.table, stencil.share
    bend = stencil.bend
    steps = offsets(strides, shape)
    for p in range(lo, hi):
        G = gradients(vector(strides, local, p), shape)
        tau = scaled(symmetric(strides, stress, p), -volume[p] / width)
        first, line = base[p], near[p]
        if line < 0:
            for k in range(len(steps)):
                add(force, first + steps[k], 1.0, apply(pick(G, k), tau))
        else:
            S = weights(vector(strides, local, p), shape)
            for e in range(entries[line]):
                k = which[line, e]
                g = plus(times(pick(G, k), share[line, e]), S[k], vector_of(strides, bend, line, e))
                add(force, table[line, e], 1.0, apply(g, tau))


@kernel
def sum_particle_force(grid, chosen, load, stencil, shape, strides, factor):
    """Add f_i = sum S P_p for the particles `chosen` with forces factor * load (N)."""
    force = grid.force
    base, local, near = stencil.base, stencil.local, stencil.near
    entries, which, table, share = stencil.entries, stencil.which, stencil.table, stencil.share
    steps = offsets(strides, shape)
    for c in range(len(chosen)):
        p = chosen[c]
        S = scaled(weights(vector(strides, local, p), shape), factor)
        P = vector(strides, load, c)
        first, line = base[p], near[p]
        if line < 0:
            for k in range(len(steps)):
                add(force, first + steps[k], S[k], P)
        else:
            for e in range(entries[line]):
                add(force, table[line, e], share[line, e] * S[which[line, e]], P)


@kernel
def smooth(target, field, particles, stencil, shape, strides, lo, hi):
    """Add sum m_p S_ip (sum_j S_jp v_j): the step of XPIC and FMPM from grid to particles and back.

    target, field: (rows, dim); divided by the row mass, target is S+ S v (Nairn and Hammerquist
    2021)
    """
    m = particles.mass
    base, local, near = stencil.base, stencil.local, stencil.near
    entries, which, table, share = stencil.entries, stencil.which, stencil.table, stencil.share
    steps = offsets(strides, shape)
    for p in range(lo, hi):
        S = weights(vector(strides, local, p), shape)
        first, line = base[p], near[p]
        v = times(vector(strides, field, 0), 0.0)
        if line < 0:
            for k in range(len(steps)):
                v = plus(v, S[k], vector(strides, field, first + steps[k]))
            for k in range(len(steps)):
                add(target, first + steps[k], m[p] * S[k], v)
        else:
            for e in range(entries[line]):
                w = share[line, e] * S[which[line, e]]
                v = plus(v, w, vector(strides, field, table[line, e]))
            for e in range(entries[line]):
                add(target, table[line, e], m[p] * share[line, e] * S[which[line, e]], v)
