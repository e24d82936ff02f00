"""Cracks grow between steps: load, speed, a little way, and what the tip meets there.

A tip moves v dt in every step, as a real number: a smooth tip is felt at any place in its cell. A
new piece with a new direction begins when the last one is half a cell long (docs/theory/growth.md).
"""

from dataclasses import dataclass
from math import atan2, inf, sqrt
from typing import Any, NamedTuple

import numpy as np

from cramp_cli.cracks.criteria.directions import GIVEN, OWN, turn_by, turned
from cramp_cli.cracks.criteria.load import Load
from cramp_cli.cracks.domain import USUAL
from cramp_cli.cracks.extend import add_point, cover_end, end_point, make_room, move_end
from cramp_cli.cracks.intensity import open_and_slide, opening_near_tip
from cramp_cli.cracks.interface import choose_course
from cramp_cli.cracks.meeting import first_met, has_left_body, join_met, leave_body, stay_on_grid
from cramp_cli.cracks.overlap import is_shut
from cramp_cli.cracks.sinks import lose, lose_the_rest, spread_over_way
from cramp_cli.cracks.speed import Pull
from cramp_cli.cracks.tip_load import LONG, line_of, load_on
from cramp_cli.cracks.tips import Tip, crack_length, tips_of
from cramp_cli.state.growth import BLIND, HELD
from cramp_cli.state.paths import EDGE, PLAIN, TIP

CORNER = 0.4363  # a turn of more than this (25 degrees, rad) is a corner
TURNING = 2.0  # cells on the way of which a running tip turns
LEAST_MOVE = 1e-3  # growth shorter than this (cells) waits before it begins a new piece
UNSEEN = 6.0  # cells that a tip runs on with its last load where no domain fits
ARREST = 10.0  # cells a Rayleigh wave travels before a tip at rest counts as arrested


class Resistance(NamedTuple):
    """What a material sets against growth."""

    criterion: Any
    G_Ic: float  # J/m^2
    rayleigh: float  # Rayleigh wave speed (m/s)


@dataclass(frozen=True)
class Propagation:
    """How cracks grow."""

    resistance: dict  # of each material by name; a material without one does not break
    interfaces: dict  # toughness (J/m^2) of pairs of materials, by the set of both names
    speed: Any  # law
    piece: float  # m
    cracks: tuple  # whether each crack may grow
    direction: int = OWN
    toward: tuple = (1.0, 0.0)  # unit vector of the direction `given`
    fastest: float = 1.0  # share of the Rayleigh speed
    longest: float = inf  # m, of a whole crack
    begin: float = inf  # s: from then on a crack runs whatever its load
    steady: bool = False  # once begun a crack never stops

    def toughness_of(self, material: str) -> float:
        """Return the toughness of a material (J/m^2); inf if it does not break."""
        return self.resistance[material].G_Ic if material in self.resistance else inf

    def toughness_between(self, one: str, other: str) -> float:
        """Return the toughness along an interface (J/m^2): its own, or that of the weaker side."""
        weaker = min(self.toughness_of(one), self.toughness_of(other))
        return min(self.interfaces.get(frozenset((one, other)), inf), weaker)


def grow(model, state, scratch) -> list[dict]:
    """Let all tips grow for a step and return the rows of growth.csv that tell of it."""
    if model.propagation is None:
        return []
    rows = []
    for tip in tips_of(state.paths):
        still = state.paths.ends[tip.crack, tip.end] == TIP  # another tip may have ended on it
        if still and model.propagation.cracks[tip.crack]:
            rows += _grow_tip(model, state, scratch, _at_end(state.paths, tip))
    return rows


def blind_tips(model, state) -> list[str]:
    """Return the tips that can not begin to grow because nobody knows their load."""
    return [
        f"{model.crack_names[tip.crack]} {('start', 'end')[tip.end]}"
        for tip in tips_of(state.paths)
        if model.propagation.cracks[tip.crack] and state.growth.stage[line_of(tip)] == BLIND
    ]


def _at_end(paths, tip) -> Tip:
    """Return a tip with the numbers that its points have now."""
    points = np.arange(paths.start[tip.crack], paths.start[tip.crack + 1])
    return Tip(tip.crack, tip.end, points[::-1] if tip.end else points)


