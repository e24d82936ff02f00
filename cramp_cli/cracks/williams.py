"""The asymptotic field of a crack tip at rest with unit stress intensity factor (Williams 1957)."""

from math import atan2, cos, pi, sin, sqrt

from cramp_cli.numerics.kernel import kernel


@kernel
def unit_stress(mode, x, y):
    """Return sigma_xx, yy, xy (1/sqrt(m)) at (x, y), crack along negative x; mode 1 or 2."""
    r, half = sqrt(x * x + y * y), 0.5 * atan2(y, x)
    f, c, s = 1.0 / sqrt(2.0 * pi * r), cos(half), sin(half)
    c3, s3 = cos(3.0 * half), sin(3.0 * half)
    if mode == 1:
        return f * c * (1.0 - s * s3), f * c * (1.0 + s * s3), f * c * s * c3
    return -f * s * (2.0 + c * c3), f * s * c * c3, f * c * (1.0 - s * s3)


@kernel
def unit_slope(mode, x, y, shear, kappa):
    """Return du_x/dx and du_y/dx at (x, y) for a unit intensity, 1/(Pa sqrt(m)).

    shear: shear modulus (Pa); kappa: Kolosov's constant
    """
    r, angle = sqrt(x * x + y * y), atan2(y, x)
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
    cos_r, sin_r = x / r, y / r
    return f * (0.5 * cos_r * u - sin_r * du) / r, f * (0.5 * cos_r * v - sin_r * dv) / r


@kernel
def unit_stress_slope(mode, x, y):
    """Return the derivatives along x of `unit_stress` (1/m^1.5).

    By Westergaard's function Z = 1/sqrt(2 pi z): mode I has sigma_xx = Re Z - y Im Z', sigma_yy =
    Re Z + y Im Z', sigma_xy = -y Re Z'; mode II 2 Im Z + y Re Z', -y Re Z', Re Z - y Im Z'.
    """
    z = complex(x, y)
    once = -0.5 / (sqrt(2.0 * pi) * z**1.5)
    twice = -1.5 * once / z
    if mode == 1:
        bent = y * twice.imag
        return once.real - bent, once.real + bent, -y * twice.real
    return 2.0 * once.imag + y * twice.real, -y * twice.real, once.real - y * twice.imag
