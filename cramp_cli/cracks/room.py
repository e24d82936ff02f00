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
    found = [(np.inf, ""), *_other_cracks(model, paths, tip, here), *_other_tip(paths, tip, here)]
    found += _own_bends(paths, tip, here, bend)
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


def _other_cracks(model, paths, tip, here):
    for c in range(paths.crack_count):
        if c != tip.crack:
            yield _distance(here, paths.origin[paths.crack(c)]), f"crack {model.crack_names[c]}"


def _own_bends(paths, tip, here, bend):
    """Yield the nearest bend."""
    own = paths.origin[tip.points]
    step = np.diff(own, axis=0)
    turned = np.arctan2(step[:, 1], step[:, 0]) - np.arctan2(step[0, 1], step[0, 0])
    bent = np.flatnonzero(np.abs(np.angle(np.exp(1j * turned))) > bend)
    if len(bent):
        yield float(np.hypot(*(own[bent[0]] - here))), "a bend of the crack"


def _other_tip(paths, tip, here):
    """Yield the tip at the other end."""
    if paths.ends[tip.crack, 1 - tip.end] == TIP:
        yield float(np.hypot(*(paths.origin[tip.points[-1]] - here))), "the other tip"


def _distance(here, line) -> float:
    """Return the distance of a point from a polyline (m)."""
    a, b = line[:-1], line[1:]
    along = np.sum((here - a) * (b - a), axis=1) / np.maximum(np.sum((b - a) ** 2, axis=1), 1e-300)
    foot = a + np.clip(along, 0.0, 1.0)[:, None] * (b - a)
    return float(np.sqrt(np.min(np.sum((foot - here) ** 2, axis=1))))
