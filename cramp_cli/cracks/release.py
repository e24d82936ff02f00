"""What a tip that moves takes out of the solid around it.

Particles carry their strain with them, so a tip that moves on would leave the strain of the whole
solid behind it: no energy would ever be spent. Strain is the gradient of the displacement that the
rows of the grid hold, and the rows that a particle sees change when the tip passes it. So the
particles around a tip are strained by the difference of this gradient after and before the tip has
moved; the work of the stress in it is the energy that the new surface has taken.
"""

import numpy as np

from cramp_cli.materials.geometry import strained
from cramp_cli.numerics.kernel import kernel
from cramp_cli.numerics.tensor import (
    add_outer,
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

REACH = 7.0  # cells around a tip whose particles are looked at


@kernel
def sum_displacement(
    sums, particles, stencil, chosen, shape, strides, nodes_along, lower, width, lo, hi
):
    """Add mass and mass-weighted displacement of chosen particles in lo..hi to their rows.

    The displacement of a particle is carried on to the node with its gradient, so that a body which
    is strained evenly gives the displacement of the node.
    sums: (rows, 3) kg, kg m
    """
    x, X, m, F = particles.position, particles.origin, particles.mass, particles.F
    base, local, near = stencil.base, stencil.local, stencil.near
    entries, which, table, share = stencil.entries, stencil.which, stencil.table, stencil.share
    steps = offsets(strides, shape)
    for p in chosen:
        if p < lo or p >= hi:
            continue
        S = weights(vector(strides, local, p), shape)
        det = F[p, 0] * F[p, 3] - F[p, 1] * F[p, 2]
        hxx, hxy = 1.0 - F[p, 3] / det, F[p, 1] / det
        hyx, hyy = F[p, 2] / det, 1.0 - F[p, 0] / det
        start, line = base[p], near[p]
        count = len(steps) if line < 0 else entries[line]
        for e in range(count):
            k, row, w = e, start + steps[e % len(steps)], m[p]
            if line >= 0:
                k, row, w = which[line, e], table[line, e], m[p] * share[line, e]
            w *= S[k]
            node = start + steps[k]
            dx = lower[0] + width * (node % nodes_along[0]) - x[p, 0]
            dy = lower[1] + width * (node // strides[1]) - x[p, 1]
            sums[row, 0] += w
            sums[row, 1] += w * (x[p, 0] - X[p, 0] + hxx * dx + hxy * dy)
            sums[row, 2] += w * (x[p, 1] - X[p, 1] + hyx * dx + hyy * dy)


@kernel
def find_gradient(gradient, sums, stencil, chosen, shape, strides, width, lo, hi):
    """Set the gradient (chosen, 4) of the displacement of the rows at chosen particles in lo..hi."""
    base, local, near = stencil.base, stencil.local, stencil.near
    entries, which, table, share = stencil.entries, stencil.which, stencil.table, stencil.share
    bend = stencil.bend
    steps = offsets(strides, shape)
    for i in range(len(chosen)):
        p = chosen[i]
        if p < lo or p >= hi:
            continue
        S = weights(vector(strides, local, p), shape)
        G = gradients(vector(strides, local, p), shape)
        start, line = base[p], near[p]
        total = zero_matrix(strides)
        count = len(steps) if line < 0 else entries[line]
        for e in range(count):
            k, row = e, start + steps[e % len(steps)]
            g = pick(G, k % len(steps))
            if line >= 0:
                k, row = which[line, e], table[line, e]
                g = plus(times(pick(G, k), share[line, e]), S[k], vector_of(strides, bend, line, e))
            if sums[row, 0] > 0.0:
                u = (sums[row, 1] / sums[row, 0], sums[row, 2] / sums[row, 0])
                total = add_outer(u, g, total)
        for c in range(4):
            gradient[i, c] = total[c] / width


@kernel
def strain_by(change, particles, chosen, law, geometry, lo, hi):
    """Strain chosen particles in lo..hi by a change of the displacement gradient.

    change: (chosen, 4) with respect to the places of now
    returns: the work of the stress in it (J)
    """
    F, stretch, stress = particles.F, particles.stretch, particles.stress
    work, volume = particles.work, particles.volume
    total = 0.0
    for i in range(len(chosen)):
        p = chosen[i]
        if p < lo or p >= hi:
            continue
        delta = (change[i, 0], change[i, 1], change[i, 2], change[i, 3])
        dU = product(matrix(delta, F, p), delta)
        turned = turn(dU, stress, p)
        strain, new = strained(geometry, law, turned, dU)
        done = work_of(turned, new, strain)
        work[p] += done
        total += volume[p] * done
        stretch[p] *= 1.0 + strain[2] + 0.5 * strain[2] * strain[2]
        after = product(increment(dU), matrix(dU, F, p))
        for c in range(stress.shape[1]):
            stress[p, c] = new[c]
        for c in range(len(dU)):
            F[p, c] = after[c]
    return total


def particles_around(particles, places, reach) -> np.ndarray:
    """Return the numbers of the particles within `reach` (m) of any of the places (n, 2)."""
    near = np.zeros(len(particles.position), dtype=bool)
    for place in places:
        near |= np.sum((particles.position - place) ** 2, axis=1) < reach * reach
    return np.flatnonzero(near)


def displacement_gradient(model, state, scratch, chosen) -> np.ndarray:
    """Return the gradient (chosen, 4) of the displacement that the rows hold now."""
    lattice, strides = model.lattice, model.strides
    sums, gradient = np.zeros((scratch.row_count, 3)), np.zeros((len(chosen), 4))
    particles, stencil = state.particles, scratch.stencil
    place = (strides, lattice.nodes, lattice.lower, lattice.width)
    for b in model.blocks:
        sum_displacement(sums, particles, stencil, chosen, b.shape, *place, b.lo, b.hi)
    for b in model.blocks:
        find_gradient(gradient, sums, stencil, chosen, b.shape, strides, lattice.width, b.lo, b.hi)
    return gradient


def take_strain(model, state, chosen, change) -> float:
    """Strain particles by a change of the displacement gradient; return the energy gained (J)."""
    return sum(
        strain_by(change, state.particles, chosen, b.law, model.geometry, b.lo, b.hi)
        for b in model.blocks
    )
