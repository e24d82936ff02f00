"""The circle that a crack follows near its tip.

The direction of a tip and the curvature there come from the way of several cells, not from the last
segment: that is a chord of an arc, and of a digitised line mostly noise. A straight crack keeps its
direction to the last bit.
"""

from typing import NamedTuple

import numpy as np

FINE = 0.125  # samples of the line lie this far apart (cells)
CHORD = 1.0  # length over which its direction counts (cells)
BEND = 0.17  # a crack that leaves the direction of the circle by more than this (rad) ends it
ASIDE = 0.1  # so does one that leaves the circle by more than this (cells)
LEAST = 2.5  # a circle is fitted to this way at the least (cells)
STRAIGHT = 1e-7  # a line that leaves its tangent by less than this is straight (cells)
TIGHT = 0.5  # the circle is no tighter than this over the way, in 1 over its radius


class Curve(NamedTuple):
    """The circle through a tip."""

    direction: tuple  # unit vector out of the crack
    bend: float  # curvature on the way out of the crack, positive to the left (1/m)
    length: float  # the crack follows it so far from the tip (m); inf: to its end


def curve_at(line, width, reach) -> Curve:
    """Return the circle that a crack follows from its tip, up to `reach` (m) or less.

    line: points of the crack from the tip inwards (n, 2), m
    """
    behind = line[0] - line[1]
    direction = behind / np.hypot(*behind)
    places = _samples(line, FINE * width, reach + CHORD * width)
    away = (places - places[0]) @ np.array([direction, (-direction[1], direction[0])]).T
    if np.abs(away[:, 1]).max() < STRAIGHT * width:
        return Curve(tuple(direction.tolist()), 0.0, np.inf)
    until = reach
    while True:
        slope, bend = _fitted(away[: _count(until, width)], until)
        good = _followed(away, slope, bend, width)
        if good >= until or until <= LEAST * width:
            break
        until = max(min(good, until - FINE * width), LEAST * width)
    turn = np.array([[1.0, -slope], [slope, 1.0]]) / np.hypot(1.0, slope)
    ex, ey = np.array([direction, (-direction[1], direction[0])]).T @ turn[:, 0]
    return Curve((float(ex), float(ey)), float(bend), float(good))


def _samples(line, step, length):
    """Return places along a polyline, `step` apart (m), up to `length` from its beginning."""
    way = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
    at = np.arange(0.0, min(length, way[-1]) + 1e-9 * step, step)
    return np.stack([np.interp(at, way, line[:, d]) for d in range(2)], axis=1)


def _count(length, width) -> int:
    """Return the number of samples up to a length (m)."""
    return int(length / (FINE * width) + 1e-9) + 1


def _fitted(away, length):
    """Return slope of the tangent and curvature of the circle through the origin (least squares).

    With the tangent (1, b) the circle is y - b x = c (x^2 + y^2): curvature 2 c/sqrt(1 + b^2).

    away: places (n, 2), m
    """
    x, y = away.T
    columns = np.stack([x, (x * x + y * y) / length], axis=1)
    (slope, c), *_ = np.linalg.lstsq(columns, y, rcond=None)
    return slope, 2.0 * c / length / np.hypot(1.0, slope)


def _followed(away, slope, bend, width) -> float:
    """Return the way (m) up to which places follow a circle; inf: all of them."""
    x, y = away.T
    size = np.hypot(1.0, slope)
    along, across = (x + slope * y) / size, (y - slope * x) / size
    radii = np.hypot(bend * along, 1.0 - bend * across)  # from the centre
    aside = (2.0 * across - bend * (along**2 + across**2)) / (1.0 + radii)
    half = round(0.5 * CHORD / FINE)
    chord = away[2 * half :] - away[: -2 * half]
    middle = slice(half, len(away) - half)
    tangent = np.arctan2(slope, 1.0) + np.arctan2(bend * along, 1.0 - bend * across)[middle]
    turned = np.angle(np.exp(1j * (np.arctan2(-chord[:, 1], -chord[:, 0]) - tangent)))
    off = np.abs(aside) > ASIDE * width
    off[middle] |= np.abs(turned) > BEND
    off |= FINE * width * np.arange(len(away)) * abs(bend) > TIGHT
    return float(np.argmax(off) * FINE * width) if off.any() else np.inf
