"""Mistakes between the growth of cracks and the rest of a deck."""

from collections.abc import Iterator
from math import acos, cos, degrees, hypot, radians
from typing import Any

from cramp_cli.deck.solids import AGREE
from cramp_cli.schema.section import Wrong, unknown

STEEPEST = cos(radians(120.0))  # of the angle by which a given direction may turn a tip
SHORTEST, LONGEST = 0.1, 1.0  # cells; length of the pieces by which a crack grows


def growth_mistakes(deck: Any) -> Iterator[Wrong]:
    """Yield toughness that is missing or contradicts itself, and cracks that can not grow.

    deck: one whose sections are right by themselves
    """
    yield from _contradictions(deck)
    yield from _wrong_interfaces(deck)
    if deck.propagation is None:
        return
    names = [crack.name for crack in deck.cracks]
    chosen = deck.propagation.cracks
    for place, name in enumerate(chosen or ()):
        if name not in names:
            yield ("propagation", "cracks", place), unknown("crack", name, names)
    growing = [c for c in deck.cracks if chosen is None or c.name in chosen]
    if not any("tip" in (crack.start, crack.end) for crack in growing):
        yield ("propagation",), "no crack that may grow has an end that is a tip"
    yield from _missing_toughness(deck, growing)
    yield from _backwards(deck, growing)
    piece, cell = deck.propagation.piece, deck.grid.cell
    if piece is not None and not SHORTEST * cell <= piece <= LONGEST * cell:
        share = piece / cell
        yield (
            ("propagation", "piece"),
            f"must be {SHORTEST:g} to {LONGEST:g} cells (got {share:.3g})",
        )


def _contradictions(deck) -> Iterator[Wrong]:
    for name, material in deck.materials.items():
        tough = material.toughness
        if tough is None or tough.K_Ic is None or tough.G_Ic is None:
            continue
        other = tough.K_Ic**2 / material.plane_modulus(deck.analysis)
        if abs(other / tough.G_Ic - 1.0) > AGREE:
            message = (
                f"does not agree with K_Ic, which gives {other:.5g} J/m^2 in {deck.analysis} "
                f"(got {tough.G_Ic:.5g}); give one of them"
            )
            yield ("materials", name, "toughness", "G_Ic"), message


def _wrong_interfaces(deck) -> Iterator[Wrong]:
    """Yield interfaces of materials that are not there, of one material, and given twice."""
    seen = set()
    for number, one in enumerate(deck.interfaces):
        path, pair = ("interfaces", number, "between"), frozenset(one.between)
        for place, name in enumerate(one.between):
            if name not in deck.materials:
                yield (*path, place), unknown("material", name, list(deck.materials))
        if len(pair) == 1:
            yield path, f"must name two materials (got {one.between[0]} twice)"
        if pair in seen:
            yield path, f"the interface of {' and '.join(one.between)} is given already; remove it"
        seen.add(pair)


def _missing_toughness(deck, growing) -> Iterator[Wrong]:
    """Yield what the materials around the tips lack for the criterion."""
    criterion, told = deck.propagation.criterion, set()
    if criterion == "steady_state" and deck.propagation.begin is not None:
        return
    for crack in growing:
        for kind, point in ((crack.start, crack.corners[0]), (crack.end, crack.corners[-1])):
            name = _material_at(deck, point) if kind == "tip" else None
            if name is None or name in told:
                continue
            told.add(name)
            tough = deck.materials[name].toughness
            lacks = ["toughness"] if tough is None else tough.lacks(criterion)
            if lacks:
                path = ("materials", name) + (("toughness",) if tough else ())
                needed = f"criterion: {criterion} needs it at the tip of crack {crack.name}"
                yield path, f"has no {' and no '.join(lacks)}; {needed}"


def _backwards(deck, growing) -> Iterator[Wrong]:
    """Yield a given direction that would lead a tip back along its own crack."""
    toward = deck.propagation.toward
    if toward is None:
        return
    for crack in growing:
        corners = crack.corners
        for kind, tip, inwards in (
            (crack.start, corners[0], corners[1]),
            (crack.end, corners[-1], corners[-2]),
        ):
            out = (tip[0] - inwards[0], tip[1] - inwards[1])
            share = (out[0] * toward[0] + out[1] * toward[1]) / (hypot(*out) * hypot(*toward))
            if kind == "tip" and share < STEEPEST:
                angle = degrees(acos(max(share, -1.0)))
                message = (
                    f"turns the tip of crack {crack.name} by {angle:.0f} degrees, back beside its "
                    f"own faces; at most {degrees(acos(STEEPEST)):.0f} degrees, or leave this "
                    "crack out of propagation.cracks"
                )
                yield ("propagation", "toward"), message


def _material_at(deck, point) -> str | None:
    """Return the material of the body at a point (m), or None."""
    import numpy as np

    spot = np.array([point])
    owner = None
    for body in deck.bodies:
        if body.shape.contains(spot)[0]:
            owner = None if body.hole else body.material
    return owner
