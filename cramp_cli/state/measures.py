"""Energies, momentum and fields for output, read off the particles."""

import numpy as np

from cramp_cli.numerics.kernel import kernel
from cramp_cli.state.particles import DISSIPATED, PLASTIC_STRAIN


@kernel
def sum_energies(particles):
    """Return kinetic, stored and dissipated energy (J).

    Stored is the work of the stresses that plastic and viscous strain have not taken.
    """
    v, m, work, volume = particles.velocity, particles.mass, particles.work, particles.volume
    history = particles.history
    kinetic, total, dissipated = 0.0, 0.0, 0.0
    for p in range(len(m)):
        square = 0.0
        for d in range(v.shape[1]):
            square += v[p, d] * v[p, d]
        kinetic += 0.5 * m[p] * square
        total += work[p] * volume[p]
        if history.shape[1]:
            dissipated += history[p, DISSIPATED] * volume[p]
    return kinetic, total - dissipated, dissipated


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


def from_history(particles, column: int) -> np.ndarray:
    """Return a column of the history, shape (n,); zeros if no law of the model has a history."""
    history = particles.history
    return history[:, column] if history.shape[1] else np.zeros(len(history))


FIELDS = {
    "stress": cauchy_stress,
    "strain": green_strain,
    "displacement": lambda p: p.position - p.origin,
    "velocity": lambda p: p.velocity,
    "acceleration": lambda p: p.acceleration,
    "deformation_gradient": solid_gradient,
    "energy": lambda p: p.work,
    "dissipated_energy": lambda p: from_history(p, DISSIPATED),
    "plastic_strain": lambda p: from_history(p, PLASTIC_STRAIN),
}


@kernel
def fastest(velocity):
    """Return the square of the largest of velocities (n, dim), (m/s)^2; infinite without number."""
    largest = 0.0
    for p in range(len(velocity)):
        square = 0.0
        for d in range(velocity.shape[1]):
            square += velocity[p, d] * velocity[p, d]
        if not square <= largest:
            largest = square if square == square else np.inf
    return largest
