"""Particles carry the solid."""

from typing import NamedTuple

import numpy as np

# Columns of Particles.history. The first two mean the same in every law that has a history.
DISSIPATED = 0  # energy per initial volume that plastic and viscous strain have taken, J/m^3
PLASTIC_STRAIN = 1  # equivalent plastic strain; zero for laws without one
OWN = 2  # first column of the law's own

DELETED = -1  # place of a particle that is no more; it has no volume and lies behind the last band


class Particles(NamedTuple):
    """State of all particles; first axis = particle, `dim` = 2 or 3.

    Particles of one block (material and particle size) are contiguous.
    """

    position: np.ndarray  # (n, dim) m
    origin: np.ndarray  # (n, dim) position at the start, m
    velocity: np.ndarray  # (n, dim) m/s
    acceleration: np.ndarray  # (n, dim) of the forces on the grid, without damping, m/s^2
    F: np.ndarray  # (n, dim*dim) deformation gradient in the plane or the solid, row by row
    stretch: np.ndarray  # (n,) normal to a plane problem: F_zz
    stress: np.ndarray  # (n, 4 or 6) Kirchhoff stress xx, yy, zz, xy[, yz, xz], Pa
    L: np.ndarray  # (n, dim*dim) velocity gradient of the last step, 1/s; then v_r/r of rings
    work: np.ndarray  # (n,) work of the stress per initial volume, J/m^3
    history: np.ndarray  # (n, k) what the laws remember; k of the law that needs most, 0 for none
    mass: np.ndarray  # (n,) kg
    volume: np.ndarray  # (n,) at the start, m^3
    body: np.ndarray  # (n,) number of the body in the deck
    id: np.ndarray  # (n,) number of the particle, kept when particles are sorted


def particles_at(position, body, mass, volume, memory: int = 0, *, rings=False) -> Particles:
    """Return unstressed particles at rest.

    position: (n, dim) m; body: (n,); mass: (n,) kg; volume: (n,) m^3
    memory: columns of the history; rings: about an axis, with a rate of hoop strain
    """
    n, dim = position.shape
    return Particles(
        position=np.ascontiguousarray(position, dtype=float),
        origin=np.array(position, dtype=float),
        velocity=np.zeros((n, dim)),
        acceleration=np.zeros((n, dim)),
        F=np.tile(np.eye(dim).ravel(), (n, 1)),
        stretch=np.ones(n),
        stress=np.zeros((n, 4 if dim == 2 else 6)),
        L=np.zeros((n, dim * dim + rings)),
        work=np.zeros(n),
        history=np.zeros((n, memory)),
        mass=np.ascontiguousarray(mass, dtype=float),
        volume=np.ascontiguousarray(volume, dtype=float),
        body=np.ascontiguousarray(body, dtype=np.int64),
        id=np.arange(n),
    )


def is_deleted(particles) -> np.ndarray:
    """Return for each particle whether it is no more, shape (n,)."""
    return particles.volume == 0.0
