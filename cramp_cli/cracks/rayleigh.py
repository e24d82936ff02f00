"""Speeds of waves in a plane, and what the speed of a tip does to its energy release rate."""

from math import sqrt

AT_REST = 1e-3  # share of the shear speed below which a tip counts as at rest


def wave_speeds(shear: float, kappa: float, density: float) -> tuple[float, float]:
    """Return dilational and shear wave speed in the plane (m/s).

    shear: shear modulus (Pa); kappa: Kolosov's constant; density: kg/m^3
    """
    slow = sqrt(shear / density)
    return slow * sqrt((kappa + 1.0) / (kappa - 1.0)), slow


def rayleigh_function(v: float, fast: float, slow: float) -> float:
    """Return D(v) = 4 b1 b2 - (1 + b2^2)^2, which vanishes at the Rayleigh speed."""
    b1, b2 = sqrt(1.0 - (v / fast) ** 2), sqrt(1.0 - (v / slow) ** 2)
    return 4.0 * b1 * b2 - (1.0 + b2 * b2) ** 2


def rayleigh_speed(fast: float, slow: float) -> float:
    """Return the Rayleigh wave speed (m/s): no crack that opens runs faster (Freund 1990)."""
    low, high = 0.1 * slow, slow
    for _ in range(100):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if rayleigh_function(middle, fast, slow) > 0.0 else (low, middle)
    return 0.5 * (low + high)


def release_factors(v: float, fast: float, slow: float) -> tuple[float, float]:
    """Return A_I and A_II of a tip at speed v: J = (A_I K_I^2 + A_II K_II^2)/(2 mu).

    Source: Freund (1990), eq. 5.3.10; (kappa + 1)/4 for both at rest.
    """
    if v < AT_REST * slow:
        rest = 0.5 / (1.0 - (slow / fast) ** 2)
        return rest, rest
    b1, b2 = sqrt(1.0 - (v / fast) ** 2), sqrt(1.0 - (v / slow) ** 2)
    over = (1.0 - b2 * b2) / rayleigh_function(v, fast, slow)
    return b1 * over, b2 * over
