"""From the text of a quantity, such as '1.5 MPa*m^0.5', to an exact number and its base units.

Only the names of units are given to pint, one at a time and never as an expression, so that no text
of a deck is evaluated. Numbers stay fractions until the end: '2.4 mm' becomes the float 0.0024.
"""

import difflib
import re
from fractions import Fraction
from functools import lru_cache
from importlib.metadata import version

from cramp_cli.numerics.cache import cache_root, recall, remember

COMMON = (
    *("m", "mm", "um", "nm", "cm", "km", "in", "ft", "s", "ms", "us", "ns", "min", "h"),
    *("kg", "g", "t", "lb", "N", "kN", "MN", "lbf", "Pa", "kPa", "MPa", "GPa", "psi", "ksi", "bar"),
    *("J", "kJ", "mJ", "Hz", "kHz", "MHz", "rad", "deg", "mrad", "rpm"),
)
LONGEST = 80  # characters of a quantity
NUMBER = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,3})?)\s*(.*?)\s*", re.ASCII)
FACTOR = re.compile(
    r"\s*(?P<sign>[*/]?)\s*(?:(?P<name>[^\W\d]+|°)(?:(?:\^|\*\*)?(?P<power>-?\d{1,2}(?:\.\d{1,3})?))?"
    r"|1(?=\s*/))"
)
REWRITTEN = (
    (re.compile(r"sqrt\((\w+)\)|√(\w+)"), r" \1\2^0.5"),
    (re.compile(r"\(1/2\)"), "0.5"),
    (re.compile(r"\((-?[\d.]+)\)"), r"\1"),
    (re.compile("²"), "^2"),
    (re.compile("³"), "^3"),
    (re.compile("[·⋅]"), "*"),
)


class UnitError(ValueError):
    """A text that is no quantity, with the reason."""


def split(text: str) -> tuple[Fraction, str]:
    """Return the number at the start of a text and the unit behind it (may be empty)."""
    found = NUMBER.fullmatch(text) if len(text) <= LONGEST else None
    if found is None:
        raise UnitError("it does not start with a number")
    return Fraction(found[1]), found[2]


@lru_cache(maxsize=256)
def base_units(unit: str) -> tuple[float | Fraction, dict[str, float]]:
    """Return the factor to base units (m, kg, s, radian ...) and the power of each of them."""
    if unit.startswith(","):
        raise UnitError("the decimal sign is a point")
    for pattern, replacement in REWRITTEN:
        unit = pattern.sub(replacement, unit)
    scale, powers, place = Fraction(1), {}, 0
    while place < len(unit):
        found = FACTOR.match(unit, place)
        if found is None:
            raise UnitError(f"unit '{unit[place:].strip()}' cannot be read")
        place = found.end()
        if found["name"]:
            power = Fraction(found["power"] or 1) * (-1 if found["sign"] == "/" else 1)
            scale *= _multiply(powers, found["name"], power)
    return scale, {name: power for name, power in powers.items() if abs(power) > 1e-9}


def _multiply(powers: dict[str, float], name: str, power: Fraction) -> float | Fraction:
    """Multiply `powers` by a named unit; return the factor that this brings."""
    scale, bases = _named(name)
    for base, exponent in bases.items():
        powers[base] = powers.get(base, 0.0) + float(exponent * power)
    return scale ** (int(power) if power.denominator == 1 else float(power))


@lru_cache(maxsize=256)
def _named(name: str) -> tuple[Fraction, dict[str, float]]:
    """Return factor and base units of a name, from pint or from what it said in an earlier run."""
    store = f"units-{version('pint')}"
    known = recall(store)
    if name not in known:
        scale, powers = _looked_up(name)
        remember(store, known | {name: [str(scale), powers]})
        return scale, powers
    scale, powers = known[name]
    return Fraction(scale), powers


def _looked_up(name: str) -> tuple[Fraction, dict[str, float]]:
    import pint  # late: 0.5 s, and most decks have units that it has told before

    try:
        scale, bases = _registry().get_base_units(name)
    except (pint.PintError, AttributeError, ArithmeticError):
        close = difflib.get_close_matches(name, COMMON, n=1, cutoff=0.6)
        close = close or [known for known in COMMON if known.lower() == name.lower()]
        hint = f"; did you mean '{close[0]}'?" if close else ""
        raise UnitError(f"unknown unit '{name}'{hint}") from None
    return Fraction(scale), {str(base): float(power) for base, power in bases._units.items()}


@lru_cache(maxsize=1)
def _registry():
    """Return the units known to pint; kept on disk once read, which saves half of their start."""
    import pint

    folder = cache_root() / "units"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        return pint.UnitRegistry(non_int_type=Fraction, cache_folder=folder)
    except OSError:
        return pint.UnitRegistry(non_int_type=Fraction)