def _grow_tip(model, state, scratch, tip) -> list[dict]:
    growth, k = state.growth, line_of(tip)
    found = load_on(model, state, scratch, tip)
    growth.load[k], growth.stage[k], growth.reach[k] = found[:3], found.stage, found.reach
    if found.stage != HELD:
        growth.unseen[k] = 0.0
    resistance = model.propagation.resistance.get(found.site.block.material)
    if resistance is None or found.stage == BLIND:
        growth.speed[k], growth.running[k] = 0.0, 0
        return []
    load = _load_of(state.paths, tip, found)
    growth.speed[k] = _speed(model, state, tip, resistance, load)
    if growth.speed[k] > 0.0 and is_shut(model, state.paths, tip, found.site, load):
        growth.speed[k] = 0.0  # J of faces that lie in each other tells nothing, whatever is asked
    if growth.speed[k] <= 0.0:
        return _rest(model, state, tip, resistance)
    return _run(model, state, scratch, tip, found, load, resistance.criterion)


def _load_of(paths, tip, found) -> Load:
    gap = opening_near_tip(paths, tip.crack, tip.end)
    opening, sliding = open_and_slide(gap, found.site.frame.now)
    return Load(found.K_I, found.K_II, found.J, opening, sliding)


def _speed(model, state, tip, resistance, load) -> float:
    settings, growth, k = model.propagation, state.growth, line_of(tip)
    cost = float(growth.wall[k]) or resistance.G_Ic
    drive = resistance.criterion.drive(load)
    if growth.wall[k]:  # it goes where the interface lets it, not where it would by its criterion
        drive = sqrt(max(load.J, 0.0) / cost) if load.K_I > 0.0 else 0.0
    if load.J <= 0.0:  # no energy flows into the tip, whatever its K
        drive = 0.0
    begun = settings.steady and growth.running[k]
    if begun or state.time >= settings.begin - 0.5 * model.dt:
        drive = max(drive, 1.0)
    if crack_length(state.paths, tip.crack) >= settings.longest:
        return 0.0
    if growth.unseen[k] > UNSEEN * model.lattice.width:
        return 0.0
    release, width = load.J / cost, model.lattice.width
    pull = Pull(drive, release, float(growth.speed[k]), resistance.rayleigh, model.dt, width)
    return min(settings.speed.speed(pull), settings.fastest * resistance.rayleigh)


def _rest(model, state, tip, resistance) -> list[dict]:
    """Stay; a tip at rest for long enough is arrested, and begins anew with a new direction."""
    growth, k = state.growth, line_of(tip)
    growth.rested[k] += model.dt
    growth.taken[k] = 0.0
    arrest = ARREST * model.lattice.width / resistance.rayleigh
    if not growth.running[k] or growth.rested[k] < arrest:
        return []
    growth.running[k], growth.piece[k], growth.owed[k], growth.wall[k] = 0, inf, 0.0, 0.0
    growth.beside[k] = 0.0
    state.books.fracture[0] += lose_the_rest(growth, k)
    return [_row(model, state, tip, "arrest")]


def _run(model, state, scratch, tip, found, load, criterion) -> list[dict]:
    growth, k, rows = state.growth, line_of(tip), []
    growth.rested[k] = 0.0
    step = float(growth.speed[k]) * model.dt + float(growth.owed[k])
    begins = growth.piece[k] >= model.propagation.piece
    if begins and step < LEAST_MOVE * model.lattice.width:
        growth.owed[k] = step
        return []
    growth.owed[k], growth.running[k] = 0.0, 1
    now = found.site.frame.now
    if begins:
        now = _begin_piece(model, state, scratch, tip, found.site, load, criterion)
        tip = _at_end(state.paths, tip)
    heading = growth.heading[k]
    met = first_met(model, state, tip, now, step)
    before, after = (met.before, met.now) if met else (step * heading, step * np.array(now))
    move_end(state.paths, tip.crack, tip.end, before, after)
    reach = float(np.hypot(*before))
    if reach > 0.0:
        spread_over_way(growth, k, reach, model.geometry.thickness, model.lattice.width)
    for lengths in (growth.piece, growth.length, growth.kink, growth.unseen):
        lengths[k] += reach
    growth.mean[k] += reach * growth.load[k, 1:]
    if growth.kink[k] > max(LONG, USUAL) * model.lattice.width:
        growth.kink[k] = inf
    _book(model, state, tip, found, reach)
    if begins:
        rows.append(_row(model, state, tip, "growth"))
    if met:
        state.paths = join_met(state.paths, tip, met)
        scratch.segments = make_room(state.paths, scratch.segments, model.lattice.node_count)
        ended = [tip] if met.other is None else [tip, Tip(*met.other, tip.points)]
        return rows + [_end(model, state, one, PLAIN, "merge") for one in ended]
    stay_on_grid(model, state, tip)
    if has_left_body(model, found.site.cloud, state.paths.origin[tip.points[0]]):
        leave_body(model, state, tip, heading, now)
        rows.append(_end(model, state, tip, EDGE, "edge"))
    return rows


