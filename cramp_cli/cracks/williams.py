"""The asymptotic field of a crack tip at rest with unit stress intensity factor (Williams 1957).

Places are r and the angle from the line ahead of the tip. Angles beyond pi or below -pi carry the
field of a face on, past the line of the crack: what belongs to a face need not lie on its side.
"""

from math import cos, pi, sin, sqrt

from cramp_cli.numerics.kernel import kernel


@kernel
def unit_stress(mode, r, angle):
    """Return sigma_xx, yy, xy (1/sqrt(m)), crack along negative x; mode 1 or 2."""
    half = 0.5 * angle
    f, c, s = 1.0 / sqrt(2.0 * pi * r), cos(half), sin(half)
    c3, s3 = cos(3.0 * half), sin(3.0 * half)
    if mode == 1:
        return f * c * (1.0 - s * s3), f * c * (1.0 + s * s3), f * c * s * c3
    return -f * s * (2.0 + c * c3), f * s * c * c3, f * c * (1.0 - s * s3)


@kernel
def unit_slope(mode, r, angle, shear, kappa):
    """Return du_x/dx and du_y/dx for a unit intensity, 1/(Pa sqrt(m)).

    shear: shear modulus (Pa); kappa: Kolosov's constant
    """
    c, s = cos(0.5 * angle), sin(0.5 * angle)
    f = sqrt(r / (2.0 * pi)) / (2.0 * shear)
    if mode == 1:
        u, v = c * (kappa - 1.0 + 2.0 * s * s), s * (kappa + 1.0 - 2.0 * c * c)
        du = -0.5 * s * (kappa - 1.0 + 2.0 * s * s) + 2.0 * s * c * c
        dv = 0.5 * c * (kappa + 1.0 - 2.0 * c * c) + 2.0 * s * s * c
    else:
        u, v = s * (kappa + 1.0 + 2.0 * c * c), -c * (kappa - 1.0 - 2.0 * s * s)
        du = 0.5 * c * (kappa + 1.0 + 2.0 * c * c) - 2.0 * s * s * c
        dv = 0.5 * s * (kappa - 1.0 - 2.0 * s * s) + 2.0 * s * c * c
    cos_r, sin_r = cos(angle), sin(angle)
    return f * (0.5 * cos_r * u - sin_r * du) / r, f * (0.5 * cos_r * v - sin_r * dv) / r


@kernel
def unit_displacement(mode, r, angle, shear, kappa):
    """Return u_x and u_y for a unit intensity, sqrt(m)/Pa: none at the tip.

    Kolosov: 2 mu (u + iv) = kappa phi - z conj(phi') - conj(psi) with phi = 2 a sqrt(z) and psi =
    (2 conj(a) - a) sqrt(z); a = 1/(2 sqrt(2 pi)) in mode I, -i times that in mode II.
    """
    f, half = sqrt(r / (2.0 * pi)) / (4.0 * shear), 0.5 * angle
    c, s, c3, s3 = cos(half), sin(half), cos(3.0 * half), sin(3.0 * half)
    if mode == 1:
        return f * ((2.0 * kappa - 1.0) * c - c3), f * ((2.0 * kappa + 1.0) * s - s3)
    return f * ((2.0 * kappa + 3.0) * s + s3), f * ((3.0 - 2.0 * kappa) * c - c3)


@kernel
def unit_slope_across(mode, r, angle, shear, kappa):
    """Return du_x/dy and du_y/dy for a unit intensity, 1/(Pa sqrt(m))."""
    f, half = 1.0 / (sqrt(2.0 * pi * r) * 4.0 * shear), 0.5 * angle
    c, s, c5, s5 = cos(half), sin(half), cos(5.0 * half), sin(5.0 * half)
    if mode == 1:
        return f * ((kappa + 0.5) * s + 0.5 * s5), f * ((kappa - 0.5) * c - 0.5 * c5)
    return f * ((kappa + 2.5) * c + 0.5 * c5), f * ((2.5 - kappa) * s + 0.5 * s5)


@kernel
def unit_slope_change(mode, r, angle, shear, kappa):
    """Return the second derivatives of u_x and u_y along x for a unit intensity, 1/(Pa m^1.5)."""
    f, half = 1.0 / (sqrt(2.0 * pi * r) * r * 4.0 * shear), 0.5 * angle
    c3, s3, c7, s7 = cos(3.0 * half), sin(3.0 * half), cos(7.0 * half), sin(7.0 * half)
    k = 0.5 * kappa
    if mode == 1:
        return f * ((1.25 - k) * c3 - 0.75 * c7), f * ((1.25 + k) * s3 - 0.75 * s7)
    return f * ((k - 0.25) * s3 + 0.75 * s7), f * ((k + 0.25) * c3 - 0.75 * c7)


@kernel
def unit_stress_slope(mode, r, angle):
    """Return the derivatives along x of `unit_stress` (1/m^1.5).

    By Westergaard's function Z = 1/sqrt(2 pi z): mode I has sigma_xx = Re Z - y Im Z', sigma_yy =
    Re Z + y Im Z', sigma_xy = -y Re Z'; mode II 2 Im Z + y Re Z', -y Re Z', Re Z - y Im Z'.
    """
    y, once = r * sin(angle), -0.5 / (sqrt(2.0 * pi) * r**1.5)
    twice = -1.5 * once / r
    once_re, once_im = once * cos(1.5 * angle), -once * sin(1.5 * angle)
    twice_re, twice_im = twice * cos(2.5 * angle), -twice * sin(2.5 * angle)
    bent = y * twice_im
    if mode == 1:
        return once_re - bent, once_re + bent, -y * twice_re
    return 2.0 * once_im + y * twice_re, -y * twice_re, once_re - bent
