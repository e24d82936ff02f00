"""Forces between the faces of a crack, and what they take (docs/theory/cohesive.md).

The crack points carry the traction laws. The opening of a point is that of its two surfaces; the
force of its share of the crack goes to the rows of its upper and of its lower side, one the
opposite of the other, with the very weights with which the surfaces move (view.py): the force
works on the motion of the surface and on nothing else.
"""

from dataclasses import dataclass

import numpy as np

from cramp_cli.cohesive.pressure import Pressure
from cramp_cli.cracks.faces import lay_out_faces, pull_points, spread, sum_stored
from cramp_cli.cracks.fields import cut_of_points, what_surfaces_see
from cramp_cli.materials.law import confined_modulus


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

    def presses(self, paths) -> np.ndarray:
        """Return whether the law of each crack point is a pressure (points,)."""
        numbers = [n for n, law in enumerate(self.laws) if isinstance(law, Pressure)]
        return np.isin(paths.law, numbers)


def draw_faces(model, state, scratch) -> None:
    """Add what the faces do to each other to the forces of the grid.

    The surfaces move with the mean of the velocities before and after a step; with the openings of
    its middle, which this needs, the forces neither feed nor take energy.
    """
    scratch.parted = ()
    if model.cohesion is None:
        return
    paths, faces = state.paths, lay_out_faces(state.paths)
    before, traction = paths.damage.copy(), np.zeros_like(paths.point)
    for number, law in enumerate(model.cohesion.at(state.time)):
        pull_points(traction, paths, faces.normal, law, number, 0.5 * model.dt, True)
    cut = cut_of_points(model, paths, scratch.at_tips)
    force, where = scratch.grid.force, (cut, scratch.grid.mass, *what_surfaces_see(model, scratch))
    spread(force, *scratch.seen, traction, paths, faces, *where, model.geometry.thickness)
    scratch.parted = np.flatnonzero((before < 1.0) & (paths.damage >= 1.0))
    scratch.drawn = (traction, paths.above - paths.below)


def book_pressures(model, state, scratch) -> None:
    """Book the work of pressures on the faces that this step has moved."""
    if model.cohesion is None:
        return
    paths, (traction, gap) = state.paths, scratch.drawn
    pressed = model.cohesion.presses(paths)
    work = np.sum(traction * (paths.above - paths.below - gap), axis=1)[pressed]
    length = lay_out_faces(paths).length[pressed]
    state.books.external[0] -= float(work @ length) * model.geometry.thickness


def energy_of_pressures(model, state) -> float:
    """Return what pressures of now would put into the solid if nothing held the faces (J).

    f^2/2M per thickness, f the force on the faces of a crack (N/m), M the largest modulus of
    uniaxial strain: about what they have done to a crack that is open, and far more than the
    trembling of faces that they press together.
    """
    if model.cohesion is None:
        return 0.0
    pressed, faces = model.cohesion.presses(state.paths), lay_out_faces(state.paths)
    if not pressed.any():
        return 0.0
    force = np.hypot(*tractions_now(model, state).T) * faces.length
    of_crack = np.bincount(faces.crack[pressed], force[pressed])
    modulus = max(confined_modulus(b.law) for b in model.blocks if b.law is not None)
    return model.geometry.thickness * float(of_crack @ of_crack) / (2.0 * modulus)


def tractions_now(model, state) -> np.ndarray:
    """Return the stress with which the upper face draws the lower one (points, 2), Pa."""
    paths, traction = state.paths, np.zeros_like(state.paths.point)
    normal = lay_out_faces(paths).normal
    for number, law in enumerate(model.cohesion.at(state.time)):
        pull_points(traction, paths, normal, law, number, 0.0, False)
    return traction


def cohesive_energies(model, state) -> tuple[float, float]:
    """Return the energy that the faces of all cracks hold, and what they have dissipated (J)."""
    if model.cohesion is None:
        return 0.0, 0.0
    paths, thickness, faces = state.paths, model.geometry.thickness, lay_out_faces(state.paths)
    held = sum(sum_stored(paths, faces, law, n) for n, law in enumerate(model.cohesion.laws))
    return thickness * held, thickness * float(paths.spent.sum(axis=1) @ faces.length)


def parted_points(model, state, scratch) -> list[dict]:
    """Return a row of growth.csv for each point that lost all of its traction in this step."""
    faces = lay_out_faces(state.paths)
    return [_row(model, state, faces, int(k)) for k in scratch.parted]


def _row(model, state, faces, k) -> dict:
    paths, energy = state.paths, float(state.paths.spent[k].sum())
    return {
        "step": state.step,
        "time": state.time,
        "crack": model.crack_names[faces.crack[k]],
        "tip": "",
        "kind": "debond",
        "x": float(paths.point[k, 0]),
        "y": float(paths.point[k, 1]),
        "J": energy,
        "mode_I": float(paths.spent[k, 0]) / energy,
        "energy": energy * float(faces.length[k]) * model.geometry.thickness,
    }
