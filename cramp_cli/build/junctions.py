"""Where cracks meet: their lines get a common point there, however the deck writes them.

A junction is where an end of a crack lies on another crack, on its end or between its ends, or
where a corner of one lies on another. Cracks that cross each other need none: crossings are told
apart crack by crack (docs/theory/cracks.md).
"""

import numpy as np

from cramp_cli.deck.ends import MEETS

SNAP = 0.02  # cells; a point of a line this near to a junction is moved onto it
BENT = 1e-6  # rad; a smaller turn is no corner


def join(lines, cracks, groups, width):
    """Return the lines of cracks with common points at junctions, and the junction of each point.

    lines: of the cracks, m; cracks: their sections; groups: contact group of each
    returns: lines, and (points,) the number of the junction at every point of all, -1 for none
    """
    places = _places(lines, cracks, groups, MEETS * width)
    lines = [np.array(line, dtype=float) for line in lines]
    joints = [np.full(len(line), -1, dtype=np.int64) for line in lines]
    for number, (place, group) in enumerate(places):
        for c, line in enumerate(lines):
            if groups[c] == group:
                lines[c], at = _with_point(line, joints[c], place, width)
                if len(lines[c]) > len(line):
                    joints[c] = np.insert(joints[c], at, -1)
                if at >= 0:
                    joints[c][at] = number
    return lines, np.concatenate(joints) if joints else np.zeros(0, dtype=np.int64)


def _places(lines, cracks, groups, near) -> list:
    """Return place (m) and contact group of every junction; those that are near are one."""
    found = []
    for c, crack in enumerate(cracks):
        spots = [lines[c][k] for key, k in (("start", 0), ("end", -1))
                 if getattr(crack, key) in ("junction", "plain")]  # fmt: skip
        spots += [corner for corner in crack.corners[1:-1] if crack.arc is None]
        for spot in spots:
            others = [
                o for o in range(len(lines)) if o != c and groups[o] == groups[c]
                and _foot(lines[o], np.asarray(spot))[0] <= near
            ]  # fmt: skip
            if not others and not _closes(lines[c], spot, near):
                continue
            place = _anchor(np.asarray(spot), [lines[o] for o in others], near)
            known = any(g == groups[c] and np.hypot(*(p - place)) <= 2.0 * near for p, g in found)
            if not known:
                found.append((place, groups[c]))
    return found


def _closes(line, spot, near) -> bool:
    """Return whether a crack ends where it begins, at a place."""
    ends = np.hypot(*(line[[0, -1]] - spot).T)
    return bool(np.all(ends <= near))


def _anchor(spot, others, near):
    """Return the end of another crack that is near a place, else the place on the first of them."""
    for line in others:
        for end in (line[0], line[-1]):
            if np.hypot(*(end - spot)) <= near:
                return end.copy()
    return _foot(others[0], spot)[1] if others else spot.copy()


def _foot(line, spot):
    """Return distance (m), place, piece and share of the point of a polyline nearest to a place."""
    a, edge = line[:-1], np.diff(line, axis=0)
    share = np.sum((spot - a) * edge, axis=1) / np.sum(edge * edge, axis=1)
    share = np.clip(share, 0.0, 1.0)
    there = a + share[:, None] * edge
    away = np.hypot(*(there - spot).T)
    piece = int(np.argmin(away))
    return float(away[piece]), there[piece], piece, float(share[piece])


def _with_point(line, joint, place, width):
    """Return a line with a point at a place if it passes there, and the number of that point or -1.

    An end is moved there, and what little a line overshoots is cut off.
    """
    away, _, piece, share = _foot(line, place)
    if away > MEETS * width:
        return line, -1
    line = line.copy()
    k = piece + round(share)
    for end in (0, len(line) - 1):
        if np.hypot(*(line[end] - place)) <= MEETS * width:
            k = end
    free = joint[k] < 0 and (k in (0, len(line) - 1) or _is_at(line, k, place, width))
    if free:
        line[k] = place
        return line, k
    return np.insert(line, piece + 1, place, axis=0), piece + 1


def _is_at(line, k, place, width) -> bool:
    return bool(np.hypot(*(line[k] - place)) <= SNAP * width)
