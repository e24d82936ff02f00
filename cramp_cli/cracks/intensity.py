"""Crack opening displacement near a tip, and K_I, K_II from J and the opening (the paper's way)."""

from math import sqrt

import numpy as np


def opening_near_tip(paths, crack: int, end: int) -> np.ndarray:
    """Return the opening about two crack particles behind the tip, above minus below (m).

    "Above" refers to the direction of growth, so at the start of a crack the sides change places.
    A B-spline over three particles; the first gap alone on cracks of less than four.

    end: 0 for the first point of the crack, 1 for the last
    """
    points = paths.crack(crack)
    gap = paths.above[points] - paths.below[points]
    gap = gap[::-1] if end == 1 else -gap
    return gap[1] if len(gap) < 4 else (gap[1] + 4.0 * gap[2] + gap[3]) / 6.0


def open_and_slide(opening, direction) -> tuple[float, float]:
    """Return the opening normal to the crack and along it (m); direction: unit vector of growth."""
    (gx, gy), (ex, ey) = opening, direction
    return float(-gx * ey + gy * ex), float(gx * ex + gy * ey)


def K_from_J(J, normal, slide, shear, kappa) -> tuple[float, float]:
    """Return K_I and K_II (Pa sqrt(m)) of the given J, in the ratio of the opening.

    Source: Guo and Nairn (2004); a tip at rest.
    """
    square = normal * normal + slide * slide
    if not J > 0.0 or square == 0.0:
        return 0.0, 0.0
    per_opening = sqrt(8.0 * shear * J / ((kappa + 1.0) * square))
    return normal * per_opening, slide * per_opening
