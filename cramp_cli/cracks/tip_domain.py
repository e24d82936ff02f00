"""J, K_I and K_II of a tip by its domain: how large it may be, what it holds, whether closed."""

from math import inf, nan

import numpy as np

from cramp_cli.cracks.contact import GLUED, IGNORE, OPEN
from cramp_cli.cracks.domain import REACH, SMALLEST, SPREAD, USUAL, Values, domain_values
from cramp_cli.cracks.domain_integral import inner_radius
from cramp_cli.cracks.face_terms import drawn, rubbed_off, zone_energy
from cramp_cli.cracks.room import find_room, nearest_body
from cramp_cli.state.growth import BLEND, HELD, KINK, MIXED

BESIDE_OTHERS = 6.6  # radius in cells of a domain that holds a second material
UNLIKE = 0.04  # J_spread beside another material above which K may be off by more than 2 %
CORRECTED = "corrected: the domain holds another material"
STAGES = {
    MIXED: CORRECTED,
    KINK: "kink: from the field around the corner",
    BLEND: "kink: partly from the field around the corner",
    HELD: "held: no room for a domain, the last load found",
}


def recall_growth(model, state, scratch, tip, site):
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


def measure_domain(model, state, scratch, tip, site):
    """Return what the domain gives for a row of cracks.csv, and a remark for its status."""
    paths, radii, width = state.paths, model.fracture.radii, model.lattice.width
    wanted, least = radii[0] if radii else USUAL * width, (1.0 - 1e-9) * SMALLEST * width
    if wanted < least:
        return {}, f"invalid: the radius is below {SMALLEST:g} cells"
    room, what = min(
        find_room(model, paths, tip, site.frame.origin, inf),
        nearest_body(model, state, tip),
        (site.follows, "a bend of the crack"),
    )
    radius, remark = (room, what) if room < wanted else (wanted, "")
    within = (model, state, site, tip)
    measured, radius, remark = _fitting(*within, radius, least, remark)
    if measured is not None and measured.corrected and not radii:
        measured, radius, remark = _beside_others(*within, room, (measured, radius, remark))
    if measured is None or (radii and remark):
        limit = wanted / width if radii else SMALLEST
        return {}, f"invalid: {remark} is nearer than {limit:.3g} cells"
    J, K_I, K_II = measured[:3]
    reach = room if radii else min(room, REACH * width)
    others = [r for r in radii[1:] or [s * radius for s in SPREAD] if r <= reach]
    spread = _spread(measured, [tip_values(*within, r) for r in others], site.hooke)
    status = f"shrunk: {remark} within {wanted / width:.3g} cells" if remark else ""
    if measured.corrected:
        status = "; ".join(filter(None, [CORRECTED, status]))
        if spread > UNLIKE:
            status += f"; doubtful: domains of several radii differ by {100.0 * spread:.0f} % in J"
    here, inner = paths.point[tip.points[0]], inner_radius(radius, width)
    if is_closed(model, scratch, tip.crack, here, radius, K_I):
        K_I, status = 0.0, "; ".join(filter(None, ["closed", status]))
        K_II -= rubbed_off(model, site, tip.crack, inner, radius)
    values = {"K_I": K_I, "K_II": K_II, "J_spread": spread}
    return _with_zone(model, state, tip, J) | values, status


def _fitting(model, state, site, tip, radius, least, remark):
    """Return what the largest domain gives that fits, its radius, and what made it smaller.

    Of one material alone, if K of what else it holds can not be found; None if there is none down
    to `least` (m).
    """
    while radius >= least:
        values = tip_values(model, state, site, tip, radius)
        if not values.spoiled:
            return values, radius, remark
        radius, remark = 0.9 * radius, values.spoiled
    return None, radius, remark


def _beside_others(model, state, site, tip, room, found):
    """Return what a domain with a second material gives that is as large as it can be; J is of K.

    Where an interface crosses cells the particles of both sides share strain in them, which should
    share stress: 2 to 6 % of K in a domain whose border is near, next to nothing in a large one.

    found: what the usual domain gives, its radius, and what made it smaller
    """
    radius, (values, least, remark) = min(BESIDE_OTHERS * model.lattice.width, room), found
    while radius > least:
        larger = tip_values(model, state, site, tip, radius)
        if larger.corrected and not larger.spoiled:
            return larger._replace(J=_J_of_K(larger, site.hooke)), radius, remark
        radius *= 0.9
    radius = least
    return values._replace(J=_J_of_K(values, site.hooke)), radius, remark


def _J_of_K(values, hooke) -> float:
    return (values.K_I**2 + values.K_II**2) / hooke.stiffness


def _spread(measured, others, hooke) -> float:
    """Return the spread of J over domains that hold nothing foreign; nan if none has another J."""
    J, others = measured.J, [other for other in others if not other.spoiled]
    if measured.corrected:
        values = [_J_of_K(other, hooke) for other in others]
    else:
        values = [other.J for other in others if not other.mixed]
    if not values:
        return nan
    return (max(*values, J) - min(*values, J)) / abs(J) if J else 0.0


def tip_values(model, state, site, tip, radius) -> Values:
    """Return what a domain gives without what the faces carry."""
    found = domain_values(model, site, radius)
    inner = inner_radius(radius, model.lattice.width)
    J, K_I, K_II = drawn(model, state, tip, site.frame, inner, radius).tolist()
    return found._replace(J=found.J - J, K_I=found.K_I - K_I, K_II=found.K_II - K_II)


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
