"""Faces of a crack that lie in each other: K and J of such a crack are those of no crack.

Where faces ignore each other a pressure drives them into one another; J is positive there, whatever
its sense. With contact they touch within what the discrete body knows of its faces, stairs of
particles: up to half of the strain times a cell (measured at 45 degrees, ten cells, 0.45).
"""

from math import pi, sqrt

import numpy as np

from cramp_cli.cracks.contact import IGNORE
from cramp_cli.cracks.doubts import noise_around, stiffness_at
from cramp_cli.cracks.view import side_normal

BESIDE = (1.0, 5.0)  # cells behind a tip between which its faces are looked at
TOUCHING = 2.0  # times what is noise in the opening: faces that touch lie less in each other
AT, NEAR, AWAY = "at the tip", "near the tip", "away from the tip"
ONE_MODE = 0.05  # K_I as a share of K_II below which its sign is none


def overlapping(model, paths, tip, site, row) -> list[str]:
    """Return a word on the faces of a crack that overlap; row: of cracks.csv."""
    where = overlap(model, paths, tip, site, row["K_I"], row["K_II"])
    return [f"doubtful: the faces overlap {where}"] if where else []


def overlap(model, paths, tip, site, K_I: float, K_II: float) -> str:
    """Return where the faces of the crack of a tip overlap, nothing if they do not.

    K_I, K_II: as they were found (Pa sqrt(m))
    """
    ignores = model.contact.kind[tip.crack] == IGNORE
    noise, stiffness = noise_around(model, site), stiffness_at(site)
    if ignores and max(ONE_MODE * abs(K_II), sqrt(noise * stiffness)) < -K_I:
        return AT
    if site.half or paths.fixed[tip.crack]:  # their surfaces do not tell an opening
        return ""
    opening, behind = _openings(paths, tip, model.lattice.width)
    least = -TOUCHING * opening_of(noise, stiffness, model.lattice.width)
    near = (behind >= BESIDE[0]) & (behind <= BESIDE[1])
    if np.any(opening[near] < least):
        return NEAR
    return AWAY if ignores and np.any(opening[behind > BESIDE[1]] < least) else ""


def is_shut(model, paths, tip, site, load) -> bool:
    """Return whether the faces lie in each other where they would part next; load: of criteria."""
    return overlap(model, paths, tip, site, load.K_I, load.K_II) in (AT, NEAR)


def opening_of(J: float, stiffness: float, width: float) -> float:
    """Return by how much faces part a cell behind a tip of mode I with this J (m)."""
    return 8.0 * sqrt(J / stiffness * width / (2.0 * pi))


def _openings(paths, tip, width):
    """Return the openings of the points of a crack (m), from the tip on, and how far they are.

    The second is in cells.
    """
    points, line = tip.points, paths.origin[tip.points]
    first, last = points.min(), points.max()
    gap = paths.above[points] - paths.below[points]
    normal = np.array([side_normal(paths.point, k, first, last) for k in points])
    behind = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
    return np.sum(gap * normal, axis=1), behind / width
