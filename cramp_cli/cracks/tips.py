"""J, K_I and K_II at every tip, with a word on whether they can be trusted.

The domain integral is the product; the contour integral of the paper stands beside it. A radius of
five cells is enough for the smooth weight; near an edge of the body, another tip, a load, a held
boundary, a bend or another material the domain shrinks, and where too little is left the tip has no
number. A crack on a symmetry plane has half a domain; the other half is its image.
"""

from dataclasses import dataclass
from math import hypot, nan
from typing import Any

import numpy as np

from cramp_cli.cracks.cloud import Cloud, cloud_around
from cramp_cli.cracks.contact import GLUED, IGNORE, OPEN
from cramp_cli.cracks.contour_integral import along, integrate_contour
from cramp_cli.cracks.domain import LEAK, Values, domain_values, hooke_of
from cramp_cli.cracks.domain_integral import Hooke, TipFrame, inner_radius, material_beside
from cramp_cli.cracks.doubts import doubts
from cramp_cli.cracks.face_terms import drawn, rubbed_off, zone_energy
from cramp_cli.cracks.intensity import K_from_J, open_and_slide, opening_near_tip
from cramp_cli.cracks.overlap import overlapping
from cramp_cli.cracks.room import find_room, nearest_body
from cramp_cli.cracks.segments import ON_CRACK
from cramp_cli.materials.geometry import Axisymmetric, depth
from cramp_cli.state.growth import BLEND, HELD, KINK, MIXED
from cramp_cli.state.paths import TIP

BESIDE = 3.0  # cells behind a tip and beside the crack in which the sides are told apart
USUAL, SMALLEST = 5.0, 2.5  # radius of the domain in cells, and the least that gives a number
REACH = 8.0  # cells around a tip or the corner of a kink that an integral can want
SPREAD = (0.8, 1.2)  # further radii that are compared, in shares of the radius
CORRECTED = "corrected: the domain holds another material"
STAGES = {
    MIXED: CORRECTED,
    KINK: "kink: from the field around the corner",
    BLEND: "kink: partly from the field around the corner",
    HELD: "held: no room for a domain, the last load found",
}


@dataclass(frozen=True)
class Fracture:
    """How J and K are evaluated."""

    methods: tuple = ("domain", "contour")
    radii: tuple = ()  # m; empty: chosen by the program
    cells: int = 2  # half size of the contour
    terms: int = 1  # 2: with the area integral of the inertia
    obstacles: tuple = ()  # of Obstacle


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


@dataclass(frozen=True)
class Site:
    """What the integrals around a tip need to know."""

    frame: TipFrame
    cloud: Cloud  # the particles around it
    block: Any  # the particles of the material at the tip
    hooke: Hooke
    gravity: Any  # acceleration of everything (m/s^2)
    half: bool  # the crack lies on a symmetry plane, the other half of the body is an image


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
        measure = _recall_growth if grown else _measure_domain
        measured, remark = measure(model, state, scratch, tip, site)
        row |= measured
        remarks.append(remark)
    if "contour" in model.fracture.methods:
        measured, remark = _measure_contour(model, state, scratch, tip, site, normal, slide)
        row |= measured
        remarks.append(remark)
    row["status"] = "; ".join(filter(None, remarks))
    moving = bool(grown and row["speed"] > 0.0)
    remarks += doubts(model, site, row, moving) + overlapping(model, state.paths, tip, site, row)
    return row | {"status": "; ".join(filter(None, remarks)) or "ok"}


def site_of(model, state, scratch, tip) -> Site:
    """Return what the integrals around a tip need to know."""
    paths = state.paths
    place = paths.origin[tip.points[0]]
    return site_at(model, state, scratch, tip, place, tip.direction(paths.origin))


