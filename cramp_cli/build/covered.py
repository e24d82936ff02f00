"""Where along a crack its traction law acts: on the part that is asked for, inside the solid.

A crack may begin in free space, so as to be sure to cut the surface. There it has no faces: what
acted there would land on the few light nodes beyond the surface, and tear at them.
"""

import numpy as np

CLOSE = 1e-3  # of a piece; nearer to a point of the line no other is put in
SLACK = 1e-6  # of a piece


def crack_line(deck, crack) -> np.ndarray:
    """Return the points of a crack (n, 2), m; there is one wherever its traction law ends."""
    line = crack.path(crack.segment)
    if crack.traction is None:
        return line
    along = distances(line)
    ends = [end for span in covered_spans(deck, crack) for end in span]
    new = [s for s in ends if np.min(np.abs(along - s)) > CLOSE * crack.segment]
    points = [[np.interp(s, along, line[:, d]) for d in range(2)] for s in new]
    order = np.argsort(np.concatenate([along, new]), kind="stable")
    return np.vstack([line, *points])[order]


def distances(line) -> np.ndarray:
    """Return how far along a line (n, 2) its points are (n,), m."""
    return np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])


def covered_spans(deck, crack) -> list[tuple[float, float]]:
    """Return from where to where along a crack (m) its traction law acts."""
    import shapely

    line = crack.path(crack.segment)
    low, high = crack.traction_along or (0.0, np.inf)
    whole, slack = shapely.LineString(line), SLACK * crack.segment
    try:
        inside = whole & shapely.buffer(_solid(deck), slack)
    except shapely.errors.ShapelyError:  # shapes too odd to compute with: nothing is left out
        inside = whole
    spans = []
    for part in shapely.get_parts(inside):
        first, last = (whole.project(shapely.Point(part.coords[n])) for n in (0, -1))
        first, last = max(first, low), min(last, high)
        if last - first > 2.0 * slack:
            spans.append((first, last))
    return spans


def _solid(deck):
    """Return the outline of all that is filled and not rigid."""
    import shapely

    solid = shapely.Polygon()
    for body in deck.bodies:
        outline = body.shape.outline()
        solid = solid - outline if body.hole or body.rigid else solid | outline
    return solid
