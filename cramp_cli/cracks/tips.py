"""J, K_I and K_II at every tip, with a word on whether they can be trusted.

The domain integral is the product; the contour integral of the paper stands beside it. A radius of
five cells is enough for the smooth weight; near an edge of the body, another tip, a load, a held
boundary, a bend or another material the domain shrinks, and where too little is left the tip has no
number. A crack on a symmetry plane has half a domain; the other half is its image.
"""

from dataclasses import dataclass
from math import hypot, nan

import numpy as np

from cramp_cli.cracks.contour_integral import along, integrate_contour
from cramp_cli.cracks.doubts import doubts
from cramp_cli.cracks.intensity import K_from_J, open_and_slide, opening_behind, opening_near_tip
from cramp_cli.cracks.overlap import overlapping
from cramp_cli.cracks.site import site_of
from cramp_cli.cracks.tip_domain import measure_domain, recall_growth
from cramp_cli.materials.geometry import Axisymmetric
from cramp_cli.state.paths import TIP


@dataclass(frozen=True)
class Fracture:
    """How J and K are evaluated."""

    methods: tuple = ("domain", "contour")
    radii: tuple = ()  # m; empty: chosen by the program
    cells: int = 2  # half size of the contour
    terms: int = 1  # 2: with the area integral of the inertia
    obstacles: tuple = ()  # of Obstacle
    means: bool = False  # means over the time a wave takes through the domain stand in the rows


@dataclass(frozen=True)
class Tip:
    """An end of a crack that is measured."""

    crack: int
    end: int  # 0 first point, 1 last point
    points: np.ndarray  # numbers of the crack's points, from the tip inwards

    def direction(self, line) -> tuple:
        """Return the unit vector out of the crack along `line` (points of all cracks)."""
        ex, ey = line[self.points[0]] - line[self.points[1]]
        return float(ex / hypot(ex, ey)), float(ey / hypot(ex, ey))


def tips_of(paths) -> list[Tip]:
    """Return all ends that are tips, crack by crack."""
    tips = []
    for crack in range(paths.crack_count):
        points = np.arange(paths.start[crack], paths.start[crack + 1])
        for end, inwards in ((0, points), (1, points[::-1])):
            if paths.ends[crack, end] == TIP:
                tips.append(Tip(crack, end, inwards))
    return tips


def sample_tips(model, state, scratch) -> list[dict]:
    """Return a row of cracks.csv for every tip; call it after a step."""
    return [_sample(model, state, scratch, tip) for tip in tips_of(state.paths)]


def _sample(model, state, scratch, tip) -> dict:
    paths, site = state.paths, site_of(model, state, scratch, tip)
    place, now = paths.point[tip.points[0]], tip.direction(paths.point)
    normal, slide = open_and_slide(opening_near_tip(paths, tip.crack, tip.end), now)
    if paths.fixed[tip.crack]:  # its surfaces do not move: no opening is known
        normal = slide = nan
    row = {
        "step": state.step,
        "time": state.time,
        "crack": model.crack_names[tip.crack],
        "tip": ("start", "end")[tip.end],
        "x": float(place[0]),
        "y": float(place[1]),
        "angle": float(np.arctan2(now[1], now[0])),
        "length": crack_length(paths, tip.crack),
        "speed": float(state.growth.speed[2 * tip.crack + tip.end]),
        "K_III": 0.0,
        "ctod_n": normal,
        "ctod_t": slide,
    }
    unmeasured = {"J_tip": nan, "J_zone": nan, "J": nan, "K_I": nan, "K_II": nan, "J_spread": nan}
    row |= unmeasured | {"J_contour": nan, "K_I_contour": nan, "K_II_contour": nan}
    remarks, grown = [], state.growth.length[2 * tip.crack + tip.end] > 0.0
    if "domain" in model.fracture.methods:
        measure = recall_growth if grown else measure_domain
        measured, remark = measure(model, state, scratch, tip, site)
        row |= measured
        remarks.append(remark)
    if "contour" in model.fracture.methods:
        measured, remark = _measure_contour(model, state, scratch, tip, site)
        row |= measured
        remarks.append(remark)
    row["status"] = "; ".join(filter(None, remarks))
    run = _run(state, tip, row)
    remarks += doubts(model, site, row, run) + overlapping(model, state.paths, tip, site, row)
    return row | {"status": "; ".join(filter(None, remarks)) or "ok"}


def _run(state, tip, row) -> tuple:
    """Return how far a running tip has run, and the length of its crack; half with two tips."""
    if not row["speed"] > 0.0:
        return ()
    two = np.all(state.paths.ends[tip.crack] == TIP)
    way = float(state.growth.length[2 * tip.crack + tip.end])
    return way, row["length"] * (0.5 if two else 1.0)


def _measure_contour(model, state, scratch, tip, site):
    """Return J of the contour, K_I and K_II in the ratio of the opening, and a remark."""
    if site.half:
        return {}, "contour invalid: the crack lies on a symmetry plane"
    if isinstance(model.geometry, Axisymmetric):
        return {}, "contour invalid: it is made for plane bodies"
    if model.cohesion is not None and np.any(state.paths.law[tip.points] >= 0):
        return {}, "contour invalid: stresses act on the faces"
    place = state.paths.point[tip.points[0]]
    branch = int(scratch.segments.of_end[2 * tip.crack + tip.end])
    contour = integrate_contour(model, state, scratch, branch, place, site.block, site.gravity)
    if contour.trouble:
        return {}, f"contour invalid: {contour.trouble}"
    J, _ = along(tip.direction(state.paths.point), contour)
    if state.paths.fixed[tip.crack]:
        return {"J_contour": J}, ""
    opening = opening_behind(state.paths, tip, site.frame, model.lattice.width)
    K_I, K_II = K_from_J(J, *opening, site.hooke.shear, site.hooke.kappa)
    return {"J_contour": J, "K_I_contour": K_I, "K_II_contour": K_II}, ""


def crack_length(paths, crack: int) -> float:
    """Return the length of the line midway between both surfaces (m)."""
    points = paths.crack(crack)
    middle = 0.5 * (paths.above[points] + paths.below[points])
    return float(np.hypot(*np.diff(middle, axis=0).T).sum())
