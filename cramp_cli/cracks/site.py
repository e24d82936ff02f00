"""What the integrals around a tip need to know: frame, particles around it, material."""

from dataclasses import dataclass, replace
from math import hypot, inf
from typing import Any

import numpy as np

from cramp_cli.cracks.cloud import Cloud, cloud_around
from cramp_cli.cracks.domain import LEAK, REACH, SPREAD, USUAL, hooke_of
from cramp_cli.cracks.domain_integral import Hooke, TipFrame, material_beside
from cramp_cli.cracks.segments import ON_CRACK
from cramp_cli.cracks.tip_curve import curve_at
from cramp_cli.materials.geometry import depth

BESIDE = 3.0  # cells behind a tip and beside the crack in which the sides are told apart


@dataclass(frozen=True)
class Site:
    """What the integrals around a tip need to know."""

    frame: TipFrame
    cloud: Cloud  # the particles around it
    block: Any  # the particles of the material at the tip
    hooke: Hooke
    gravity: Any  # acceleration of everything (m/s^2)
    half: bool  # the crack lies on a symmetry plane, the other half of the body is an image
    follows: float = inf  # way from the tip (m) up to which the crack follows the frame


def site_of(model, state, scratch, tip) -> Site:
    """Return what the integrals around a tip need to know."""
    line, width = state.paths.origin[tip.points], model.lattice.width
    radii = model.fracture.radii
    curve = curve_at(line, width, radii[0] if radii else USUAL * width)
    site = site_at(model, state, scratch, tip, line[0], curve.direction, curve.bend)
    return replace(site, follows=curve.length)


def site_at(model, state, scratch, tip, place, before, bend=0.0) -> Site:
    """Return what integrals around a place of the crack of a tip need to know.

    place: in the undeformed body (m); before: unit vector along the crack there; bend: its
    curvature on that way, positive to the left (1/m)
    """
    frame = TipFrame(tuple(place.tolist()), before, before, bend=bend)
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
    moved = (x - off * ey, y + off * ex)
    return frame._replace(origin=moved, line=line - off, bend=frame.bend / (1.0 - frame.bend * off))


def block_at(model, cloud, place):
    """Return the block of the particle nearest to a place in the undeformed body (m)."""
    if not cloud.parts:
        return model.blocks[0]
    nearest = int(np.argmin(np.sum((cloud.particles.origin - place) ** 2, axis=1)))
    return next(block for block, lo, hi in cloud.parts if lo <= nearest < hi)
