"""What crack points do under a traction law: they part, draw each other back, and suffer."""

from typing import NamedTuple

import numpy as np

from cramp_cli.cohesive.law import respond, stored
from cramp_cli.cracks.carry import give_back
from cramp_cli.cracks.view import look_from, side_normal
from cramp_cli.numerics.kernel import kernel


class Faces(NamedTuple):
    """What every crack point stands for."""

    crack: np.ndarray  # (points,)
    normal: np.ndarray  # (points, 2) unit normal that points above
    length: np.ndarray  # (points,) of undeformed crack that carries a law, m


def lay_out_faces(paths) -> Faces:
    """Return what the points of all cracks stand for now."""
    n = len(paths.point)
    faces = Faces(np.zeros(n, dtype=np.int64), np.zeros((n, 2)), np.zeros(n))
    fill_faces(faces, paths)
    return faces


@kernel
def fill_faces(faces, paths):
    """Fill in what the points of all cracks stand for.

    The length of a point is half of the pieces beside it, of those with a law at both ends.
    """
    law, X = paths.law, paths.origin
    faces.length[:] = 0.0
    for c in range(len(paths.start) - 1):
        first, last = paths.start[c], paths.start[c + 1] - 1
        for k in range(first, last + 1):
            n = side_normal(paths.point, k, first, last)
            faces.crack[k], faces.normal[k, 0], faces.normal[k, 1] = c, n[0], n[1]
            if k < last and law[k] >= 0 and law[k + 1] >= 0:
                piece = np.hypot(X[k + 1, 0] - X[k, 0], X[k + 1, 1] - X[k, 1])
                faces.length[k] += 0.5 * piece
                faces.length[k + 1] += 0.5 * piece


@kernel
def separation(paths, normal, k, ahead):
    """Return opening and sliding of the faces at point k (m), carried on by a time `ahead` (s).

    normal: of Faces; sliding is positive where the upper face goes ahead
    """
    above, below, up, down = paths.above, paths.below, paths.above_velocity, paths.below_velocity
    gx = above[k, 0] - below[k, 0] + ahead * (up[k, 0] - down[k, 0])
    gy = above[k, 1] - below[k, 1] + ahead * (up[k, 1] - down[k, 1])
    return gx * normal[k, 0] + gy * normal[k, 1], gx * normal[k, 1] - gy * normal[k, 0]


@kernel
def pull_points(traction, paths, normal, law, number, ahead, suffers):
    """Set the stress vector with which the upper face draws the lower one, where a law acts.

    traction: (points, 2), Pa; ahead: as in `separation`; suffers: whether damage is kept
    """
    damage, spent = paths.damage, paths.spent
    for k in range(len(damage)):
        if paths.law[k] != number:
            continue
        opening, sliding = separation(paths, normal, k, ahead)
        t_n, t_t, grown, opened, slid = respond(law, opening, sliding, damage[k])
        traction[k, 0] = t_n * normal[k, 0] + t_t * normal[k, 1]
        traction[k, 1] = t_n * normal[k, 1] - t_t * normal[k, 0]
        if suffers:
            damage[k] = grown
            spent[k, 0] += opened
            spent[k, 1] += slid


@kernel
def spread(force, up, down, traction, paths, faces, cut, mass, solid, place, thickness):
    """Add the tractions to the forces of the rows, equal and opposite on both sides.

    cut, mass, solid, place: as in `look_from` (view.py), cut for every point
    up, down: room for what the two surfaces of a point see; where one of them sees no solid the
    point gives no force, and its traction is set to zero
    """
    for k in range(len(cut)):
        if traction[k, 0] == 0.0 and traction[k, 1] == 0.0:
            continue
        crack, n = faces.crack[k], (faces.normal[k, 0], faces.normal[k, 1])
        about = (cut[k], mass, solid, place)
        over, weight_up = look_from(up, True, paths, k, crack, 1, n, *about)
        under, weight_down = look_from(down, True, paths, k, crack, -1, n, *about)
        if weight_up <= 0.0 or weight_down <= 0.0:
            traction[k, 0] = traction[k, 1] = 0.0
            continue
        area = thickness * faces.length[k]
        fx, fy = area * traction[k, 0], area * traction[k, 1]
        give_back(force, up, over, -fx, -fy)
        give_back(force, down, under, fx, fy)


@kernel
def sum_stored(paths, faces, law, number):
    """Return the energy per thickness that the faces of a law would give back (J/m)."""
    total = 0.0
    for k in range(len(paths.law)):
        if paths.law[k] == number:
            opening, sliding = separation(paths, faces.normal, k, 0.0)
            total += stored(law, opening, sliding, paths.damage[k]) * faces.length[k]
    return total
