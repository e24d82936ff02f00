"""J, K_I and K_II as sums over the particles around a tip.

The equivalent domain integral (Shih, Moran, Nakamura 1986) and the interaction integral (Yau, Wang,
Corten 1980) with inertia (Rethore et al. 2005), in the undeformed configuration: exact for finite
rotations, with the local axes turned back to the crack's initial direction. Places and axes follow
a curved crack (curved.py). The weight falls from 1 at R0 to 0 at R1 as a quintic: particles are a
coarse quadrature, and a weight with corners would put some percent of noise on K.
"""

from math import atan2, pi, sqrt
from typing import NamedTuple

from cramp_cli.cracks.curved import FLOOR, of_the_bend, place_along, turned_by, unit_gradient
from cramp_cli.cracks.williams import unit_slope, unit_stress
from cramp_cli.numerics.kernel import inlined_kernel, kernel

INNER = 0.2  # R0/R1 of a large domain
NEAR_TIP = 2.0  # cells around a tip that are its own: q is 1 there, so they hardly count


class TipFrame(NamedTuple):
    """Where a tip is and where it points, before and after deformation."""

    origin: tuple  # tip in the undeformed body (m)
    before: tuple  # unit vector out of the crack in the undeformed body
    now: tuple  # the same now
    line: float = 0.0  # height of the crack's line over the origin, in the axes of before (m)
    bend: float = 0.0  # curvature of the crack at its tip, positive to the left (1/m)


class Hooke(NamedTuple):
    """Elastic constants at the tip."""

    shear: float  # Pa
    kappa: float  # Kolosov's constant
    plane_nu: float  # nu in plane strain, nu/(1 + nu) in plane stress
    stiffness: float  # E' with J = K^2/E' (Pa)


def inner_radius(R1, width):
    """Return R0 (m): beyond what a tip does to the cells around it, but at most half of R1."""
    return min(max(INNER * R1, NEAR_TIP * width), 0.5 * R1)


@kernel
def weight(r, R0, R1):
    """Return q(r) and dq/dr."""
    if r <= R0:
        return 1.0, 0.0
    s = (r - R0) / (R1 - R0)
    return 1.0 - s**3 * (10.0 - 15.0 * s + 6.0 * s * s), -30.0 * s * s * (1.0 - s) ** 2 / (R1 - R0)


@kernel
def fill_weights(q, r, R0, R1):
    """Set the weights q at distances r from the tip (m), two arrays; none beyond R1."""
    for i in range(len(r)):
        q[i] = weight(r[i], R0, R1)[0] if r[i] < R1 else 0.0


@kernel
def integral_of_weight(R0, R1):
    """Return the integral of q over the full circle (m^2)."""
    fall = R1 - R0
    return 2.0 * pi * (0.5 * R0 * R0 + 0.5 * R0 * fall + fall * fall / 7.0)


@kernel
def local_vector(axis, x, y):
    """Return a vector in axes turned so that `axis` is the first."""
    return axis[0] * x + axis[1] * y, -axis[1] * x + axis[0] * y


@kernel
def local_stress(axis, stress, p):
    """Return xx, yy, xy of the stress of a particle in axes turned so that `axis` is the first."""
    c, s = axis[0], axis[1]
    xx, yy, xy = stress[p, 0], stress[p, 1], stress[p, 3]
    cross = 2.0 * c * s * xy
    return (
        c * c * xx + s * s * yy + cross,
        s * s * xx + c * c * yy - cross,
        c * s * (yy - xx) + (c * c - s * s) * xy,
    )


@kernel
def local_gradient(axes, F, p):
    """Return F of a particle: rows in the local axes of now, columns in those of before."""
    before, now = axes
    a0, b0 = local_vector(now, F[p, 0], F[p, 2])
    a1, b1 = local_vector(now, F[p, 1], F[p, 3])
    f00, f01 = local_vector(before, a0, a1)
    f10, f11 = local_vector(before, b0, b1)
    return f00, f01, f10, f11


@kernel
def material_beside(particles, frame, length, line, lo, hi):
    """Return weighed volumes of particles above and below the crack just behind a tip (m^3).

    Above is what lies further than `line` (m) above the crack: a hair, with the sign that gives
    particles on the crack to the side on which the line test sees them (crossing.py).

    The weight is a bump of height 1 along the crack, from the tip to `length` behind it, times one
    that falls from the crack to `length` on either side; its integral is length/2 along the crack.
    """
    X, volume = particles.origin, particles.volume
    above, below = 0.0, 0.0
    for p in range(lo, hi):
        x, y, _ = place_along(frame, X[p, 0] - frame.origin[0], X[p, 1] - frame.origin[1])
        if -length < x < 0.0 and abs(y) < length:
            along = weight(abs(x + 0.5 * length), 0.0, 0.5 * length)[0]
            w = volume[p] * along * weight(abs(y), 0.0, length)[0] / (1.0 - frame.bend * y)
            if y > line:
                above += w
            else:
                below += w
    return above, below


@kernel
def beside_crack(particles, frame, width, R0, R1, lo, hi):
    """Return sums over the particles within `width` (m) of the crack behind a tip.

    returns: integral of the weight q/sqrt(r), of it times the shear and the normal stress
    """
    X, volume, stress = particles.origin, particles.volume, particles.stress
    total, shear, normal = 0.0, 0.0, 0.0
    for p in range(lo, hi):
        x, y, turn = place_along(frame, X[p, 0] - frame.origin[0], X[p, 1] - frame.origin[1])
        if -R1 < x < -width and abs(y) < width:
            w = volume[p] * weight(-x, R0, R1)[0] / sqrt(-x)
            _, yy, xy = local_stress(turned_by(frame.now, turn), stress, p)
            total += w
            shear += w * xy
            normal += w * yy
    return total, shear, normal


