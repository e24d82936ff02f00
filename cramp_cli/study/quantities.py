"""How numbers in SI are shown: with the prefix that people use, and a label for an axis."""

from typing import NamedTuple

import numpy as np

PREFIXES = {1e9: "G", 1e6: "M", 1e3: "k", 1.0: "", 1e-3: "m", 1e-6: "µ", 1e-9: "n"}
LEAST = {"s": 0.2, "Pa*m^0.5": 0.05}  # smallest number shown with a prefix; others 1
SHOWN = {
    "Pa*m^0.5": "Pa√m",
    "J/m^2": "J/m²",
    "N*s": "N·s",
    "m/s^2": "m/s²",
    "rad": "rad",
}
PLAIN = {"", "1", "rad"}  # take no prefix


class Scale(NamedTuple):
    """What numbers in SI are divided by, and the unit they then have."""

    size: float
    unit: str  # "" for a pure number


def scale_for(unit: str, *values) -> Scale:
    """Return the scale that shows arrays of one SI unit with few digits."""
    shown = SHOWN.get(unit, unit)
    if unit in PLAIN:
        return Scale(1.0, "" if unit == "1" else shown)
    largest = max(float(np.abs(v[np.isfinite(v)]).max(initial=0.0)) for v in map(_array, values))
    least = LEAST.get(unit, 1.0)
    fitting = [size for size in PREFIXES if largest >= least * size * (1.0 - 1e-9)]
    size = fitting[0] if fitting else (1.0 if largest == 0.0 else min(PREFIXES))
    return Scale(size, PREFIXES[size] + shown)


def _array(values) -> np.ndarray:
    return np.asarray(values, dtype=float)


def label(name: str, scale: Scale) -> str:
    """Return the label of an axis: name and unit."""
    return f"{name} ({scale.unit})" if scale.unit else name
