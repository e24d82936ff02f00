"""What a growing tip meets: the surface of the body, another crack, the end of the grid."""

import numpy as np

from cramp_cli.cracks.extend import end_point, move_end
from cramp_cli.state.failure import NumericalFailure

AHEAD = 0.25  # a crack this near ahead of a tip (cells) is met
OUTSIDE = 1.05  # distance from the nearest particle, in half diagonals of it, beyond which is air
BEYOND = 0.5  # the last piece of a crack that has left the body is at least this long (cells)
RECENT = 3  # pieces behind a tip that it can not run into


def has_left_body(model, state, tip) -> bool:
    """Return whether no particle holds the tip."""
    place = state.paths.origin[tip.points[0]]
    away = np.sum((state.particles.origin - place) ** 2, axis=1)
    nearest = int(np.argmin(away))
    shape = next(b.shape for b in model.blocks if b.lo <= nearest < b.hi)
    reach = OUTSIDE * model.lattice.width * np.hypot(*shape.half)
    _stay_on_grid(model, state, tip)
    return bool(away[nearest] > reach * reach)


def leave_body(model, state, tip, heading, now) -> None:
    """Make the last piece so long that its continuation into free space parts the body.

    An edge is carried on by a multiple of its last piece (crossing.py).
    """
    rest = BEYOND * model.lattice.width - float(state.growth.piece[2 * tip.crack + tip.end])
    if rest > 0.0:
        move_end(state.paths, tip.crack, tip.end, rest * heading, rest * np.array(now))


def _stay_on_grid(model, state, tip) -> None:
    lattice, place = model.lattice, state.paths.point[tip.points[0]]
    low = np.array(lattice.lower) + lattice.width
    high = np.array(lattice.lower) + lattice.width * (np.array(lattice.cells) - 1)
    if np.any(place < low) or np.any(place > high):
        name = model.crack_names[tip.crack]
        x, y = place
        raise NumericalFailure(
            f"step {state.step}, t = {state.time:.6g} s: crack {name} has grown to the border of "
            f"the grid at ({x:.6g}, {y:.6g}) m.\nMake the grid larger: two empty cells around all "
            "bodies at every moment"
        )


def first_met(model, state, tip, heading, now, step) -> tuple[float, bool, str]:
    """Return how far a tip gets in a step (m), whether it meets a crack there, and the event.

    heading, now: unit vectors of the way in the undeformed body and now; step: m
    """
    paths, now = state.paths, np.array(now)
    tip_point = paths.point[end_point(paths, tip.crack, tip.end)]
    reach = step + AHEAD * model.lattice.width
    nearest = np.inf
    for crack in range(paths.crack_count):
        line = paths.point[paths.crack(crack)]
        if crack == tip.crack:
            line = line[: -RECENT - 1] if tip.end else line[RECENT + 1 :]
        if len(line) > 1:
            nearest = min(nearest, _distance_along(tip_point, now, line))
    if nearest > reach:
        return step, False, ""
    return nearest, True, "merge"


def _distance_along(place, way, line) -> float:
    """Return how far along a unit vector a place is from a polyline; inf if it misses it."""
    a, b = line[:-1] - place, line[1:] - place
    side_a, side_b = (way[0] * p[:, 1] - way[1] * p[:, 0] for p in (a, b))
    cut = (side_a > 0.0) != (side_b > 0.0)
    if not cut.any():
        return np.inf
    share = side_a[cut] / (side_a[cut] - side_b[cut])
    along = (a[cut] + share[:, None] * (b[cut] - a[cut])) @ way
    ahead = along[along >= 0.0]
    return float(ahead.min()) if len(ahead) else np.inf
