"""Forces between the faces of a crack, and what they take (docs/theory/cohesive.md).

The crack points carry the traction laws. The opening of a point is that of its two surfaces; the
force of its share of the crack goes to the rows of its upper and of its lower side, one the
opposite of the other, with the very weights with which the surfaces move (advect.py): the force
works on the motion of the surface and on nothing else.
"""

from dataclasses import dataclass

import numpy as np

from cramp_cli.cohesive.law import respond, stored
from cramp_cli.cohesive.pressure import Pressure
from cramp_cli.cracks.advect import OFF_PLANE, look_around, make_seen, side_normal
from cramp_cli.cracks.fields import cut_of_points
from cramp_cli.numerics.kernel import kernel


@dataclass(frozen=True)
class Cohesion:
    """The traction laws of a model."""

    laws: tuple  # records, by number
    curves: tuple  # what each pressure is multiplied by over time; None for other laws
    grown: int = -1  # number of the law behind growing tips; -1: that of the end of the crack

    def at(self, time: float) -> list:
        """Return the laws as they are at a time (s)."""
        return [
            law if curve is None else law._replace(value=law.value * curve.value(time))
            for law, curve in zip(self.laws, self.curves, strict=True)
        ]


@kernel
def separation(paths, k, n, ahead):
    """Return opening and sliding of the faces at point k (m), carried on by a time `ahead` (s).

    n: unit normal of the crack there; sliding is positive where the upper face goes ahead
    """
    above, below, up, down = paths.above, paths.below, paths.above_velocity, paths.below_velocity
    gx = above[k, 0] - below[k, 0] + ahead * (up[k, 0] - down[k, 0])
    gy = above[k, 1] - below[k, 1] + ahead * (up[k, 1] - down[k, 1])
    return gx * n[0] + gy * n[1], gx * n[1] - gy * n[0]


@kernel
def share_of_crack(paths, k, first, last):
    """Return the length of undeformed crack that point k stands for (m).

    It is half of the pieces beside the point, of those that carry a law at both ends.
    """
    length, law, X = 0.0, paths.law, paths.origin
    for other in (k - 1, k + 1):
        if first <= other <= last and law[other] >= 0:
            length += 0.5 * np.hypot(X[other, 0] - X[k, 0], X[other, 1] - X[k, 1])
    return length


@kernel
def pull_points(traction, paths, law, number, ahead, suffers):
    """Set the stress vector with which the upper face draws the lower one, where a law acts.

    traction: (points, 2), Pa; ahead: as in `separation`; suffers: whether damage is kept
    """
    damage, spent = paths.damage, paths.spent
    for c in range(len(paths.start) - 1):
        first, last = paths.start[c], paths.start[c + 1] - 1
        for k in range(first, last + 1):
            if paths.law[k] != number:
                continue
            n = side_normal(paths.point, k, first, last)
            normal, sliding = separation(paths, k, n, ahead)
            t_n, t_t, grown, opened, slid = respond(law, normal, sliding, damage[k])
            traction[k, 0] = t_n * n[0] + t_t * n[1]
            traction[k, 1] = t_n * n[1] - t_t * n[0]
            if suffers:
                damage[k] = grown
                spent[k, 0] += opened
                spent[k, 1] += slid


@kernel
def spread(
    force, up, down, traction, paths, cut, mass, rows, segments, of_crack, thickness,
    cells, width, lower, strides,
):  # fmt: skip
    """Add the tractions to the forces of the rows, equal and opposite on both sides.

    up, down: room for what the two surfaces of a point see; where one of them sees no solid the
    point gives no force, and its traction is set to zero
    """
    for c in range(len(paths.start) - 1):
        first, last = paths.start[c], paths.start[c + 1] - 1
        for k in range(first, last + 1):
            if traction[k, 0] == 0.0 and traction[k, 1] == 0.0:
                continue
            n, off = side_normal(paths.point, k, first, last), OFF_PLANE * width
            x, y = paths.point[k, 0], paths.point[k, 1]
            above = (paths.above[k, 0], paths.above[k, 1])
            below = (paths.below[k, 0], paths.below[k, 1])
            over, under = (x + off * n[0], y + off * n[1]), (x - off * n[0], y - off * n[1])
            grid, place = (mass, rows, segments, of_crack, c), (cells, width, lower, strides)
            count_up, total_up = look_around(up, True, *grid, 1, cut[k], over, above, *place)
            count_down, total_down = look_around(
                down, True, *grid, -1, cut[k], under, below, *place
            )
            if total_up <= 0.0 or total_down <= 0.0:
                traction[k, 0] = traction[k, 1] = 0.0
                continue
            area = thickness * share_of_crack(paths, k, first, last)
            give(force, up, count_up, traction, k, -area / total_up)
            give(force, down, count_down, traction, k, area / total_down)


