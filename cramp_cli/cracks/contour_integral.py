"""J on a rectangle of grid lines around a tip, as in the paper (Guo and Nairn 2004; Nairn 2003).

Nodal averages per velocity field, trapezoid rule along the contour, both sides of the crack where
it crosses, kinetic energy in the line term and, with two terms, the area integral of the inertia.
"""

from math import hypot
from typing import NamedTuple

import numpy as np

from cramp_cli.cracks.contour_sums import Box, area_term, sum_fields
from cramp_cli.cracks.crossing import crosses
from cramp_cli.cracks.rows import crossed_row
from cramp_cli.cracks.segments import ON_CRACK
from cramp_cli.materials.law import same_law
from cramp_cli.state.bands import band_axis, runs_between

SEEN = 3  # rows of cells within which a particle may see a node
NEARLY = 1e-5  # cells by which boxes are widened before it is asked whether lines cross
FULL = 0.75  # a contour node that sees less of a full cell lies at or beyond the edge of the body


class Contour(NamedTuple):
    """Jx, Jy (J/m^2) and why they can not be trusted, or an empty text."""

    Jx: float
    Jy: float
    trouble: str


def integrate_contour(model, state, scratch, crack, tip, block, gravity) -> Contour:
    """Return J along x and y on a rectangle around the node nearest to `tip`.

    With one term it is the line integral alone, with two the area integral of the inertia as well.

    tip: position (m); block: particles of the material at the tip; gravity: m/s^2
    """
    lattice, cells, terms = model.lattice, model.fracture.cells, model.fracture.terms
    centre = [round((x - low) / lattice.width) for x, low in zip(tip, lattice.lower, strict=True)]
    box = Box(centre[0] - cells, centre[1] - cells, 2 * cells + 1, 2 * cells + 1)
    if min(box.i, box.j) < 0 or any(
        c + cells > n for c, n in zip(centre, lattice.cells, strict=True)
    ):
        return Contour(np.nan, np.nan, "the contour does not fit in the grid")
    walk = _Walk(model, state, scratch, crack, box)
    Jx, Jy = walk.line_integral()
    lower = np.array(lattice.lower) + lattice.width * np.array([box.i, box.j])
    upper = lower + 2 * cells * lattice.width
    if _holds_others(model, state.particles, block.law, lower, upper):
        return Contour(np.nan, np.nan, "another material lies within the contour")
    if terms == 2:
        Ax, Ay, inside = (
            sum(s)
            for s in zip(
                *(
                    area_term(state.particles, gravity, lower, upper, b.lo, b.hi)
                    for b in model.blocks
                ),
                strict=True,
            )
        )
        if inside > 0.0:
            scale = (2 * cells * lattice.width) ** 2 / inside
            Jx, Jy = Jx + scale * Ax, Jy + scale * Ay
    return Contour(Jx, Jy, walk.trouble())


def _holds_others(model, particles, law, lower, upper) -> bool:
    """Return whether particles of another law lie in a rectangle or a cell beside it."""
    width = model.lattice.width
    others = [b for b in model.blocks if not same_law(b.law, law)]
    places = (particles.position[b.lo : b.hi] for b in others)
    return any(np.all((x > lower - width) & (x < upper + width), axis=1).any() for x in places)


