"""What a body of revolution adds to J, and K_I, K_II from it.

A crack is a surface of revolution and its front a ring of radius a. A front that moves by q in the
section moves the solid by a field with hoop parts: grad q has q_r/R, grad u has u_r/R = F_hoop - 1,
and div q has q_r/R as well. The energy released by whole rings, 2 pi a J, is then the plane sum
over rings plus

    sum V (P_hoop (F_hoop - 1) - W) q_r / R

(virtual work of the crack's motion, as in Shih, Moran, Nakamura 1986, for a field of rings).
"""

from math import hypot, sqrt

from cramp_cli.cracks.domain_integral import weight
from cramp_cli.numerics.kernel import kernel


@kernel
def integrate_hoop(particles, frame, R0, R1, lo, hi):
    """Return the hoop part of J over particles lo..hi, times the length of the front (J/m)."""
    X, volume, work = particles.origin, particles.volume, particles.work
    stress, stretch = particles.stress, particles.stretch
    J = 0.0
    for p in range(lo, hi):
        dX, dY = X[p, 0] - frame.origin[0], X[p, 1] - frame.origin[1]
        r = sqrt(dX * dX + dY * dY)
        if r < R1:
            outwards = weight(r, R0, R1)[0] * frame.before[0] / X[p, 0]
            hoop = stress[p, 2] / stretch[p] * (stretch[p] - 1.0)
            J += volume[p] * (hoop - work[p]) * outwards
    return J


def intensities_of(J, K_I, K_II, stiffness) -> tuple[float, float]:
    """Return K_I and K_II that make up J, in the ratio of those of the plane interaction integral.

    The auxiliary fields of the plane are not in balance in a ring: K itself would be off by the
    radius of the domain over that of the front, the ratio is so only where both modes are there.
    """
    size, whole = hypot(K_I, K_II), sqrt(max(J, 0.0) * stiffness)
    return (K_I * whole / size, K_II * whole / size) if size > 0.0 else (0.0, 0.0)