def site_at(model, state, scratch, tip, place, before) -> Site:
    """Return what integrals around a place of the crack of a tip need to know.

    place: in the undeformed body (m); before: unit vector along the crack there
    """
    frame = TipFrame(tuple(place.tolist()), before, before)
    reach = max(REACH * model.lattice.width, SPREAD[-1] * max(model.fracture.radii, default=0.0))
    group = int(model.groups.of_crack[tip.crack])
    cloud = cloud_around(model, state, scratch, place, reach, group)
    block = block_at(model, cloud, place)
    gravity = model.conditions.body_force(state, len(model.strides))
    half = bool(state.paths.mirror[tip.crack, 0] >= 0)
    if not half:
        frame = turned_with_solid(model, cloud.particles, frame)
        frame = between_particles(model, cloud, frame, tip.end)
    return Site(frame, cloud, block, hooke_of(block.law, model.geometry), gravity, half)


def turned_with_solid(model, particles, frame) -> TipFrame:
    """Return the frame with its axis of now: that of before, turned with the solid around the tip.

    The crack's own points at the tip follow the solid less well: a frame that is off by a hundredth
    finds a J of its own in a body that turns fast.
    """
    near = np.hypot(*(particles.origin - frame.origin).T) < USUAL * model.lattice.width
    xx, xy, yx, yy = particles.volume[near] @ particles.F[near]
    turn = hypot(xx + yy, yx - xy)
    c, s = ((xx + yy) / turn, (yx - xy) / turn) if turn else (1.0, 0.0)
    (ex, ey) = frame.before
    return frame._replace(now=(float(c * ex - s * ey), float(s * ex + c * ey)))


def between_particles(model, cloud, frame, end) -> TipFrame:
    """Return the frame of a tip moved to the line that parts the particles of both sides.

    Particles belong to one side as wholes, so the faces of the discrete body lie midway between
    them, up to a quarter of a cell from the line of the crack; seen from the line itself K_I would
    leak into K_II by a percent at ten cells per half crack.

    end: 0 at the first point of the crack, where the frame looks against the crack's direction
    """
    length = BESIDE * model.lattice.width
    behind = frame.origin[0] - 0.5 * length * frame.before[0]  # the centre of the weight
    thickness = depth(model.geometry, behind)
    line = (2 * end - 1) * ON_CRACK * model.lattice.width  # particles on a crack lie below it
    sides = [
        material_beside(cloud.particles, frame, length, line, lo, hi) for _, lo, hi in cloud.parts
    ]
    if not sides:  # a tip in free space
        return frame._replace(line=line)
    above, below = (sum(side) / (0.5 * length * thickness) for side in zip(*sides, strict=True))
    if abs(above + below - length) > LEAK * length:
        return frame._replace(line=line)
    off, (ex, ey), (x, y) = 0.5 * (below - above), frame.before, frame.origin
    return frame._replace(origin=(x - off * ey, y + off * ex), line=line - off)


def block_at(model, cloud, place):
    """Return the block of the particle nearest to a place in the undeformed body (m)."""
    if not cloud.parts:
        return model.blocks[0]
    nearest = int(np.argmin(np.sum((cloud.particles.origin - place) ** 2, axis=1)))
    return next(block for block, lo, hi in cloud.parts if lo <= nearest < hi)


def _measure_contour(model, state, scratch, tip, site, normal, slide):
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
    K_I, K_II = K_from_J(J, normal, slide, site.hooke.shear, site.hooke.kappa)
    return {"J_contour": J, "K_I_contour": K_I, "K_II_contour": K_II}, ""


def _recall_growth(model, state, scratch, tip, site):
    """A tip that has grown has the load that drove it in the last step (tip_load.py)."""
    k = 2 * tip.crack + tip.end
    J, K_I, K_II = state.growth.load[k].tolist()
    remarks = [STAGES.get(int(state.growth.stage[k]), "")]
    cells = state.growth.reach[k] / model.lattice.width
    if cells < USUAL and not model.fracture.radii:
        remarks.append(f"shrunk: a domain of {cells:.2g} cells")
    if state.growth.wall[k]:
        remarks.append("along an interface")
    remark = "; ".join(filter(None, remarks))
    return _with_zone(model, state, tip, J) | {"K_I": K_I, "K_II": K_II}, remark


def _with_zone(model, state, tip, J) -> dict:
    """Return J of a tip, of the cohesive zone behind it, and of both together."""
    zone = zone_energy(model, state, tip)
    return {"J_tip": J, "J_zone": zone, "J": J + zone}


