"""The surface of an elastic body, which its particles know, and how far it is from a rigid one.

Particles at the centres of parts of cells leave steps of half a cell along inclined and curved
outlines, and the lowest particle that a node sees lies up to a cell beside it. So each particle
next to the outline of its body keeps the point of the outline next to it, and moves it along with
its deformation. The separation at a node is that of these points from the outline of the rigid
body, led along the surface to the place where it is least: zero where geometry says zero. There
both surfaces have one normal, and what a roller pushes between two nodes it shares between them.
"""

from math import inf, sqrt
from typing import NamedTuple

import numpy as np

from cramp_cli.contact.clouds import particle_of
from cramp_cli.contact.outline import nearest_beside, normal_on, point_on
from cramp_cli.numerics.kernel import kernel

FACING = 0.5  # cosine of the angle between the normals of both surfaces; less is another side
LEAST = 1e-3  # weight of a point of the surface a cell beside a node; 1 beside it
FLAT = 0.01  # curvature per cell that counts as none: such faces touch at their nodes
# Slope, curvature per cell and angle to the grid below which faces are even. There the first point
# touches for all around: node by node a block that slides hops, and friction lacks 0.6 % of mu.
# Across the grid the points are of particles at unequal depth, and the worst would decide.
EVEN = 1e-3
DEEP = 0.75  # cells below the surface; deeper nodes do not touch: those nearer to it do


class Surface(NamedTuple):
    """The point of its body's outline next to each particle at the start, by its number."""

    foot: np.ndarray  # (n, 2) from the particle to that point (m)
    normal: np.ndarray  # (n, 2) out of the body there; zero for particles within it


@kernel
def surface_point(particles, surface, p):
    """Return where the surface next to particle p is now (m), and its unit normal or (0, 0)."""
    number = particles.id[p]
    Nx, Ny = surface.normal[number, 0], surface.normal[number, 1]
    F, rx, ry = particles.F, surface.foot[number, 0], surface.foot[number, 1]
    x = particles.position[p, 0] + F[p, 0] * rx + F[p, 1] * ry
    y = particles.position[p, 1] + F[p, 2] * rx + F[p, 3] * ry
    nx, ny = F[p, 3] * Nx - F[p, 2] * Ny, F[p, 0] * Ny - F[p, 1] * Nx  # along F^-T N
    size = sqrt(nx * nx + ny * ny)
    return (x, y, nx / size, ny / size) if size > 0.0 else (x, y, 0.0, 0.0)


@kernel
def above_outline(outlines, s, x, y):
    """Return how far a place is from the outline about piece s (m), negative inside, and normal."""
    s, t = nearest_beside(outlines, s, x, y)
    fx, fy = point_on(outlines, s, t)
    nx, ny = normal_on(outlines, s, t)
    size = sqrt((x - fx) ** 2 + (y - fy) ** 2)
    return (size if (x - fx) * nx + (y - fy) * ny >= 0.0 else -size), nx, ny


@kernel
def outline_gap(clouds, stencil, particles, surface, row, place, mirrored, n, s, outlines, way):
    """Return how far the surface of a row is from the outline of a rigid body beside a node (m).

    place: of the node (m) and width of a cell (m); mirrored: whether it lies on a symmetry plane
    that cuts the surface; n: unit normal towards the rigid body; s: the piece of its outline next
    to the node; way: which it has gone (m).
    returns: the gap at the node; where along the surface it is least, within half a cell (m); that
    gap; by how much the normal turns until there. Infinite where no surface faces the rigid body

    Along the surface the gap has the slope g' = a + b t, told by both normals, so the gap at the
    node is the average of g - a t - b t^2/2. It is least where g' = 0.
    """
    x0, y0, width = place
    sums, gaps, depths = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0), 0.0, 0.0
    lowest = inf
    entry = clouds.head[row]
    while entry >= 0:
        x, y, mx, my = surface_point(particles, surface, particle_of(stencil, entry))
        facing = mx * n[0] + my * n[1]
        if facing > FACING:
            t = (y - y0) * n[0] - (x - x0) * n[1]
            w = max(1.0 - abs(t) / width, LEAST)
            g, ax, ay = above_outline(outlines, s, x - way[0], y - way[1])
            slope, turn = (ay * mx - ax * my) / facing, ax * n[1] - ay * n[0]
            sums = added(sums, w, t, slope, turn)
            gaps, lowest = gaps + w * g, min(lowest, g)
            depths += w * ((x - x0) * n[0] + (y - y0) * n[1])
        entry = clouds.link[entry]
    if sums[0] == 0.0:
        return inf, 0.0, inf, 0.0
    if depths > DEEP * width * sums[0]:
        return width, 0.0, width, 0.0
    if mirrored:  # the image has the opposite ways, slopes and turns
        sums = (sums[0], 0.0, sums[2], 0.0, sums[4], 0.0, sums[6])
    a, b, turning = lines_through(sums, width)
    if abs(n[0] * n[1]) < EVEN and abs(a) < EVEN and abs(b) * width < EVEN:
        return lowest, 0.0, lowest, 0.0
    gap = (gaps - a * sums[1] - 0.5 * b * sums[2]) / sums[0]
    least = -a / b if b * width > FLAT else 0.0
    least = min(max(least, -0.5 * width), 0.5 * width)
    return gap, least, gap + (a + 0.5 * b * least) * least, turning * least


@kernel
def added(sums, w, t, slope, turn):
    """Return the sums of w, w t, w t^2, w g', w t g', w r, w t r with those of one point."""
    s, st, stt, sa, sta, sr, str_ = sums
    wt = w * t
    return (
        s + w,
        st + wt,
        stt + wt * t,
        sa + w * slope,
        sta + wt * slope,
        sr + w * turn,
        str_ + wt * turn,
    )


@kernel
def lines_through(sums, width):
    """Return a, b of the line a + b t through the slopes, and the b of that through the turns."""
    s, st, stt, sa, sta, sr, str_ = sums
    det = s * stt - st * st
    if det < (LEAST * s * width) ** 2:  # all of them in one place
        return sa / s, 0.0, 0.0
    b = (s * sta - st * sa) / det
    return (sa - b * st) / s, b, (s * str_ - st * sr) / det
