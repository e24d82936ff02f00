"""Where a crack goes: by its criterion, or by a rule of the deck."""

from math import atan2, cos, sin

from cramp_cli.cracks.criteria.load import Load

OWN, SELF_SIMILAR, NORMAL_TO_COD, INITIAL, GIVEN = range(5)
DIRECTIONS = {
    "own": OWN,
    "self_similar": SELF_SIMILAR,
    "normal_to_cod": NORMAL_TO_COD,
    "initial": INITIAL,
    "given": GIVEN,
}


def normal_to_cod(load: Load) -> float:
    """Return the angle (rad) of the normal to the motion of the faces past each other."""
    return atan2(-load.sliding, load.opening) if load.opening or load.sliding else 0.0


def turn_to(wanted: tuple, now: tuple) -> float:
    """Return the angle (rad) from the unit vector `now` to the unit vector `wanted`."""
    return atan2(now[0] * wanted[1] - now[1] * wanted[0], now[0] * wanted[0] + now[1] * wanted[1])


def turn_by(rule: int, criterion, load: Load, heading: tuple, fixed: tuple) -> float:
    """Return by what angle (rad, left positive) a tip turns before it goes on.

    rule: one of the numbers above; heading: unit vector out of the crack; fixed: unit vector of
    `initial` and `given`
    """
    if rule == OWN:
        return criterion.direction(load)
    if rule == NORMAL_TO_COD:
        return normal_to_cod(load)
    return 0.0 if rule == SELF_SIMILAR else turn_to(fixed, heading)


def turned(vector, angle) -> tuple:
    """Return a vector turned to the left by an angle (rad)."""
    c, s = cos(angle), sin(angle)
    return c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]
