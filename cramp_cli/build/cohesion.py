"""From the `traction` sections of a deck to traction laws with numbers, and to the crack points."""

from functools import singledispatch
from math import inf

import numpy as np

from cramp_cli.build.covered import CLOSE, covered_spans, distances
from cramp_cli.cohesive.cubic import Cubic
from cramp_cli.cohesive.elastic import Elastic
from cramp_cli.cohesive.exponential import Exponential
from cramp_cli.cohesive.law import stiffest
from cramp_cli.cohesive.modes import Modes
from cramp_cli.cohesive.pressure import Pressure
from cramp_cli.cohesive.triangular import Triangular
from cramp_cli.cohesive.trilinear import Trilinear
from cramp_cli.cracks.cohesion import Cohesion
from cramp_cli.deck import cohesive as deck
from cramp_cli.deck.deck import DeckError

SWINGS = 8.0  # k/(rho h) that a step must bear beside the waves; steps of all of it hold, measured


def build_cohesion(description, paths) -> Cohesion | None:
    """Return the traction laws of a deck and tell the crack points; None if there are none."""
    sections = []
    for number, crack in enumerate(description.cracks):
        if crack.traction is not None:
            _cover(description, paths, number, len(sections))
            sections.append(crack.traction)
    growth, grown = description.propagation, -1
    if growth is not None and growth.traction is not None:
        grown = len(sections)
        sections.append(growth.traction)
    if not sections:
        return None
    laws = tuple(traction_law(section) for section in sections)
    return Cohesion(laws, tuple(getattr(section, "in_time", None) for section in sections), grown)


def _cover(description, paths, number, law) -> None:
    """Give the points of a crack where its law acts the number of that law."""
    crack, points = description.cracks[number], paths.crack(number)
    along, slack = distances(paths.origin[points]), CLOSE * crack.segment
    if description.contact_of(crack).law == "glued":
        message = "must not be given for faces that are glued: they never part"
        raise DeckError([description.mistake(("cracks", number, "traction"), message)])
    covered = np.zeros(len(along), dtype=bool)
    for low, high in covered_spans(description, crack):
        covered |= (along >= low - slack) & (along <= high + slack)
    if not covered.any():
        message = "covers no part of the crack that is inside a body"
        raise DeckError([description.mistake(("cracks", number, "traction_along"), message)])
    paths.law[points] = np.where(covered, law, -1)


def stiffness_rate(description) -> float:
    """Return the square of the rate that steps must bear for the stiffest faces (1/s^2).

    A crack on a line of nodes: the nodes of either side have half a cell of mass rho h^2/2, the
    faces a stiffness k h, so omega^2 = 4 k/(rho h). Midway between two lines the nearer have an
    eighth of a cell, omega^2 = 4.6 k/(rho h), and the faces move by the velocities of rows, which
    react more than particles do: it swings up where the step is above 2/omega of 11 k/(rho h).
    """
    growth = description.propagation
    sections = [crack.traction for crack in description.cracks]
    sections += [growth.traction] if growth is not None else []
    k = max((stiffest(traction_law(one)) for one in sections if one is not None), default=0.0)
    used = {body.material for body in description.bodies if body.material}
    lightest = min(description.materials[name].density for name in used)
    return SWINGS * k / (lightest * description.grid.cell)


@singledispatch
def traction_law(section):
    """Return the record of the law that a `traction` section describes."""
    raise TypeError(f"no traction law for {type(section).__name__}")


@traction_law.register
def _(section: deck.ElasticTractionSection):
    shear = section.normal if section.shear is None else section.shear
    return Elastic(Modes((section.normal, shear), (inf, inf), (inf, inf), 1.0))


@traction_law.register
def _(section: deck.TriangularSection):
    return Triangular(_modes(section, lambda mode: mode.numbers(section.fullness)))


@traction_law.register
def _(section: deck.ExponentialSection):
    modes = _modes(section, lambda mode: mode.numbers(section.fullness))
    return Exponential(modes, section.decay)


@traction_law.register
def _(section: deck.CubicSection):
    return Cubic(_modes(section, _cubic_numbers))


@traction_law.register
def _(section: deck.TrilinearSection):
    knees = [_knee(mode) for mode in (section.normal, section.shear or section.normal)]
    stress, place = zip(*knees, strict=True)
    return Trilinear(_modes(section, _trilinear_numbers), stress, place)


@traction_law.register
def _(section: deck.PressureSection):
    return Pressure(section.value)


def _modes(section, numbers) -> Modes:
    """Return both modes; numbers: gives stiffness, peak and toughness of one."""
    both = (section.normal, section.shear or section.normal)
    return Modes(*zip(*map(numbers, both), strict=True), section.power)


def _cubic_numbers(mode) -> tuple[float, float, float]:
    s, G, d = mode.peak, mode.toughness, mode.opening
    s = 16.0 * G / (9.0 * d) if s is None else s
    d = 16.0 * G / (9.0 * s) if d is None else d
    return 27.0 * s / (4.0 * d), s, 9.0 / 16.0 * s * d


def _trilinear_numbers(mode) -> tuple[float, float, float]:
    (first, second, end), (peak, knee) = mode.openings, mode.stresses
    return peak / first, peak, 0.5 * (peak * second + knee * (end - first))


def _knee(mode) -> tuple[float, float]:
    """Return the stress of the knee over the peak, and its place between peak and end."""
    (first, second, end), (peak, knee) = mode.openings, mode.stresses
    return knee / peak, (second - first) / (end - first)
