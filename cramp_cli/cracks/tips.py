"""J, K_I and K_II at every tip, with a word on whether they can be trusted.

The domain integral is the product; the contour integral of the paper stands beside it. A radius of five
cells is enough for the smooth weight; near an edge of the body, another tip, a load, a held boundary, a
bend or another material the domain shrinks, and where too little is left the tip has no number.
"""

from dataclasses import dataclass
from math import hypot, nan

import numpy as np

from cramp_cli.cracks.contact import GLUED, IGNORE, OPEN
from cramp_cli.cracks.contour_integral import along, integrate_contour
from cramp_cli.cracks.domain_integral import (
    INNER,
    Hooke,
    TipFrame,
    integral_of_weight,
    integrate_domain,
)
from cramp_cli.cracks.intensity import K_from_J, open_and_slide, opening_near_tip
from cramp_cli.materials.geometry import is_plane_stress
from cramp_cli.materials.law import poisson_ratio, shear_modulus
from cramp_cli.state.paths import TIP

USUAL, SMALLEST = 5.0, 2.5  # radius of the domain in cells, and the least that gives a number
SPREAD = (0.8, 1.0, 1.2)  # radii that are compared, in shares of the radius
LEAK = 0.02  # part of the domain that may be empty: particles are a coarse quadrature
BEND = 0.17  # a crack that turns by more than this (rad) ends the domain


@dataclass(frozen=True)
class Fracture:
    """How J and K are evaluated."""

    methods: tuple = ("domain", "contour")
    radii: tuple = ()  # m; empty: chosen by the program
    cells: int = 2  # half size of the contour
    terms: int = 1  # 2: with the area integral of the inertia
    obstacles: tuple = ()  # (position in the undeformed body (n, 2), what it is)


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
    paths, settings = state.paths, model.fracture
    place, now = paths.point[tip.points[0]], tip.direction(paths.point)
    hooke = hooke_at(model, state.particles, paths.origin[tip.points[0]])
    gravity = model.conditions.body_force(state.time, 2)
    opening = opening_near_tip(paths, tip.crack, tip.end)
    normal, slide = open_and_slide(opening, now)
    row = {
        "step": state.step,
        "time": state.time,
        "crack": model.crack_names[tip.crack],
        "tip": ("start", "end")[tip.end],
        "x": float(place[0]),
        "y": float(place[1]),
        "angle": float(np.degrees(np.arctan2(now[1], now[0]))),
        "length": crack_length(paths, tip.crack),
        "speed": 0.0,
        "K_III": 0.0,
        "ctod_n": normal,
        "ctod_t": slide,
    }
    unmeasured = {"J": nan, "K_I": nan, "K_II": nan, "J_spread": nan}
    row |= unmeasured | {"J_contour": nan, "K_I_contour": nan, "K_II_contour": nan}
    remarks = []
    if "domain" in settings.methods:
        measured, remark = _measure_domain(model, state, scratch, tip, hooke, gravity)
        row |= measured
        remarks.append(remark)
    if "contour" in settings.methods:
        measured, remark = _measure_contour(
            model, state, scratch, tip, hooke, gravity, normal, slide
        )
        row |= measured
        remarks.append(remark)
    return row | {"status": "; ".join(filter(None, remarks)) or "ok"}


def _measure_contour(model, state, scratch, tip, hooke, gravity, normal, slide):
    place = state.paths.point[tip.points[0]]
    settings = model.fracture
    contour = integrate_contour(
        model, state, scratch, tip.crack, place, settings.cells, settings.terms, gravity
    )
    if contour.trouble:
        return {}, f"contour invalid: {contour.trouble}"
    J, _ = along(tip.direction(state.paths.point), contour)
    K_I, K_II = K_from_J(J, normal, slide, hooke.shear, hooke.kappa)
    return {"J_contour": J, "K_I_contour": K_I, "K_II_contour": K_II}, ""


def _measure_domain(model, state, scratch, tip, hooke, gravity):
    paths, settings, width = state.paths, model.fracture, model.lattice.width
    frame = TipFrame(
        tuple(paths.origin[tip.points[0]].tolist()),
        tip.direction(paths.origin),
        tip.direction(paths.point),
    )
    room, what = _room(model, paths, tip, frame)
    wanted = settings.radii[0] if settings.radii else USUAL * width
    radius, remark = wanted, ""
    while True:
        if radius > room:
            radius, remark = room, what
        J, K_I, K_II, full = domain_values(model, state, frame, hooke, gravity, radius)
        if full or radius < SMALLEST * width:
            break
        radius, remark = 0.9 * radius, "the edge of the body"
    if radius < SMALLEST * width or (settings.radii and remark):
        return {}, f"invalid: {remark} is nearer than {wanted / width:.3g} cells"
    radii = settings.radii[1:] or [s * radius for s in SPREAD if s * radius <= room]
    values = [domain_values(model, state, frame, hooke, gravity, r) for r in radii]
    others = [v[0] for v in values if v[3]] or [J]
    spread = (max(*others, J) - min(*others, J)) / abs(J) if J else 0.0
    status = f"shrunk: {remark} within {wanted / width:.3g} cells" if remark else ""
    if _is_closed(model, scratch, tip, paths.point[tip.points[0]], radius):
        K_I, status = 0.0, "; ".join(filter(None, ["closed", status]))
    return {"J": J, "K_I": K_I, "K_II": K_II, "J_spread": spread}, status


