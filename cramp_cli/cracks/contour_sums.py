"""Sums over particles for J on a contour: fields at its nodes, inertia within."""

from typing import NamedTuple

from cramp_cli.numerics.kernel import kernel
from cramp_cli.numerics.matrix import (
    matrix,
    product,
    rotation_of,
    zero_matrix,
)
from cramp_cli.numerics.vector import vector
from cramp_cli.shapes.shape import node_steps, offsets, place_of, weights


class Box(NamedTuple):
    """Rectangle of nodes: corner and number of nodes along each axis."""

    i: int
    j: int
    wide: int
    high: int


@kernel
def place_in(box, i, j, row, nodes):
    """Return where the sums of a row of node i, j stand; nodes: rows that are nodes."""
    if row < nodes:
        return i - box.i + (j - box.j) * box.wide
    return box.wide * box.high + row - nodes


@kernel
def sum_fields(sums, particles, stencil, shape, strides, box, nodes, lower, width, lo, hi):
    """Add mass-weighted fields of particles lo..hi to the rows of the nodes in a box.

    sums: (box nodes + extra rows, 11): mass, du_x/dx, du_x/dy, du_y/dx, du_y/dy, stress xx, yy, xy,
    energy density, kinetic energy density, and volume over mass. The gradient is R F R^T - 1: it
    must hold the rotation.
    """
    position, seen = particles.position, len(node_steps(shape, 1)) * width
    west, south = lower[0] + width * box.i, lower[1] + width * box.j
    east, north = west + width * box.wide, south + width * box.high
    for p in range(lo, hi):
        x, y = position[p, 0], position[p, 1]
        if x > west - seen and x < east + seen and y > south - seen and y < north + seen:
            _add_fields(sums, particles, stencil, shape, strides, box, nodes, p)


@kernel
def _add_fields(sums, particles, stencil, shape, strides, box, nodes, p):
    stress, volume, mass = particles.stress, particles.volume, particles.mass
    which, table, share = stencil.which, stencil.table, stencil.share
    steps, line = offsets(strides, shape), stencil.near[p]
    S = weights(place_of(shape, strides, stencil, p), shape)
    F = matrix(zero_matrix(strides), particles.F, p)
    R = rotation_of(F)
    H = product(product(R, F), (R[0], R[2], R[1], R[3]))
    v = vector(strides, particles.velocity, p)
    kinetic = 0.5 * mass[p] / volume[p] * (v[0] * v[0] + v[1] * v[1])
    for e in range(len(steps) if line < 0 else stencil.entries[line]):
        k, w = e, mass[p]
        if line >= 0:
            k, w = which[line, e], mass[p] * share[line, e]
        node = stencil.base[p] + steps[k]
        i, j = node % strides[1], node // strides[1]
        if i < box.i or j < box.j or i >= box.i + box.wide or j >= box.j + box.high:
            continue
        to = place_in(box, i, j, node if line < 0 else table[line, e], nodes)
        w *= S[k]
        sums[to, 0] += w
        sums[to, 1] += w * (H[0] - 1.0)
        sums[to, 2] += w * H[1]
        sums[to, 3] += w * H[2]
        sums[to, 4] += w * (H[3] - 1.0)
        sums[to, 5] += w * stress[p, 0]
        sums[to, 6] += w * stress[p, 1]
        sums[to, 7] += w * stress[p, 3]
        sums[to, 8] += w * particles.work[p]
        sums[to, 9] += w * kinetic
        sums[to, 10] += w * volume[p] / mass[p]


@kernel
def area_term(particles, gravity, lower, upper, lo, hi):
    """Return sums over the particles in a rectangle: inertia along x, y (N), and volume (m^3)."""
    x, v, a, m = particles.position, particles.velocity, particles.acceleration, particles.mass
    F, L, volume = particles.F, particles.L, particles.volume
    Ax, Ay, inside = 0.0, 0.0, 0.0
    for p in range(lo, hi):
        if x[p, 0] < lower[0] or x[p, 0] > upper[0] or x[p, 1] < lower[1] or x[p, 1] > upper[1]:
            continue
        f = (F[p, 0], F[p, 1], F[p, 2], F[p, 3])
        R = rotation_of(f)
        H = product(product(R, f), (R[0], R[2], R[1], R[3]))
        ax, ay = a[p, 0] - gravity[0], a[p, 1] - gravity[1]
        Ax += m[p] * (ax * (H[0] - 1.0) + ay * H[2] - v[p, 0] * L[p, 0] - v[p, 1] * L[p, 2])
        Ay += m[p] * (ax * H[1] + ay * (H[3] - 1.0) - v[p, 0] * L[p, 1] - v[p, 1] * L[p, 3])
        inside += volume[p] * (f[0] * f[3] - f[1] * f[2])
    return Ax, Ay, inside
