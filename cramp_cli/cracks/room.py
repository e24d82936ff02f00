"""How far the domain of a tip may reach before it meets what spoils its integrals."""

from typing import NamedTuple

import numpy as np

from cramp_cli.state.particles import is_deleted
from cramp_cli.state.paths import TIP


class Obstacle(NamedTuple):
    """Places that no domain may hold: loads, held boundaries, symmetry planes."""

    places: np.ndarray  # (n, 2) in the undeformed body (m)
    what: str
    crack: int = -1  # the crack for which it is none: the one that lies on this symmetry plane


def find_room(model, paths, tip, here, bend) -> tuple[float, str]:
    """Return the distance (m) from a tip to what is nearest and spoils its domain, and what it is.

    here: the tip in the undeformed body (m); bend: turn (rad) of the crack itself that does
    """
    here = np.array(here)
    points, own = through_joints(paths, tip)
    found = [(np.inf, ""), *_other_cracks(model, paths, own, here)]
    found += [*_other_tip(paths, points, own[-1], here), *_own_bends(paths, points, here, bend)]
    for places, what, crack in model.fracture.obstacles:
        if len(places) and crack != tip.crack:
            found.append((float(np.sqrt(np.min(np.sum((places - here) ** 2, axis=1)))), what))
    return min(found)


def nearest_body(model, state, tip) -> tuple[float, str]:
    """Return the distance (m) from a tip to the nearest particle of a body that may touch its own.

    What another body does to the surface is a load within the domain, however little of the domain
    is empty. Taken in the bodies of now: where they were at the start tells nothing of contact.
    """
    if model.between_bodies is None:
        return np.inf, ""
    particles, here = state.particles, state.paths.point[tip.points[0]]
    other = model.groups.of_body[particles.body] != model.groups.of_crack[tip.crack]
    other &= ~is_deleted(particles)
    away = np.sum((particles.position[other] - here) ** 2, axis=1)
    return float(np.sqrt(away.min(initial=np.inf))), "another body"


def through_joints(paths, tip) -> tuple[np.ndarray, list[int]]:
    """Return the points of a crack from a tip on, through all cracks that meet end to end.

    returns: numbers of points, and the cracks in this order
    """
    points, cracks = tip.points, [tip.crack]
    while paths.joint[points[-1]] >= 0:
        arms = np.flatnonzero(paths.joint == paths.joint[points[-1]])
        if len(arms) != 2:
            break
        following = int(arms.sum() - points[-1])
        c = int(np.searchsorted(paths.start, following, side="right")) - 1
        more = np.arange(paths.start[c], paths.start[c + 1])
        if c in cracks or following not in (more[0], more[-1]):
            break
        more = more if following == more[0] else more[::-1]
        points, cracks = np.concatenate([points, more[1:]]), [*cracks, c]
    return points, cracks


def _other_cracks(model, paths, own, here):
    for c in range(paths.crack_count):
        if c not in own:
            yield _distance(here, paths.origin[paths.crack(c)]), f"crack {model.crack_names[c]}"


def _own_bends(paths, points, here, bend):
    """Yield the nearest bend."""
    own = paths.origin[points]
    step = np.diff(own, axis=0)
    turned = np.arctan2(step[:, 1], step[:, 0]) - np.arctan2(step[0, 1], step[0, 0])
    bent = np.flatnonzero(np.abs(np.angle(np.exp(1j * turned))) > bend)
    if len(bent):
        yield float(np.hypot(*(own[bent[0]] - here))), "a bend of the crack"


def _other_tip(paths, points, last, here):
    """Yield the tip at the other end; last: the crack that ends there."""
    end = int(points[-1] == paths.start[last + 1] - 1)
    if paths.ends[last, end] == TIP:
        yield float(np.hypot(*(paths.origin[points[-1]] - here))), "the other tip"


def _distance(here, line) -> float:
    """Return the distance of a point from a polyline (m)."""
    a, b = line[:-1], line[1:]
    along = np.sum((here - a) * (b - a), axis=1) / np.maximum(np.sum((b - a) ** 2, axis=1), 1e-300)
    foot = a + np.clip(along, 0.0, 1.0)[:, None] * (b - a)
    return float(np.sqrt(np.min(np.sum((foot - here) ** 2, axis=1))))
