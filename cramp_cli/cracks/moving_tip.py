"""J of a tip that moves: the flow of energy into it, with the kinetic energy of the solid.

J = sum V { (P_iJ H_i1 - (w + T) d_1J) q_,J + rho (a_i H_i1 - v_i v_i,1) q }, T = rho v.v/2: the
domain form of the flux into a moving tip (Freund 1990, eq. 5.2.7; Nishioka and Atluri 1983), in the
undeformed body as in domain_integral.py. Velocities count from the mean around the tip: a body that
flies past gives the same J to round-off.
"""

from math import sqrt

from cramp_cli.cracks.domain_integral import local_state, local_vector, seen_from_tip, weight
from cramp_cli.numerics.kernel import kernel


@kernel
def mean_velocity(particles, frame, R0, R1, lo, hi):
    """Return mass and momentum of particles lo..hi around a tip, weighted (kg, N s)."""
    X, v, m = particles.origin, particles.velocity, particles.mass
    mass, px, py = 0.0, 0.0, 0.0
    for p in range(lo, hi):
        dX, dY = X[p, 0] - frame.origin[0], X[p, 1] - frame.origin[1]
        r = sqrt(dX * dX + dY * dY)
        if r < R1:
            w = m[p] * weight(r, R0, R1)[0]
            mass += w
            px += w * v[p, 0]
            py += w * v[p, 1]
    return mass, px, py


@kernel
def integrate_flux(particles, frame, gravity, drift, R0, R1, lo, hi):
    """Return the J of a moving tip over particles lo..hi times the thickness (J/m).

    gravity: acceleration of everything (m/s^2); drift: velocity to count from (m/s)
    """
    X, L, work, v = particles.origin, particles.L, particles.work, particles.velocity
    volume, mass, a = particles.volume, particles.mass, particles.acceleration
    J = 0.0
    for p in range(lo, hi):
        _, _, q, qx, qy, _, axes = seen_from_tip(X, frame, p, R0, R1)
        if q == 0.0:
            continue
        V, rho = volume[p], mass[p] / volume[p]
        _, (pxx, pxy, pyx, pyy), f = local_state(particles, axes, p)
        hxx, hyx = f[0] - 1.0, f[2]
        ax, ay = local_vector(frame.now, a[p, 0] - gravity[0], a[p, 1] - gravity[1])
        vx, vy = local_vector(frame.now, v[p, 0] - drift[0], v[p, 1] - drift[1])
        # v_i,1 in the undeformed body: L F e_1, with F e_1 turned back into the axes of space.
        c, s = frame.now[0], frame.now[1]
        gx, gy = c * f[0] - s * f[2], s * f[0] + c * f[2]
        lx, ly = L[p, 0] * gx + L[p, 1] * gy, L[p, 2] * gx + L[p, 3] * gy
        vxx, vyx = local_vector(frame.now, lx, ly)
        kinetic = 0.5 * rho * (vx * vx + vy * vy)
        J += V * ((pxx * hxx + pyx * hyx - work[p] - kinetic) * qx + (pxy * hxx + pyy * hyx) * qy)
        J += V * rho * q * (ax * hxx + ay * hyx - vx * vxx - vy * vyx)
    return J