def _measure_domain(model, state, scratch, tip, site):
    paths, radii, width = state.paths, model.fracture.radii, model.lattice.width
    wanted, least = radii[0] if radii else USUAL * width, (1.0 - 1e-9) * SMALLEST * width
    if wanted < least:
        return {}, f"invalid: the radius is below {SMALLEST:g} cells"
    room, what = min(
        find_room(model, paths, tip, site.frame.origin), nearest_body(model, state, tip)
    )
    radius, remark = (room, what) if room < wanted else (wanted, "")
    measured, radius, remark = _fitting(model, state, site, tip, radius, least, remark)
    if measured is None or (radii and remark):
        return {}, f"invalid: {remark} is nearer than {wanted / width:.3g} cells"
    J, K_I, K_II = measured[:3]
    others = [r for r in radii[1:] or [s * radius for s in SPREAD] if r <= room]
    spread = _spread(measured, [tip_values(model, state, site, tip, r) for r in others])
    status = f"shrunk: {remark} within {wanted / width:.3g} cells" if remark else ""
    if measured.mixed:
        status = "; ".join(filter(None, [CORRECTED, status]))
    here, inner = paths.point[tip.points[0]], inner_radius(radius, width)
    if is_closed(model, scratch, tip.crack, here, radius, K_I):
        K_I, status = 0.0, "; ".join(filter(None, ["closed", status]))
        K_II -= rubbed_off(model, site, tip.crack, inner, radius)
    values = {"K_I": K_I, "K_II": K_II, "J_spread": spread}
    return _with_zone(model, state, tip, J) | values, status


def _fitting(model, state, site, tip, radius, least, remark):
    """Return what the largest domain of one material gives, its radius, and what made it smaller.

    If there is none down to `least` (m): of the largest with a second material, or None.
    """
    second = None
    while radius >= least:
        values = tip_values(model, state, site, tip, radius)
        if not values.spoiled and not values.mixed:
            return values, radius, remark
        if not values.spoiled and second is None:
            second = values, radius, remark
        radius, remark = 0.9 * radius, values.spoiled or "another material"
    return second or (None, radius, remark)


def _spread(measured, others) -> float:
    """Return the spread of J over domains that hold nothing foreign; nan if none has another J."""
    J = measured.J
    values = [other.J for other in others if not other.spoiled and other.mixed <= measured.mixed]
    if not values:
        return nan
    return (max(*values, J) - min(*values, J)) / abs(J) if J else 0.0


def tip_values(model, state, site, tip, radius) -> Values:
    """Return what a domain gives without what the faces carry."""
    found = domain_values(model, site, radius)
    inner = inner_radius(radius, model.lattice.width)
    J, K_I, K_II = drawn(model, state, tip, site.frame.now, inner, radius).tolist()
    return found._replace(J=found.J - J, K_I=found.K_I - K_I, K_II=found.K_II - K_II)


def crack_length(paths, crack: int) -> float:
    """Return the length of the line midway between both surfaces (m)."""
    points = paths.crack(crack)
    middle = 0.5 * (paths.above[points] + paths.below[points])
    return float(np.hypot(*np.diff(middle, axis=0).T).sum())


def is_closed(model, scratch, crack, place, radius, K_I) -> bool:
    """Return whether most nodes on a crack within a domain have touching sides, or K_I is negative.

    place: centre of the domain now (m); faces that ignore each other are never closed
    """
    if model.contact.kind[crack] == IGNORE:
        return False
    if model.contact.kind[crack] == GLUED or K_I < 0.0:  # faces can not overlap
        return True
    rows, lattice = scratch.rows, model.lattice
    n = int(rows.count[0])
    along_x = lattice.nodes[0]
    node = rows.node[:n]
    at = np.stack([node % along_x, node // along_x], axis=1) * lattice.width + np.array(
        lattice.lower
    )
    near = np.sum((at - place) ** 2, axis=1) < radius**2
    mine = (rows.owner[:n, 0] == crack) & near
    if not mine.any():
        return False
    return bool(np.mean(rows.touching[:n, 0][mine] != OPEN) > 0.5)