@inlined_kernel
def seen_from_tip(X, frame, p, R0, R1):
    """Return where particle p started, seen from the tip along the crack, weight and its gradient.

    The weight is 0 outside the domain and at the tip itself, where the asymptotic fields are
    infinite.

    returns: distance (m) and angle (rad), weight and its derivatives ahead and to the left (1/m),
    how far across the crack (m), the axes before and now there
    """
    dX, dY = X[p, 0] - frame.origin[0], X[p, 1] - frame.origin[1]
    x, y, turn = place_along(frame, dX, dY)
    axes = (turned_by(frame.before, turn), turned_by(frame.now, turn))
    r = sqrt(x * x + y * y)
    if r >= R1 or r < 1e-9 * R1:
        return r, 0.0, 0.0, 0.0, 0.0, y, axes
    q, slope = weight(r, R0, R1)
    ahead = slope * x / r / (1.0 - frame.bend * y)
    return r, angle_of_side(x, y, frame.line), q, ahead, slope * y / r, y, axes


@inlined_kernel
def angle_of_side(x, y, line):
    """Return the angle at which a place is seen from the tip by the side of the crack it is on.

    Behind the tip that is the side of the line of the crack, which may lie above or below the
    origin of the frame (`between_particles` in site.py): with the field of the other face a single
    particle between the two would be an error of a percent.
    """
    angle = atan2(y, x)
    if x < 0.0:
        if y > line and angle < 0.0:
            return angle + 2.0 * pi
        if y <= line and angle > 0.0:
            return angle - 2.0 * pi
    return angle


@inlined_kernel
def local_state(particles, axes, p):
    """Return Kirchhoff stress (xx, yy, xy), first Piola-Kirchhoff stress and F in the crack's axes.

    P = tau F^-T and F are xx, xy, yx, yy: the first index along the axes of now, the second of
    before.

    axes: before and now, where the particle is
    """
    txx, tyy, txy = local_stress(axes[1], particles.stress, p)
    f00, f01, f10, f11 = local_gradient(axes, particles.F, p)
    det = f00 * f11 - f01 * f10
    pxx, pxy = (txx * f11 - txy * f01) / det, (txy * f00 - txx * f10) / det
    pyx, pyy = (txy * f11 - tyy * f01) / det, (tyy * f00 - txy * f10) / det
    return (txx, tyy, txy), (pxx, pxy, pyx, pyy), (f00, f01, f10, f11)


@kernel
def integrate_domain(particles, frame, hooke, gravity, R0, R1, lo, hi):
    """Return J and the integrals for K_I and K_II over particles lo..hi, per thickness times V.

    returns: J (J/m^2 times thickness), K_I, K_II (Pa sqrt(m) times thickness), integral of q (m^3)
    """
    X, work, volume, mass = particles.origin, particles.work, particles.volume, particles.mass
    acceleration = particles.acceleration
    J, I1, I2, filled, k = 0.0, 0.0, 0.0, 0.0, frame.bend
    for p in range(lo, hi):
        r, angle, q, qx, qy, y, axes = seen_from_tip(X, frame, p, R0, R1)
        if q == 0.0:
            continue
        V = volume[p]
        filled += V * q
        tau, P, f = local_state(particles, axes, p)
        (txx, tyy, txy), (pxx, pxy, pyx, pyy) = tau, P
        hxx, hyx = f[0] - 1.0, f[2]
        a = acceleration[p, 0] - gravity[0], acceleration[p, 1] - gravity[1]
        ax, ay = local_vector(axes[1], a[0], a[1])
        inertia = mass[p] / V * q
        J += V * ((pxx * hxx + pyx * hyx - work[p]) * qx + (pxy * hxx + pyy * hyx) * qy)
        J += V * inertia * (ax * hxx + ay * hyx)
        if k != 0.0:
            J += V * q * k / (1.0 - k * y) * (pxx * f[1] + pyx * (f[3] - 1.0))
        for mode in (1, 2):
            sxx, syy, sxy = unit_stress(mode, r, angle)
            ux, uy = unit_slope(mode, r, angle, hooke.shear, hooke.kappa)
            bent = 0.0
            if k != 0.0:
                ux, _, uy, _ = unit_gradient(mode, r, angle, hooke, k, 1.0 - k * y)
                bent = q * of_the_bend(mode, max(r, FLOOR * R0), angle, hooke, k, y, tau, P, f)
            mean = hooke.plane_nu * (sxx + syy)
            both = (txx * (sxx - mean) + tyy * (syy - mean) + 2.0 * txy * sxy) / (2.0 * hooke.shear)
            integral = V * (
                (pxx * ux + pyx * uy + sxx * hxx + sxy * hyx - both) * qx
                + (pxy * ux + pyy * uy + sxy * hxx + syy * hyx) * qy
                + inertia * (ax * ux + ay * uy)
                + bent
            )
            if mode == 1:
                I1 += integral
            else:
                I2 += integral
    return J, 0.5 * hooke.stiffness * I1, 0.5 * hooke.stiffness * I2, filled