class _Walk:
    """One way round a contour."""

    def __init__(self, model, state, scratch, crack, box):
        self.model, self.scratch, self.crack, self.box = model, scratch, crack, box
        self.nodes = len(scratch.rows.first)
        sums = np.zeros((box.wide * box.high + int(scratch.rows.count[0]), 11))
        across = band_axis(model.lattice.cells)
        low, count = ((box.i, box.wide), (box.j, box.high))[across]
        runs = runs_between(state.bands, low - SEEN, low + count + SEEN)
        place = (model.strides, box, self.nodes)
        for b, (lo, hi) in zip(model.blocks, runs, strict=True):
            sum_fields(sums, state.particles, scratch.stencil, b.shape, *place, lo, hi)
        self.cell = model.lattice.width**2 * model.geometry.thickness
        self.volume, self.sums = sums[:, 10], sums[:, :10]
        self.segments = self._segments_on_way()
        self.crossings = 0
        self.other_cracks = 0
        self.other_bodies = 0
        self.empty = 0

    def _segments_on_way(self):
        """Return the segments that may meet the contour: number, lower and upper corner."""
        box, lattice, used = self.box, self.model.lattice, int(self.scratch.segments.used[0])
        ends = self.scratch.segments.real[:used].reshape(used, 2, 2)
        low, high = ends.min(axis=1), ends.max(axis=1)
        corner = np.array([[box.i, box.j], [box.i + box.wide - 1, box.j + box.high - 1]])
        lower, upper = lattice.lower + lattice.width * corner
        hair = NEARLY * lattice.width
        outside = ((high < lower - hair) | (low > upper + hair)).any(axis=1)
        within = ((low > lower + hair) & (high < upper - hair)).all(axis=1)
        on_way = np.flatnonzero(~outside & ~within)
        return [(int(s), low[s].tolist(), high[s].tolist()) for s in on_way]

    def line_integral(self):
        """Return the line integrals of q_x and q_y, counter-clockwise."""
        corners = self._corners()
        here = [(at, self._own(at)) for at in corners]
        Jx, Jy = 0.0, 0.0
        for one, next_one in zip(here, here[1:] + here[:1], strict=True):
            qx, qy = self._edge(*one, *next_one)
            Jx, Jy = Jx + qx, Jy + qy
        return Jx, Jy

    def trouble(self) -> str:
        """Return why the integral can not be trusted, or an empty text."""
        if self.crossings == 0:
            return "the crack does not cross its contour"
        if self.crossings > 1:
            return "the crack crosses its contour more than once"
        if self.other_cracks:
            return "another crack crosses the contour"
        if self.other_bodies:
            return "another body is at the contour"
        if self.empty:
            return "the contour leaves the body"
        return ""

    def _corners(self):
        box = self.box
        i, j, w, h = box.i, box.j, box.wide - 1, box.high - 1
        return (
            [(i + k, j) for k in range(w)]
            + [(i + w, j + k) for k in range(h)]
            + [(i + w - k, j + h) for k in range(w)]
            + [(i, j + h - k) for k in range(h)]
        )

    def _edge(self, here, a, there, b):
        """Integrate from a node to the next (fields a, b), on both sides of a crack between."""
        width = self.model.lattice.width
        normal = ((there[1] - here[1]), -(there[0] - here[0]))
        f = self._crossing(here, there)
        if f is None:
            return _trapezoid(width, normal, a, b)
        self.crossings += 1
        before = (1 - f) * a + f * self._across(there)
        after = (1 - f) * self._across(here) + f * b
        first = _trapezoid(f * width, normal, a, before)
        second = _trapezoid((1 - f) * width, normal, after, b)
        return first[0] + second[0], first[1] + second[1]

    def _place(self, at, row):
        """Return where the sums of a row of the node `at` stand."""
        if row < self.nodes:
            return at[0] - self.box.i + (at[1] - self.box.j) * self.box.wide
        return self.box.wide * self.box.high + row - self.nodes

    def _mean(self, at, row):
        """Return the means over all particles in a row of a node; zero where nobody is."""
        if row < 0:
            return np.zeros(self.sums.shape[1])
        total = self.sums[self._place(at, row)]
        return total / total[0] if total[0] else total

    def _own(self, at):
        """Fields of the side on which the node lies."""
        node = at[0] + at[1] * self.model.strides[1]
        self._look_for_body(at, node)
        return self._mean(at, node)

    def _look_for_body(self, at, node):
        """Count a node that sees less than a full cell, and one that several bodies see."""
        rows = self.scratch.rows
        volume, row = self.volume[self._place(at, node)], rows.first[node]
        while row >= 0:
            volume += self.volume[self._place(at, row)]
            row = rows.next[row - self.nodes]
        self.other_bodies += rows.lowest[node] < rows.highest[node]
        self.empty += volume < FULL * self.cell

    def _across(self, at):
        """Fields of the other side of the crack at a node; zero where nobody is."""
        rows, node = self.scratch.rows, at[0] + at[1] * self.model.strides[1]
        return self._mean(at, crossed_row(rows, node, self.crack))

    def _crossing(self, here, there):
        """Return how far along the edge the crack crosses it, or None."""
        lattice, segments = self.model.lattice, self.scratch.segments
        p = [low + lattice.width * c for low, c in zip(lattice.lower, here, strict=True)]
        n = [low + lattice.width * c for low, c in zip(lattice.lower, there, strict=True)]
        found, hair = [], NEARLY * lattice.width
        (x0, x1), (y0, y1) = sorted((p[0], n[0])), sorted((p[1], n[1]))
        for s, low, high in self.segments:
            if low[0] > x1 + hair or high[0] < x0 - hair:
                continue
            if low[1] > y1 + hair or high[1] < y0 - hair:
                continue
            if crosses(segments.real, segments.down, s, *p, *n, ON_CRACK * lattice.width):
                if segments.crack[s] == self.crack:
                    found.append(_fraction(p, n, segments.real[s]))
                else:
                    self.other_cracks += 1
        return found[0] if len(found) % 2 else None


def _fraction(p, n, segment):
    """Return where the line p -> n meets a segment, 0 at p and 1 at n."""
    ax, ay, bx, by = segment

    def above(x):
        return (bx - ax) * (x[1] - ay) - (by - ay) * (x[0] - ax)

    return min(1.0, max(0.0, above(p) / (above(p) - above(n))))


def _trapezoid(length, normal, a, b) -> tuple[float, float]:
    """Return the integrals of q_x and q_y over a piece of the contour with fields at both ends."""
    (ax, ay), (bx, by) = _integrand(a, normal), _integrand(b, normal)
    return 0.5 * length * (ax + bx), 0.5 * length * (ay + by)


def _integrand(f, normal) -> tuple[float, float]:
    """Return q_x and q_y from the fields at a point: (W + K) n - T . du/dx."""
    _, uxx, uxy, uyx, uyy, sxx, syy, sxy, W, K = f.tolist()
    tx, ty = sxx * normal[0] + sxy * normal[1], sxy * normal[0] + syy * normal[1]
    return (
        (W + K) * normal[0] - (tx * uxx + ty * uyx),
        (W + K) * normal[1] - (tx * uxy + ty * uyy),
    )


def along(direction, contour: Contour) -> tuple[float, float]:
    """Return J for growth along the crack and the component normal to it."""
    ex, ey = direction
    size = hypot(ex, ey)
    return (
        (contour.Jx * ex + contour.Jy * ey) / size,
        (-contour.Jx * ey + contour.Jy * ex) / size,
    )