@kernel
def give(force, seen, count, traction, k, factor):
    """Add the traction of point k times a factor to the rows that a surface sees."""
    for e in range(count):
        force[seen.row[e], 0] += factor * seen.weight[e] * traction[k, 0]
        force[seen.row[e], 1] += factor * seen.weight[e] * traction[k, 1]


@kernel
def sum_stored(paths, law, number):
    """Return the energy per thickness that the faces of a law would give back (J/m)."""
    total = 0.0
    for c in range(len(paths.start) - 1):
        first, last = paths.start[c], paths.start[c + 1] - 1
        for k in range(first, last + 1):
            if paths.law[k] == number:
                n = side_normal(paths.point, k, first, last)
                normal, sliding = separation(paths, k, n, 0.0)
                energy = stored(law, normal, sliding, paths.damage[k])
                total += energy * share_of_crack(paths, k, first, last)
    return total


@kernel
def lengths(length, paths):
    """Set the length of crack that every point stands for, 0 where no law acts (points,), m."""
    for c in range(len(paths.start) - 1):
        first, last = paths.start[c], paths.start[c + 1] - 1
        for k in range(first, last + 1):
            length[k] = share_of_crack(paths, k, first, last) if paths.law[k] >= 0 else 0.0


def draw_faces(model, state, scratch) -> None:
    """Add what the faces do to each other to the forces of the grid.

    The surfaces move with the mean of the velocities before and after a step; with the openings of
    its middle, which this needs, the forces neither feed nor take energy.
    """
    scratch.parted = ()
    if model.cohesion is None:
        return
    paths, lattice = state.paths, model.lattice
    before, traction = paths.damage.copy(), np.zeros_like(paths.point)
    for number, law in enumerate(model.cohesion.at(state.time)):
        pull_points(traction, paths, law, number, 0.5 * model.dt, True)
    spread(
        scratch.grid.force, make_seen(), make_seen(), traction, paths, cut_of_points(model, paths),
        scratch.grid.mass, scratch.rows, scratch.segments, model.groups.of_crack,
        model.geometry.thickness,
        lattice.cells, lattice.width, lattice.lower, model.strides,
    )  # fmt: skip
    scratch.parted = np.flatnonzero((before < 1.0) & (paths.damage >= 1.0))
    scratch.drawn = (traction, paths.above - paths.below)


def book_pressures(model, state, scratch) -> None:
    """Book the work of pressures on the faces that this step has moved."""
    if model.cohesion is None:
        return
    paths, (traction, gap) = state.paths, scratch.drawn
    pressures = [n for n, law in enumerate(model.cohesion.laws) if isinstance(law, Pressure)]
    pressed = np.isin(paths.law, pressures)
    density = np.sum(traction * (paths.above - paths.below - gap), axis=1)[pressed]
    length = covered_lengths(paths)[pressed]
    state.books.external[0] -= float(density @ length) * model.geometry.thickness


def tractions_now(model, state) -> np.ndarray:
    """Return the stress with which the upper face draws the lower one (points, 2), Pa."""
    traction = np.zeros_like(state.paths.point)
    for number, law in enumerate(model.cohesion.at(state.time)):
        pull_points(traction, state.paths, law, number, 0.0, False)
    return traction


def covered_lengths(paths) -> np.ndarray:
    """Return the length of crack for which every point stands (points,), 0 without a law (m)."""
    length = np.zeros(len(paths.point))
    lengths(length, paths)
    return length


def cohesive_energies(model, state) -> tuple[float, float]:
    """Return the energy that the faces of all cracks hold, and what they have dissipated (J)."""
    if model.cohesion is None:
        return 0.0, 0.0
    paths, thickness = state.paths, model.geometry.thickness
    held = sum(sum_stored(paths, law, n) for n, law in enumerate(model.cohesion.laws))
    spent = float(paths.spent.sum(axis=1) @ covered_lengths(paths))
    return thickness * held, thickness * spent


def parted_points(model, state, scratch) -> list[dict]:
    """Return a row of growth.csv for each point that lost all of its traction in this step."""
    paths, length = state.paths, covered_lengths(state.paths)
    rows = []
    for k in scratch.parted:
        crack = int(np.searchsorted(paths.start, k, side="right")) - 1
        energy = float(paths.spent[k].sum())
        rows.append(
            {
                "step": state.step,
                "time": state.time,
                "crack": model.crack_names[crack],
                "tip": "",
                "kind": "debond",
                "x": float(paths.point[k, 0]),
                "y": float(paths.point[k, 1]),
                "J": energy,
                "mode_I": float(paths.spent[k, 0]) / energy,
                "energy": energy * float(length[k]) * model.geometry.thickness,
            }
        )
    return rows
