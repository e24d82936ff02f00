"""Crack opening displacement near a tip, and K_I, K_II from J and the opening (the paper's way)."""

from math import sqrt

import numpy as np

NEAR, FAR = 0.9, 5.1  # distances from a tip between which the opening tells the mode (cells)
SEEN = 0.5  # share of the sliding of faces beside their line that points of the crack see


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


def opening_behind(paths, tip, frame, width) -> tuple[float, float]:
    """Return the weighed opening and sliding behind a tip, whose ratio is that of K_I and K_II (m).

    Means over the points from NEAR to FAR cells behind the tip, at most half the crack, each over
    the root of its distance; the nearest points do not count, they hold what the grid makes of the
    tip. The faces of the solid lie midway between its particles, at a height of -frame.line over
    the line of the crack. There, as the faces are free (du_x/dy = -du_y/dx), the solid slides by

        (height) d(opening)/dr = (height) (opening)/(2 r)

    without any K_II, of which SEEN comes to the points: velocities between nodes are straight.
    The opening near the tip alone where there are no such points.
    """
    points = tip.points
    away = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(paths.origin[points], axis=0).T))])
    chosen = (away > NEAR * width) & (away < min(FAR * width, 0.5 * away[-1]))
    if not chosen.any():
        return open_and_slide(opening_near_tip(paths, tip.crack, tip.end), frame.now)
    gap, r = (2 * tip.end - 1) * (paths.above - paths.below)[points][chosen], away[chosen]
    (ex, ey), c, s = frame.now, np.cos(frame.bend * r), -np.sin(frame.bend * r)
    ahead = np.stack([c * ex - s * ey, s * ex + c * ey], axis=1)
    opened = gap[:, 1] * ahead[:, 0] - gap[:, 0] * ahead[:, 1]
    slid = np.sum(gap * ahead, axis=1) - SEEN * frame.line * opened / (2.0 * r)
    weight = 1.0 / np.sqrt(r) / len(r)
    return float(weight @ opened), float(weight @ slid)


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