def _end(model, state, tip, what, kind) -> dict:
    """Make a tip an end that grows no more; return the row that tells of it."""
    state.paths.ends[tip.crack, tip.end] = what
    state.books.fracture[0] += lose_the_rest(state.growth, line_of(tip))
    state.growth.speed[line_of(tip)], state.growth.running[line_of(tip)] = 0.0, 0
    return _row(model, state, tip, kind)


def _begin_piece(model, state, scratch, tip, site, load, criterion) -> tuple:
    """Turn the tip and add a point for the piece that begins; return its direction now.

    A tip at rest may leave a corner. A running tip turns by the mean load on the way of its last
    piece (the load at one moment holds the waves that the passage of every node sends out), and
    within two cells, not at once: its domain sees the direction of the crack over that length, and
    a tip that turned by all of the angle in each piece would overshoot and run in a zigzag.
    """
    growth, k = state.growth, line_of(tip)
    heading = tuple(growth.heading[k].tolist())
    place = state.paths.origin[end_point(state.paths, tip.crack, tip.end)].copy()
    running = 0.0 < growth.piece[k] < inf
    if running:
        K_I, K_II = (growth.mean[k] / growth.piece[k]).tolist()
        load = load._replace(K_I=K_I, K_II=K_II)
    wanted = _wanted_turn(model, growth, k, load, criterion, heading)
    if running:
        wanted *= min(growth.piece[k] / (TURNING * model.lattice.width), 1.0)
    turn, growth.wall[k] = choose_course(model, site, place, heading, load, wanted)
    resolved = growth.kink[k] > LONG * model.lattice.width  # a corner before this one is far away
    if abs(turn) > CORNER and resolved and (turn != wanted or not running):
        growth.corner[k], growth.parent[k], growth.kink[k] = place, heading, 0.0
    growth.heading[k] = turned(heading, turn)
    growth.piece[k], growth.mean[k] = 0.0, 0.0
    state.paths = add_point(state.paths, tip.crack, tip.end)
    if model.cohesion is not None:
        cover_end(state.paths, tip.crack, tip.end, model.cohesion.grown)
    scratch.segments = make_room(state.paths, scratch.segments, model.lattice.node_count)
    return turned(site.frame.now, turn)


def _wanted_turn(model, growth, k, load, criterion, heading) -> float:
    """Return by what angle (rad) a tip would turn in one material."""
    settings = model.propagation
    if growth.stage[k] == HELD:
        return 0.0
    fixed = settings.toward if settings.direction == GIVEN else tuple(growth.initial[k])
    return turn_by(settings.direction, criterion, load, heading, fixed)


def _book(model, state, tip, found, step) -> None:
    """Write the energy that went into the new surface; half of it is that of an image."""
    k, share = line_of(tip), 0.5 if found.site.half else 1.0
    spent = share * found.J * step * model.geometry.thickness
    state.growth.energy[k] += spent
    state.growth.pending[k] += spent
    state.books.fracture[0] += lose(state.growth, k, spent, step, model.lattice.width)


def _row(model, state, tip, kind) -> dict:
    """Return a row of growth.csv with the energy spent since the last one of this tip."""
    growth, paths, k = state.growth, state.paths, line_of(tip)
    at = end_point(paths, tip.crack, tip.end)
    behind = paths.point[at - 1 if tip.end else at + 1]
    out = paths.point[at] - behind
    J, K_I, K_II = growth.load[k].tolist()
    energy, growth.pending[k] = float(growth.pending[k]), 0.0
    return {
        "step": state.step,
        "time": state.time,
        "crack": model.crack_names[tip.crack],
        "tip": ("start", "end")[tip.end],
        "kind": kind,
        "x": float(paths.point[at, 0]),
        "y": float(paths.point[at, 1]),
        "angle": atan2(out[1], out[0]),
        "length": crack_length(paths, tip.crack),
        "J": J,
        "K_I": K_I,
        "K_II": K_II,
        "energy": energy,
    }
