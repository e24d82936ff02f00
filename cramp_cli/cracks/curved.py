"""Coordinates that follow a curved crack, and what they add to the integrals around its tip.

x runs along the circle that touches the crack at its tip, y across it, and the axes turn with it.
In them the faces are straight, so that the asymptotic field of a straight crack leaves them free.
With the curvature k of the circle, positive where the crack turns to the left on its way, and
h = 1 - k y the displacement U of that field has the gradient

    L_11 = (D_11 - k U_2)/h,  L_21 = (D_21 + k U_1)/h,  L_i2 = D_i2,   D_ij = dU_i/dx_j,

and its stress S is no longer in equilibrium, its strain E no longer that of U. The virtual
extension q e_1 turns too. With the stress s and the displacement u of the solid the interaction
integral gains

    q (k/h) (s_i1 L_i2 + S_i1 u_i,2)                        turning extension
    q (k/h) [(y S_11,x - 2 S_12) u_1,1 + (y S_12,x + S_11 - S_22) u_2,1]      equilibrium
    q (1/h) [s_11 (A' - 2 k B) + 2 s_12 (B' + k A) + 2 s_22 k B]              compatibility
    A = L_11 - E_11 = (k/h)(y D_11 - U_2),  B = (L_12 + L_21)/2 - E_12 = (k/2h)(y D_21 + U_1)

(A', B' along x), and J gains q (k/h) s_i1 u_i,2: the divergence of M_kj q e_1, as in Gosz and Moran
(2002) for fronts in space. Only together are they right: each alone is as large as the error of
leaving out all.
"""

from math import atan2, sqrt

from cramp_cli.cracks.williams import (
    unit_displacement,
    unit_slope,
    unit_slope_across,
    unit_slope_change,
    unit_stress,
    unit_stress_slope,
)
from cramp_cli.numerics.kernel import inlined_kernel, kernel

FLOOR = 0.125  # share of R0 below which the field is taken no nearer to the tip, in terms with q


@inlined_kernel
def place_along(frame, dX, dY):
    """Return where a place lies along the crack and across it (m), and the turn of the axes there.

    dX, dY: from the origin of the frame (m); turn: cosine and sine
    """
    (ex, ey), k = frame.before, frame.bend
    x, y = ex * dX + ey * dY, -ey * dX + ex * dY
    if k == 0.0:
        return x, y, (1.0, 0.0)
    away = sqrt((k * x) ** 2 + (1.0 - k * y) ** 2)  # from the centre, in radii
    across = (2.0 * y - k * (x * x + y * y)) / (1.0 + away)
    return atan2(k * x, 1.0 - k * y) / k, across, ((1.0 - k * y) / away, k * x / away)


@inlined_kernel
def turned_by(axis, turn):
    """Return a direction (x, y) turned by (cosine, sine)."""
    c, s = turn
    return c * axis[0] - s * axis[1], s * axis[0] + c * axis[1]


@kernel
def unit_gradient(mode, r, angle, hooke, k, h):
    """Return L_11, L_12, L_21, L_22 of a unit intensity, 1/(Pa sqrt(m)); h: 1 - k y."""
    d11, d21 = unit_slope(mode, r, angle, hooke.shear, hooke.kappa)
    d12, d22 = unit_slope_across(mode, r, angle, hooke.shear, hooke.kappa)
    u1, u2 = unit_displacement(mode, r, angle, hooke.shear, hooke.kappa)
    return (d11 - k * u2) / h, d12, (d21 + k * u1) / h, d22


@kernel
def of_the_bend(mode, r, angle, hooke, k, y, tau, P, f):
    """Return what the curvature k (1/m) adds to the interaction integral, over q (1/m^1.5 Pa).

    y: across the crack (m); tau, P, f: Kirchhoff stress, first Piola-Kirchhoff stress and F of the
    particle in the axes of the crack, as of `local_state`
    """
    h = 1.0 - k * y
    sxx, syy, sxy = unit_stress(mode, r, angle)
    sxx_x, _, sxy_x = unit_stress_slope(mode, r, angle)
    d11, d21 = unit_slope(mode, r, angle, hooke.shear, hooke.kappa)
    d111, d211 = unit_slope_change(mode, r, angle, hooke.shear, hooke.kappa)
    u1, u2 = unit_displacement(mode, r, angle, hooke.shear, hooke.kappa)
    l12, l22 = unit_slope_across(mode, r, angle, hooke.shear, hooke.kappa)
    turning = P[0] * l12 + P[2] * l22 + sxx * f[1] + sxy * (f[3] - 1.0)
    lack = (y * sxx_x - 2.0 * sxy) * (f[0] - 1.0) + (y * sxy_x + sxx - syy) * f[2]
    a, b = (y * d11 - u2) / h, 0.5 * (y * d21 + u1) / h  # A/k and B/k
    a_x, b_x = (y * d111 - d21) / h, 0.5 * (y * d211 + d11) / h
    misfit = tau[0] * (a_x - 2.0 * k * b) + 2.0 * tau[2] * (b_x + k * a) + 2.0 * tau[1] * k * b
    return k / h * (turning + lack + misfit)


@kernel
def stress_slope_along(mode, r, angle, k, y):
    """Return the derivative of the unit stress along a curved crack, xx, yy, xy (1/m^1.5)."""
    dxx, dyy, dxy = unit_stress_slope(mode, r, angle)
    if k == 0.0:
        return dxx, dyy, dxy
    sxx, syy, sxy = unit_stress(mode, r, angle)
    h = 1.0 - k * y
    return (dxx - 2.0 * k * sxy) / h, (dyy + 2.0 * k * sxy) / h, (dxy + k * (sxx - syy)) / h
