"""A crack along an arc of a circle in a plate: field and K of any tractions on the plate's border.

Muskhelishvili's potentials on the unit circle, the arc from -alpha to alpha, its faces free:

    Phi = P/X + Q,  Omega = P/X - Q,  X^2 = z^2 - 2 z cos(alpha) + 1,  X ~ z far away,
    z^2 Psi(z) = Phi - z Phi' - conj(Omega(1/conj(z)))

with Laurent polynomials P and Q. Q follows from P, as Phi and Psi have no pole at the centre; the
coefficients of P are those with which the tractions on the border are met (least squares at some
hundred places: boundary collocation). `field` gives stress and displacement gradient.
"""

from dataclasses import dataclass

import numpy as np
from numpy.polynomial import legendre

TERMS = 24  # powers of z to either side
PLACES = 60  # on each side of the plate


@dataclass(frozen=True)
class Arc:
    """Circle of an arc, the direction of its middle and its half angle (m, rad)."""

    center: tuple
    radius: float
    middle: float
    half: float

    def local(self, places):
        """Return places (n, 2) in the plane of the unit circle."""
        away = (np.asarray(places) - self.center) @ [1.0, 1j]
        return away * np.exp(-1j * self.middle) / self.radius


def root(z, alpha):
    """Return X, cut along the arc."""
    w = (z - np.exp(1j * alpha)) / (z - np.exp(-1j * alpha))
    turn = np.exp(0.5j * alpha)
    return (z - np.exp(-1j * alpha)) * turn * np.sqrt(w / turn**2)


def coefficients(alpha, n, scale):
    """Return the matrices that give P and Q, and what must vanish, from the real unknowns.

    Unknowns are the real and the imaginary parts of the coefficients of z^-n .. z^n in P, scaled.
    """
    powers = np.arange(-n, n + 1)
    basis = np.hstack(
        [np.diag(1.0 / scale ** np.abs(powers)), 1j * np.diag(1.0 / scale ** np.abs(powers))]
    )
    P_n = np.array([legendre.legval(np.cos(alpha), np.eye(k + 1)[k]) for k in range(2 * n + 2)])
    far, near = np.zeros((2 * n + 1, 2 * n + 1)), np.zeros((2 * n + 1, 2 * n + 1))
    for k in powers:  # 1/X = sum P_m z^(-m-1) far away and -sum P_m z^m at the centre
        for j in powers:
            if k - j >= 0:
                near[k + n, j + n] = -P_n[k - j]
            if j - 1 - k >= 0:
                far[k + n, j + n] = P_n[j - 1 - k]
    Q = np.where(powers[:, None] > 0, far, np.where(powers[:, None] < 0, -near, 0.0)) @ basis
    at_0, at_inf = near[n] @ basis, far[n] @ basis
    Q[n] = 0.5 * (at_inf.real - at_0.real)
    vanish = np.array([far[n - 1] @ basis, near[n - 1] @ basis])
    return basis, Q, np.vstack([vanish.real, vanish.imag, at_0.imag + at_inf.imag])


def potentials(z, alpha, P, Q):
    """Return Phi, its derivative, and Psi at places z; columns as of P and Q."""
    n = (len(P) - 1) // 2
    powers = np.arange(-n, n + 1)
    X, X_out = root(z, alpha)[:, None], root(1.0 / z.conj(), alpha)[:, None]
    power = z[:, None] ** powers
    slope = powers * z[:, None] ** (powers - 1)
    P_z, Q_z = power @ P, power @ Q
    phi = P_z / X + Q_z
    prime = (slope @ P) / X - P_z * (z[:, None] - np.cos(alpha)) / X**3 + slope @ Q
    mirrored = (1.0 / z.conj())[:, None] ** powers
    omega = (mirrored @ P) / X_out - mirrored @ Q
    psi = (phi - z[:, None] * prime - omega.conj()) / z[:, None] ** 2
    return phi, prime, psi


