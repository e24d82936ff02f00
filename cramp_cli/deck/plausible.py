"""Numbers that are possible but hardly meant: mostly a unit that was left out.

The bounds lie far outside what solids have, so that a deck in units of its own is left alone: a
number counts as odd only beside others that are those of a solid in SI.
"""

from collections.abc import Iterator
from typing import Any

from cramp_cli.schema.curve import Ramp
from cramp_cli.schema.section import Wrong

SOFTEST, STIFF = 1e3, 1e6  # Pa: no solid is softer, most are stiffer
LIGHTEST, HEAVY = 10.0, 100.0  # kg/m^3: aerogels; wood
BRITTLEST = 1e3  # Pa m^0.5; glue of gels
FEWEST = 4  # cells along the longer side of a body
FASTEST = 1e8  # 1/s, of damping: gone within a step of any grid


def plausible_warnings(deck: Any) -> Iterator[Wrong]:
    """Yield odd numbers with the unit that was likely meant; deck: without mistakes."""
    for name, material in deck.materials.items():
        for key, message in _odd_material(material):
            yield ("materials", name, *key), message
    for key in ("grid", "particle"):
        rate = getattr(deck.solver.damping, key, 0.0)  # `auto` is no section
        if rate >= FASTEST:
            message = f"{rate:g} 1/s stops all motion within {1.0 / rate:.2g} s"
            yield ("solver", "damping", key), f"{message}; 1/ms or 1/s may be meant"
    yield from _coarse_bodies(deck)
    yield from _late_ramps(deck)


def _odd_material(material: Any) -> Iterator[Wrong]:
    young, density = getattr(material, "E", None), material.density
    if young is not None and young < SOFTEST and density >= HEAVY:
        yield ("E",), f"{young:g} Pa is softer than any solid; {young:g} GPa or MPa may be meant"
    if young is not None and young >= STIFF and density < LIGHTEST:
        message = f"{density:g} kg/m^3 is lighter than any solid"
        yield ("density",), f"{message}; {density:g} g/cm^3 may be meant"
    tough = getattr(material, "toughness", None)
    if tough is None or young is None or young < STIFF:
        return
    for key in ("K_Ic", "K_IIc"):
        value = getattr(tough, key)
        if value is not None and value < BRITTLEST:
            message = f"{value:g} Pa*m^0.5 is less than any solid has"
            yield ("toughness", key), f"{message}; {value:g} MPa*m^0.5 may be meant"


def _coarse_bodies(deck: Any) -> Iterator[Wrong]:
    """Yield bodies that are hardly larger than a cell."""
    for place, body in enumerate(deck.bodies):
        cells = longest(body) / deck.grid.cell
        if cells < FEWEST and not (body.hole or body.rigid):
            message = f"is {cells:.3g} cells long, too few for any stress"
            yield ("bodies", place, "shape"), f"{message}; a smaller grid.cell may be meant"


def longest(body: Any) -> float:
    """Return the longer side of the box around a body (m)."""
    return max(b - a for a, b in zip(*body.shape.bounds(), strict=True))


def _late_ramps(deck: Any) -> Iterator[Wrong]:
    """Yield ramps that the run does not see the end of."""
    end = deck.solver.end_time
    for kind in ("loads", "boundary"):
        for place, section in enumerate(getattr(deck, kind)):
            curve = section.in_time
            if isinstance(curve, Ramp) and curve.until > end * (1.0 + 1e-9):
                message = f"{curve.until:g} s is after the end of the run ({end:g} s)"
                yield (kind, place, "in_time", "until"), f"{message}: only a part of the ramp acts"
