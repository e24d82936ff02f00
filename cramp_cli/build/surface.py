"""A smooth surface for rigid bodies, whose particles may lie anywhere: nothing strains them.

Particles at the centres of parts of cells leave steps of half a cell along inclined and curved
outlines. Those of a rigid body next to its outline are moved along its normal until the circle
inscribed in them touches it, so contact sees the outline itself.
"""

import numpy as np

PASSES = 2  # at a corner the second one keeps the distance from the other side


def settled(points, outline, half: float) -> np.ndarray:
    """Return the particles (n, 2) of a body (m), those near the outline at `half` from it (m)."""
    import shapely

    points = points.copy()
    for number in range(PASSES):
        lines = shapely.shortest_line(outline.boundary, shapely.points(points))
        feet = shapely.get_coordinates(lines).reshape(-1, 2, 2)[:, 0]
        away = np.hypot(*(points - feet).T)
        near = (away > 0.0) & (away < (2.0 if number == 0 else 1.0) * half)
        inwards = (points[near] - feet[near]) / away[near, None]
        points[near] = feet[near] + half * inwards
    return points