def stresses(z, phi, prime, psi):
    """Return xx, yy, xy."""
    total, half = 4.0 * phi.real, 2.0 * (z[:, None].conj() * prime + psi)
    yy = 0.5 * (total + half.real)
    return total - yy, yy, 0.5 * half.imag


class ArcCrack:
    """A plate with an arc crack under a uniform stress (xx, yy, xy) on its border."""

    def __init__(self, arc, lower, upper, stress=(0.0, 1.0, 0.0), terms=TERMS):
        self.arc = arc
        self.places, self.normals = border(lower, upper)
        z = arc.local(self.places)
        scale = np.abs(z).max()
        self.basis, Q, vanish = coefficients(arc.half, terms, scale)
        xx, yy, xy = stresses(z, *potentials(z, arc.half, self.basis, Q))
        nx, ny = (self.normals @ turned(arc.middle)).T[..., None]
        rows = np.vstack([xx * nx + xy * ny, xy * nx + yy * ny])
        sxx, syy, sxy = stress
        pulled = self.normals @ np.array([[sxx, sxy], [sxy, syy]]) @ turned(arc.middle)
        # What must vanish: restrict the unknowns to its null space.
        _, sizes, right = np.linalg.svd(vanish)
        free = right[np.sum(sizes > 1e-10 * sizes[0]) :].T
        wanted = pulled.T.ravel()
        found, *_ = np.linalg.lstsq(rows @ free, wanted, rcond=1e-13)
        self.residual = float(np.abs(rows @ free @ found - wanted).max())
        self.P, self.Q = self.basis @ free @ found, Q @ free @ found

    def intensities(self, end=1):
        """Return K_I, K_II (sqrt(m)) of the tip at the larger angle (1) or the other one (-1)."""
        tip, ahead = np.exp(1j * end * self.arc.half), end * 1j * np.exp(1j * end * self.arc.half)
        away = 1e-10
        z = np.array([tip + away * ahead])
        P = z[:, None] ** np.arange(-(len(self.P) // 2), len(self.P) // 2 + 1) @ self.P
        K = 2.0 * np.sqrt(2.0 * np.pi * away) * P[0] / root(z, self.arc.half)[0]
        return np.array([K.real, -K.imag]) * np.sqrt(self.arc.radius)

    def field(self, places, shear, kappa):
        """Return displacement gradient and stress (n, 2, 2) at places (n, 2), in axes of space."""
        z = self.arc.local(places)
        columns = self.P[:, None], self.Q[:, None]
        phi, prime, psi = potentials(z, self.arc.half, *columns)
        xx, yy, xy = (s[:, 0] for s in stresses(z, phi, prime, psi))
        one = kappa * phi - phi.conj()
        two = z[:, None] * prime.conj() + psi.conj()
        along, up = (one - two)[:, 0], 1j * (one + two)[:, 0]
        R = turned(self.arc.middle)
        H = np.array([[along.real, up.real], [along.imag, up.imag]]).transpose(2, 0, 1)
        stress = np.array([[xx, xy], [xy, yy]]).transpose(2, 0, 1)
        return R @ H @ R.T / (2.0 * shear), R @ stress @ R.T


def turned(angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s], [s, c]])


def border(lower, upper):
    """Return places on the sides of a rectangle (n, 2) and the outward normals there."""
    (x0, y0), (x1, y1) = lower, upper
    share = 0.5 - 0.5 * np.cos(np.pi * (np.arange(PLACES) + 0.5) / PLACES)
    x, y, one = x0 + share * (x1 - x0), y0 + share * (y1 - y0), np.ones(PLACES)
    sides = [(x, y0 * one, 0, -1), (x, y1 * one, 0, 1), (x0 * one, y, -1, 0), (x1 * one, y, 1, 0)]
    places = np.vstack([np.stack([a, b], axis=1) for a, b, *_ in sides])
    normals = np.vstack([np.tile([[c, d]], (PLACES, 1)) for *_, c, d in sides]).astype(float)
    return places, normals
