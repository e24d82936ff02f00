"""J on a rectangle of grid lines around a tip, as in the paper (Guo and Nairn 2004; Nairn 2003).

Nodal averages per velocity field, trapezoid rule along the contour, both sides of the crack where
it crosses, kinetic energy in the line term and, with two terms, the area integral of the inertia.
"""

from math import hypot
from typing import NamedTuple

import numpy as np

from cramp_cli.cracks.contour_sums import Box, area_term, sum_fields
from cramp_cli.cracks.contour_walk import line_integral
from cramp_cli.materials.law import same_law
from cramp_cli.state.bands import band_axis, runs_between

SEEN = 3  # rows of cells within which a particle may see a node
FULL = 0.75  # a contour node that sees less of a full cell lies at or beyond the edge of the body


class Contour(NamedTuple):
    """Jx, Jy (J/m^2) and why they can not be trusted, or an empty text."""

    Jx: float
    Jy: float
    trouble: str


def integrate_contour(model, state, scratch, branch, tip, block, gravity) -> Contour:
    """Return J along x and y on a rectangle around the node nearest to `tip`.

    With one term it is the line integral alone, with two the area integral of the inertia as well.

    branch: that of the crack at the tip; tip: position (m); block: particles of the material there
    gravity: m/s^2
    """
    lattice, cells, terms = model.lattice, model.fracture.cells, model.fracture.terms
    centre = [round((x - low) / lattice.width) for x, low in zip(tip, lattice.lower, strict=True)]
    box = Box(centre[0] - cells, centre[1] - cells, 2 * cells + 1, 2 * cells + 1)
    if min(box.i, box.j) < 0 or any(
        c + cells > n for c, n in zip(centre, lattice.cells, strict=True)
    ):
        return Contour(np.nan, np.nan, "the contour does not fit in the grid")
    sums = _fields(model, state, scratch, box)
    full = FULL * lattice.width**2 * model.geometry.thickness
    place = (lattice.lower, lattice.width, model.strides)
    Jx, Jy, *met = line_integral(sums, box, scratch.rows, scratch.segments, branch, *place, full)
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
    return Contour(Jx, Jy, _trouble(*met))


def _holds_others(model, particles, law, lower, upper) -> bool:
    """Return whether particles of another law lie in a rectangle or a cell beside it."""
    width = model.lattice.width
    others = [b for b in model.blocks if not same_law(b.law, law)]
    places = (particles.position[b.lo : b.hi] for b in others)
    return any(np.all((x > lower - width) & (x < upper + width), axis=1).any() for x in places)


def _fields(model, state, scratch, box) -> np.ndarray:
    """Return the sums of `sum_fields` in all rows of the nodes of a contour and within."""
    lattice, nodes = model.lattice, len(scratch.rows.first)
    sums = np.zeros((box.wide * box.high + int(scratch.rows.count[0]), 11))
    across = band_axis(lattice.cells)
    low, count = ((box.i, box.wide), (box.j, box.high))[across]
    runs = runs_between(state.bands, low - SEEN, low + count + SEEN)
    place = (model.strides, box, nodes, lattice.lower, lattice.width)
    for b, (lo, hi) in zip(model.blocks, runs, strict=True):
        sum_fields(sums, state.particles, scratch.stencil, b.shape, *place, lo, hi)
    return sums


def _trouble(crossings, other_cracks, other_bodies, empty) -> str:
    """Return why the integral can not be trusted, or an empty text."""
    if crossings == 0:
        return "the crack does not cross its contour"
    if crossings > 1:
        return "the crack crosses its contour more than once"
    if other_cracks:
        return "another crack crosses the contour"
    if other_bodies:
        return "another body is at the contour"
    if empty:
        return "the contour leaves the body"
    return ""


def along(direction, contour: Contour) -> tuple[float, float]:
    """Return J for growth along the crack and the component normal to it."""
    ex, ey = direction
    size = hypot(ex, ey)
    return (
        (contour.Jx * ex + contour.Jy * ey) / size,
        (-contour.Jx * ey + contour.Jy * ex) / size,
    )