def domain_values(model, state, frame, hooke, gravity, radius):
    """Return J, K_I, K_II of a domain, and whether it is filled with one material."""
    sums = np.zeros(4)
    fills = []
    for b in model.blocks:
        part = integrate_domain(
            state.particles, frame, hooke, gravity, INNER * radius, radius, b.lo, b.hi
        )
        sums += part
        fills.append(part[3])
    thickness = model.geometry.thickness
    expected = integral_of_weight(INNER * radius, radius) * thickness
    full = abs(max(fills) / expected - 1.0) < LEAK
    J, K_I, K_II = (sums[:3] / thickness).tolist()
    return J, K_I, K_II, full


def hooke_at(model, particles, place) -> Hooke:
    """Return the elastic constants of the particle nearest to a place in the undeformed body (m)."""
    nearest = int(np.argmin(np.sum((particles.origin - place) ** 2, axis=1)))
    law = next(b.law for b in model.blocks if b.lo <= nearest < b.hi)
    shear, nu = shear_modulus(law), poisson_ratio(law)
    plane_nu = nu / (1.0 + nu) if is_plane_stress(model.geometry) else nu
    return Hooke(shear, 3.0 - 4.0 * plane_nu, plane_nu, 2.0 * shear / (1.0 - plane_nu))


def crack_length(paths, crack: int) -> float:
    """Return the length of the line midway between both surfaces (m)."""
    points = paths.crack(crack)
    middle = 0.5 * (paths.above[points] + paths.below[points])
    return float(np.hypot(*np.diff(middle, axis=0).T).sum())


def _room(model, paths, tip, frame) -> tuple[float, str]:
    """Return the distance of what is nearest to a tip and spoils its domain, and what that is."""
    here = np.array(frame.origin)
    found = [(np.inf, "")]
    for c in range(paths.crack_count):
        line = paths.origin[paths.crack(c)]
        if c != tip.crack:
            found.append((_distance(here, line), f"crack {model.crack_names[c]}"))
    own = paths.origin[tip.points]
    step = np.diff(own, axis=0)
    turned = np.arctan2(step[:, 1], step[:, 0]) - np.arctan2(-frame.before[1], -frame.before[0])
    bent = np.flatnonzero(np.abs(np.angle(np.exp(1j * turned))) > BEND)
    if len(bent):
        found.append((float(np.hypot(*(own[bent[0]] - here))), "a bend of the crack"))
    if paths.ends[tip.crack, 1 - tip.end] == TIP:
        found.append((float(np.hypot(*(own[-1] - here))), "the other tip"))
    for places, what in model.fracture.obstacles:
        if len(places):
            found.append((float(np.sqrt(np.min(np.sum((places - here) ** 2, axis=1)))), what))
    return min(found)


def _distance(here, line) -> float:
    """Return the distance of a point from a polyline (m)."""
    a, b = line[:-1], line[1:]
    along_line = np.sum((here - a) * (b - a), axis=1) / np.maximum(
        np.sum((b - a) ** 2, axis=1), 1e-300
    )
    foot = a + np.clip(along_line, 0.0, 1.0)[:, None] * (b - a)
    return float(np.sqrt(np.min(np.sum((foot - here) ** 2, axis=1))))


def _is_closed(model, scratch, tip, place, radius) -> bool:
    """Return whether most nodes on the crack within the domain have touching sides."""
    if model.contact.kind[tip.crack] == IGNORE:
        return False
    if model.contact.kind[tip.crack] == GLUED:
        return True
    rows, lattice = scratch.rows, model.lattice
    n = int(rows.count[0])
    along_x = lattice.nodes[0]
    node = rows.node[:n]
    at = np.stack([node % along_x, node // along_x], axis=1) * lattice.width + np.array(
        lattice.lower
    )
    near = np.sum((at - place) ** 2, axis=1) < radius**2
    mine = (rows.crack[:n, 0] == tip.crack) & near
    if not mine.any():
        return False
    return bool(np.mean(rows.touching[:n, 0][mine] != OPEN) > 0.5)
