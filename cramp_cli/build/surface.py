"""A smooth surface for bodies that touch, whatever steps their particles leave.

Particles at the centres of parts of cells leave steps of half a cell along inclined and curved
outlines. Those of a rigid body may lie anywhere, for nothing strains them: next to its outline
they are moved along its normal until the circle inscribed in them touches it. Those of an elastic
body stay, and keep the point of its outline next to them.
"""

import numpy as np

from cramp_cli.deck.regions import Regions

SAME = 1e-6  # cells; corners of outlines nearer than this to a line or to each other are one
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


def outline_of(deck, number, width):
    """Return the outline of rigid body `number` without what later bodies and holes cover.

    Rigid bodies that touch it and move like it are one wall with it: at their seam there is no
    surface. Nor is there one where a symmetry plane cuts it: there it goes on as its image.
    width: of a cell (m)
    """
    from shapely import get_parts, union_all

    own = Regions(deck.bodies).left(number)
    alike = [n for n, one in enumerate(deck.bodies) if one.rigid == deck.bodies[number].rigid]
    wall = _joined(deck, [number, *(n for n in alike if n != number)], width)
    mine = [part for part in get_parts(wall) if part.distance(own) == 0.0]
    return with_images(union_all(mine), deck, SAME * width).simplify(SAME * width)


def outline_of_all(deck, numbers, width):
    """Return the outline of bodies of one solid and of their images; width: of a cell (m)."""
    solid = [n for n in numbers if not deck.bodies[n].hole]
    return with_images(_joined(deck, solid, width), deck, SAME * width).simplify(SAME * width)


def _joined(deck, numbers, width):
    """Return bodies as one region, without what later ones cover; width: of a cell (m)."""
    from shapely import snap, union_all

    regions = Regions(deck.bodies)
    own, *others = (regions.left(n) for n in numbers)
    return union_all([own, *(snap(one, own, SAME * width) for one in others)])


def surface_beside(points, outline, reach: float):
    """Return the way from each point to the outline next to it (n, 2), m, and the normal there.

    points: (n, 2) m; reach: how far it may be (m). Both are zero for points farther away
    """
    from shapely import STRtree, linestrings
    from shapely import points as spots

    rings = rings_of(outline)
    ends = np.concatenate([np.stack([ring[:-1], ring[1:]], axis=1) for ring in rings])
    point, piece = STRtree(linestrings(ends)).query_nearest(
        spots(points), max_distance=reach, all_matches=False
    )
    start, edge = ends[piece, 0], ends[piece, 1] - ends[piece, 0]
    share = ((points[point] - start) * edge).sum(axis=1) / (edge * edge).sum(axis=1)
    way, normal = np.zeros((2, *points.shape))
    way[point] = start + np.clip(share, 0.0, 1.0)[:, None] * edge - points[point]
    normal[point] = np.stack([edge[:, 1], -edge[:, 0]], axis=1) / np.hypot(*edge.T)[:, None]
    return way, normal


def rings_of(region) -> list:
    """Return the closed lines around a region with the region at their left, (k + 1, 2) each (m).

    Lines and points that are left where shapes only touch have no area and no ring.
    """
    from shapely import get_coordinates, get_parts
    from shapely.geometry.polygon import orient

    parts = (orient(part) for part in get_parts(region) if part.area > 0.0)
    return [get_coordinates(ring) for part in parts for ring in (part.exterior, *part.interiors)]


def with_images(outline, deck, near):
    """Return an outline joined with its images behind symmetry planes and the axis of rings.

    near: length below which two corners are one (m)
    """
    from shapely import snap
    from shapely.affinity import scale

    planes = [b.where.planes[0] for b in deck.boundary if b.symmetry]
    if deck.analysis == "axisymmetric":
        planes.append((0, 0.0))
    for axis, at in planes:
        factors, origin = [1.0, 1.0], [0.0, 0.0]
        factors[axis], origin[axis] = -1.0, at
        image = scale(outline, *factors, origin=tuple(origin))
        outline = outline | snap(image, outline, near)
    return outline
