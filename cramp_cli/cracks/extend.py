"""A crack gets longer: its end moves, or a new piece begins there.

Between steps, in plain numpy. The end itself is closed: both surfaces lie on it.
"""

import numpy as np

from cramp_cli.cracks.segments import make_segments
from cramp_cli.state.paths import Paths

FIELDS = (
    *("point", "origin", "above", "below", "above_velocity", "below_velocity"),
    *("law", "damage", "spent", "joint"),
)


def end_point(paths: Paths, crack: int, end: int) -> int:
    """Return the number of the first (0) or last (1) point of a crack."""
    return int(paths.start[crack + end]) - end


def add_point(paths: Paths, crack: int, end: int) -> Paths:
    """Return cracks with the end point of one of them doubled: the end and a point behind it."""
    at = end_point(paths, crack, end)
    start = paths.start.copy()
    start[crack + 1 :] += 1
    longer = {
        name: np.insert(getattr(paths, name), at, getattr(paths, name)[at], axis=0)
        for name in FIELDS
    }
    return paths._replace(start=start, **longer)


def insert_point(paths: Paths, crack: int, k: int, share: float) -> Paths:
    """Return cracks with a new point of one of them, at a share of the way from point k to k + 1.

    It has a traction law where the whole piece has.
    """
    start = paths.start.copy()
    start[crack + 1 :] += 1
    more = {}
    for name in FIELDS:
        old = getattr(paths, name)
        between = (1.0 - share) * old[k] + share * old[k + 1]
        if name == "law":
            between = min(old[k], old[k + 1])
        more[name] = np.insert(old, k + 1, -1 if name == "joint" else between, axis=0)
    return paths._replace(start=start, **more)


def move_end(paths: Paths, crack: int, end: int, before, now) -> None:
    """Move the end of a crack: by `before` in the undeformed body, by `now` in that of now (m)."""
    at = end_point(paths, crack, end)
    place = paths.point[at] + now
    paths.origin[at] += before
    for field in (paths.point, paths.above, paths.below):
        field[at] = place


def cover_end(paths: Paths, crack: int, end: int, law: int) -> None:
    """Give the piece that begins at the end of a crack a traction law; -1: that of the end."""
    at = end_point(paths, crack, end)
    behind = at - 1 if end else at + 1
    if law >= 0:
        paths.law[at] = law
        if paths.law[behind] < 0:
            paths.law[behind] = law


def make_room(paths: Paths, segments, node_count: int):
    """Return lists of segments with room for all pieces of the cracks: the old ones if they have.

    What is listed stays listed: samples of this step must not depend on how much room there was.
    """
    wanted = len(paths.point) - paths.crack_count
    if wanted <= len(segments.crack):
        return segments
    larger = make_segments(node_count, 2 * wanted, 2 * len(segments.item))
    for old, new in zip(segments, larger, strict=True):
        new[: len(old)] = old
    return larger
