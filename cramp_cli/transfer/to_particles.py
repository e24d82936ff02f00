"""From the grid to the particles: motion, strain and stress."""

from cramp_cli.materials.geometry import strained
from cramp_cli.numerics.kernel import kernel
from cramp_cli.numerics.tensor import (
    add_outer,
    dot,
    increment,
    matrix,
    pick,
    plus,
    product,
    scaled,
    times,
    turn,
    vector,
    vector_of,
    work_of,
    zero_matrix,
)
from cramp_cli.shapes.shape import gradients, offsets, weights
from cramp_cli.transfer.update import moved


@kernel
def move_particles(particles, grid, stencil, update, shape, strides, damping, dt, lo, hi):
    """Move particles lo..hi and change their velocity.

    damping: (grid, particle), 1/s
    returns: energy taken by damping, and by the filter of updates other than FLIP (J)
    """
    x, v, a = particles.position, particles.velocity, particles.acceleration
    m = particles.mass
    velocity, acceleration = grid.velocity, grid.acceleration
    base, local, near = stencil.base, stencil.local, stencil.near
    entries, which, table, share = stencil.entries, stencil.which, stencil.table, stencil.share
    steps = offsets(strides, shape)
    damped = 0.0
    for p in range(lo, hi):
        S = weights(vector(strides, local, p), shape)
        first, line = base[p], near[p]
        u = times(vector(strides, v, p), 0.0)
        Sa = u
        if line < 0:
            for k in range(len(steps)):
                u = plus(u, S[k], vector(strides, velocity, first + steps[k]))
                Sa = plus(Sa, S[k], vector(strides, acceleration, first + steps[k]))
        else:
            for e in range(entries[line]):
                w, row = share[line, e] * S[which[line, e]], table[line, e]
                u = plus(u, w, vector(strides, velocity, row))
                Sa = plus(Sa, w, vector(strides, acceleration, row))
        V = vector(strides, v, p)
        new, mean = moved(update, V, u, Sa, damping[0], damping[1], dt)
        free = plus(V, dt, Sa)
        damped += 0.5 * m[p] * dot(plus(free, -1.0, new), plus(V, 1.0, new))
        for d in range(len(strides)):
            v[p, d] = new[d]
            x[p, d] += dt * mean[d]
            a[p, d] = Sa[d]
    return damped


@kernel
def update_stress(
    particles, grid, stencil, law, geometry, shape, strides, width, dt, part, fresh, lo, hi
):
    """Strain particles lo..hi for part * dt with the velocities of the grid; update their stress.

    fresh: the first strain update of the step; L becomes the average over the updates of the step
    """
    F, stretch, L = particles.F, particles.stretch, particles.L
    stress, work = particles.stress, particles.work
    velocity = grid.velocity
    base, local, near = stencil.base, stencil.local, stencil.near
    entries, which, table, share = stencil.entries, stencil.which, stencil.table, stencil.share
    bend = stencil.bend
    steps = offsets(strides, shape)
    zero = zero_matrix(strides)
    for p in range(lo, hi):
        G = gradients(vector(strides, local, p), shape)
        first, line = base[p], near[p]
        gradient = zero
        if line < 0:
            for k in range(len(steps)):
                v = vector(strides, velocity, first + steps[k])
                gradient = add_outer(v, pick(G, k), gradient)
        else:
            S = weights(vector(strides, local, p), shape)
            for e in range(entries[line]):
                k, v = which[line, e], vector(strides, velocity, table[line, e])
                g = plus(times(pick(G, k), share[line, e]), S[k], vector_of(strides, bend, line, e))
                gradient = add_outer(v, g, gradient)
        gradient = scaled(gradient, 1.0 / width)
        dU = scaled(gradient, part * dt)
        turned = turn(dU, stress, p)
        strain, new = strained(geometry, law, turned, dU)
        work[p] += work_of(turned, new, strain)
        stretch[p] *= 1.0 + strain[2] + 0.5 * strain[2] * strain[2]
        for c in range(stress.shape[1]):
            stress[p, c] = new[c]
        step = increment(dU)
        after = product(step, matrix(dU, F, p))
        for c in range(len(dU)):
            F[p, c] = after[c]
            L[p, c] = part * gradient[c] + (0.0 if fresh else L[p, c])
