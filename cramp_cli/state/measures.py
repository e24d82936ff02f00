"""Energies, momentum and fields for output, read off the particles."""

import numpy as np

from cramp_cli.numerics.kernel import kernel


@kernel
def sum_energies(particles):
    """Return kinetic energy and work of the stresses (J)."""
    v, m, work, volume = particles.velocity, particles.mass, particles.work, particles.volume
    kinetic, stored = 0.0, 0.0
    for p in range(len(m)):
        square = 0.0
        for d in range(v.shape[1]):
            square += v[p, d] * v[p, d]
        kinetic += 0.5 * m[p] * square
        stored += work[p] * volume[p]
    return kinetic, stored


def momentum(particles) -> np.ndarray:
    """Return the momentum of all particles (N s)."""
    return particles.mass @ particles.velocity


def solid_gradient(particles) -> np.ndarray:
    """Return the deformation gradient with the direction normal to the plane, shape (n, 3, 3)."""
    n, dim = particles.position.shape
    F = np.zeros((n, 3, 3))
    F[:, 2, 2] = particles.stretch
    F[:, :dim, :dim] = particles.F.reshape(n, dim, dim)
    return F


def cauchy_stress(particles) -> np.ndarray:
    """Return the Cauchy stress, shape (n, 3, 3), in Pa."""
    s = particles.stress
    tau = np.zeros((len(s), 3, 3))
    for c, (i, j) in enumerate(((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))[: s.shape[1]]):
        tau[:, i, j] = tau[:, j, i] = s[:, c]
    return tau / np.linalg.det(solid_gradient(particles))[:, None, None]


def green_strain(particles) -> np.ndarray:
    """Return the Green-Lagrange strain (F^T F - 1)/2, shape (n, 3, 3)."""
    F = solid_gradient(particles)
    return 0.5 * (np.einsum("nki,nkj->nij", F, F) - np.eye(3))


FIELDS = {
    "stress": cauchy_stress,
    "strain": green_strain,
    "displacement": lambda p: p.position - p.origin,
    "velocity": lambda p: p.velocity,
    "acceleration": lambda p: p.acceleration,
    "deformation_gradient": solid_gradient,
    "energy": lambda p: p.work,
}
