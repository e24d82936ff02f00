"""Sums over particles in grid rows: mass, momentum, forces."""

from cramp_cli.numerics.kernel import kernel
from cramp_cli.numerics.tensor import apply, pick, plus, scaled, symmetric, times, vector
from cramp_cli.shapes.shape import gradients, offsets, weights


@kernel
def clear(array, count):
    """Set the first `count` rows of a (rows,) or (rows, dim) array to zero."""
    array[:count] = 0.0


@kernel
def sum_mass_and_momentum(grid, particles, stencil, shape, strides, lo, hi):
    """Add m_i = sum S m_p and p_i = sum S m_p v_p of particles lo..hi."""
    mass, momentum = grid.mass, grid.momentum
    m, v = particles.mass, particles.velocity
    base, local, near, table = stencil.base, stencil.local, stencil.near, stencil.table
    steps = offsets(strides, shape)
    for p in range(lo, hi):
        S = weights(vector(strides, local, p), shape)
        mv = times(vector(strides, v, p), m[p])
        first, line = base[p], near[p]
        for k in range(len(steps)):
            row = first + steps[k] if line < 0 else table[line, k]
            mass[row] += S[k] * m[p]
            for d in range(len(strides)):
                momentum[row, d] += S[k] * mv[d]


@kernel
def sum_momentum(grid, particles, stencil, shape, strides, lo, hi):
    """Add p_i = sum S m_p v_p of the moved particles lo..hi, with the weights of the step's start."""
    momentum = grid.momentum
    m, v = particles.mass, particles.velocity
    base, local, near, table = stencil.base, stencil.local, stencil.near, stencil.table
    steps = offsets(strides, shape)
    for p in range(lo, hi):
        S = weights(vector(strides, local, p), shape)
        mv = times(vector(strides, v, p), m[p])
        first, line = base[p], near[p]
        for k in range(len(steps)):
            row = first + steps[k] if line < 0 else table[line, k]
            for d in range(len(strides)):
                momentum[row, d] += S[k] * mv[d]


@kernel
def sum_internal_force(grid, particles, stencil, shape, strides, width, lo, hi):
    """Add f_i = -sum V_p tau_p grad S, with Kirchhoff stress tau and initial volume V."""
    force = grid.force
    stress, volume = particles.stress, particles.volume
    base, local, near, table = stencil.base, stencil.local, stencil.near, stencil.table
    steps = offsets(strides, shape)
    for p in range(lo, hi):
        G = gradients(vector(strides, local, p), shape)
        tau = scaled(symmetric(strides, stress, p), -volume[p] / width)
        first, line = base[p], near[p]
        for k in range(len(steps)):
            row = first + steps[k] if line < 0 else table[line, k]
            t = apply(pick(G, k), tau)
            for d in range(len(strides)):
                force[row, d] += t[d]


@kernel
def sum_particle_force(grid, chosen, load, stencil, shape, strides, factor):
    """Add f_i = sum S P_p for the particles `chosen` with forces factor * load (N)."""
    force = grid.force
    base, local, near, table = stencil.base, stencil.local, stencil.near, stencil.table
    steps = offsets(strides, shape)
    for c in range(len(chosen)):
        p = chosen[c]
        S = scaled(weights(vector(strides, local, p), shape), factor)
        first, line = base[p], near[p]
        for k in range(len(steps)):
            row = first + steps[k] if line < 0 else table[line, k]
            for d in range(len(strides)):
                force[row, d] += S[k] * load[c, d]


@kernel
def smooth(target, field, particles, stencil, shape, strides, lo, hi):
    """Add sum m_p S_ip (sum_j S_jp v_j): the step of XPIC and FMPM from grid to particles and back.

    target, field: (rows, dim); divided by the row mass, target is S+ S v (Nairn and Hammerquist 2021)
    """
    m = particles.mass
    base, local, near, table = stencil.base, stencil.local, stencil.near, stencil.table
    steps = offsets(strides, shape)
    for p in range(lo, hi):
        S = weights(vector(strides, local, p), shape)
        first, line = base[p], near[p]
        v = times(vector(strides, field, 0), 0.0)
        for k in range(len(steps)):
            row = first + steps[k] if line < 0 else table[line, k]
            v = plus(v, S[k], vector(strides, field, row))
        for k in range(len(steps)):
            row = first + steps[k] if line < 0 else table[line, k]
            for d in range(len(strides)):
                target[row, d] += m[p] * S[k] * v[d]
