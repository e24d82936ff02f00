"""Stress intensity at the end of a short kink, from that of the crack it left.

k_I = F11 K_I + F12 K_II and k_II = F21 K_I + F22 K_II for a straight kink of vanishing length at an
angle phi (Amestoy and Leblond 1992, series in m = phi/pi, good to 80 degrees).
"""

from math import pi

import numpy as np
from numpy.polynomial import Polynomial

LARGEST = 1.45  # rad; the series end there
SAMPLES = 233

F11 = Polynomial(
    [
        1.0,
        0.0,
        -3.0 * pi**2 / 8.0,
        0.0,
        pi**2 - 5.0 * pi**4 / 128.0,
        0.0,
        pi**2 / 9.0 - 11.0 * pi**4 / 72.0 + 119.0 * pi**6 / 15360.0,
        0.0,
        5.07790,
        0.0,
        -2.88312,
        0.0,
        -0.0925,
        0.0,
        2.996,
        0.0,
        -4.059,
        0.0,
        1.63,
        0.0,
        4.1,
    ]
)
F12 = Polynomial(
    [
        0.0,
        -3.0 * pi / 2.0,
        0.0,
        10.0 * pi / 3.0 + pi**3 / 16.0,
        0.0,
        -2.0 * pi - 133.0 * pi**3 / 180.0 + 59.0 * pi**5 / 1280.0,
        0.0,
        12.313906,
        0.0,
        -7.32433,
        0.0,
        1.5793,
        0.0,
        4.0216,
        0.0,
        -6.915,
        0.0,
        4.21,
        0.0,
        4.56,
    ]
)
F21 = Polynomial(
    [
        0.0,
        pi / 2.0,
        0.0,
        -4.0 * pi / 3.0 - pi**3 / 48.0,
        0.0,
        -2.0 * pi / 3.0 + 13.0 * pi**3 / 30.0 - 59.0 * pi**5 / 3840.0,
        0.0,
        -6.176023,
        0.0,
        4.44112,
        0.0,
        -1.5340,
        0.0,
        -2.0700,
        0.0,
        4.684,
        0.0,
        -3.95,
        0.0,
        -1.32,
    ]
)
F22 = Polynomial(
    [
        1.0,
        0.0,
        -4.0 - 3.0 * pi**2 / 8.0,
        0.0,
        8.0 / 3.0 + 29.0 * pi**2 / 18.0 - 5.0 * pi**4 / 128.0,
        0.0,
        -32.0 / 15.0 - 4.0 * pi**2 / 9.0 - 1159.0 * pi**4 / 7200.0 + 119.0 * pi**6 / 15360.0,
        0.0,
        10.58254,
        0.0,
        -4.78511,
        0.0,
        -1.8804,
        0.0,
        7.280,
        0.0,
        -7.591,
        0.0,
        0.25,
        0.0,
        12.5,
    ]
)


def kinked(K_I, K_II, phi):
    """Return k_I, k_II (Pa sqrt(m)) at the end of a short kink.

    K_I, K_II: of the crack it left (Pa sqrt(m)); phi: angle of the kink, left positive (rad)
    """
    m = phi / pi
    return F11(m) * K_I + F12(m) * K_II, F21(m) * K_I + F22(m) * K_II


def steepest_release(K_I: float, K_II: float) -> float:
    """Return the angle (rad) at which a short kink would release most energy while it is open.

    The largest k_I^2 + k_II^2 with k_I > 0; 0 if no kink is open.
    """
    if K_II == 0.0:
        return 0.0
    k_I, k_II = F11 * K_I + F12 * K_II, F21 * K_I + F22 * K_II
    release = k_I * k_I + k_II * k_II
    m = np.linspace(-LARGEST, LARGEST, SAMPLES) / pi
    values = np.where(k_I(m) > 0.0, release(m), 0.0)
    best = int(np.argmax(values))
    if values[best] == 0.0 or best in (0, SAMPLES - 1):
        return float(pi * m[best]) if values[best] else 0.0
    return pi * _root(release.deriv(), m[best - 1], m[best + 1])


def _root(slope, low, high):
    """Return where a slope falls through zero between `low` and `high`, to round-off."""
    for _ in range(100):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if slope(middle) > 0.0 else (low, middle)
    return float(0.5 * (low + high))
