"""Tractions: the forces on the grid add up to traction times face, and act at its middle."""

import numpy as np
import pytest
from support import advance, build_deck, locate

from cramp_cli.boundary.conditions import add_loads, book_tractions
from cramp_cli.boundary.traction import traction_power
from cramp_cli.build.model import SHAPES
from cramp_cli.cracks.fields import find_openings
from cramp_cli.transfer.sums import sum_mass_and_momentum
from cramp_cli.transfer.to_grid import clear

BEAM = """
cramp: 1
analysis: plane_strain
thickness: 0.3
grid: {cell: 0.5}
materials: {m: {law: elastic, density: 2, E: 1, nu: 0}}
bodies: [{name: beam, material: m, shape: {type: rectangle, lower: [0, 1], upper: [4, 3]}}]
solver: {end_time: 1, dt: 0.01}
"""
FACES = {  # plane, outward normal, length, middle
    "right": ({"x": 4.0}, (1, 0), 2.0, (4.0, 2.0)),
    "left": ({"x": 0.0}, (-1, 0), 2.0, (0.0, 2.0)),
    "top": ({"y": 3.0}, (0, 1), 4.0, (2.0, 3.0)),
    "bottom": ({"y": 1.0}, (0, -1), 4.0, (2.0, 1.0)),
}
ON_FACES = pytest.mark.parametrize("face", FACES.values(), ids=FACES)
PER_CELL = pytest.mark.parametrize("per_cell", [1, 2, 3, 4])


def loaded(load, per_cell=2, shape="ugimp", time=0.0, cracks=()):
    """Return model, state and scratch of the beam with the forces of one load on the grid."""
    body = {"name": "beam", "material": "m", "particles_per_cell": per_cell}
    body["shape"] = {"type": "rectangle", "lower": [0, 1], "upper": [4, 3]}
    load = {"type": "traction", "body": "beam"} | load
    sections = {
        "loads": [load],
        "bodies": [body],
        "cracks": list(cracks),
        "solver": {"shape": shape},
    }
    model, state, scratch = build_deck(BEAM, **sections)
    locate(model, state, scratch)
    sum_mass_and_momentum(model, state, scratch)
    find_openings(model, state, scratch)
    clear(scratch.grid.force, scratch.row_count)
    state.time = time
    add_loads(model, scratch, state)
    return model, state, scratch


@ON_FACES
@PER_CELL
@pytest.mark.parametrize("shape", list(SHAPES))
def test_sum_of_forces_is_traction_times_area(face, per_cell, shape):
    """Area = length times thickness."""
    where, _, length, _ = face
    _, _, scratch = loaded({"where": where, "traction": [3.0, -5.0]}, per_cell, shape)
    wanted = np.array([3.0, -5.0]) * length * 0.3
    np.testing.assert_allclose(scratch.grid.force.sum(axis=0), wanted, rtol=1e-13)


@ON_FACES
@PER_CELL
def test_a_uniform_traction_acts_at_the_middle_of_the_face(face, per_cell):
    """Moments of linear weights are exact: sum f_i x_i = traction * area * middle."""
    where, _, length, middle = face
    model, _, scratch = loaded({"where": where, "traction": [3.0, -5.0]}, per_cell)
    moments = scratch.grid.force[: model.lattice.node_count].T @ model.lattice.node_positions()
    wanted = np.outer([3.0, -5.0], middle) * length * 0.3
    np.testing.assert_allclose(moments, wanted, atol=1e-13 * 30)


@ON_FACES
def test_pressure_pushes_on_the_face(face):
    where, normal, length, _ = face
    _, _, scratch = loaded({"where": where, "pressure": 2.0})
    wanted = -2.0 * length * 0.3 * np.array(normal)
    np.testing.assert_allclose(scratch.grid.force.sum(axis=0), wanted, atol=1e-14)


def test_a_part_of_a_face():
    """y from 1 to 2 of the right face holds half of its particles."""
    _, _, scratch = loaded({"where": {"x": 4.0, "y": [1.0, 2.0]}, "traction": [3.0, 0.0]})
    assert scratch.grid.force[:, 0].sum() == pytest.approx(3.0 * 1.0 * 0.3, rel=1e-13)


def test_a_load_in_time():
    """A quarter of the way up a ramp."""
    load = {"where": {"x": 4.0}, "traction": [3.0, 0.0], "in_time": {"type": "ramp", "until": 1.0}}
    _, _, scratch = loaded(load, time=0.25)
    assert scratch.grid.force[:, 0].sum() == pytest.approx(0.25 * 3.0 * 2.0 * 0.3, rel=1e-13)


def test_power_is_force_times_velocity():
    """A body in uniform motion: power = total force times velocity."""
    model, state, scratch = loaded({"where": {"x": 4.0}, "traction": [3.0, -5.0]})
    state.particles.velocity[:] = (0.7, 0.2)
    sum_mass_and_momentum(model, state, scratch)
    load = model.conditions.tractions[0]
    power = traction_power(
        scratch.grid, scratch.stencil, scratch.index, load.faces, load.shape, model.strides
    )
    assert power == pytest.approx((3.0 * 0.7 - 5.0 * 0.2) * 2.0 * 0.3, rel=1e-13)
    book_tractions(model, scratch, state)
    assert state.books.external[0] == pytest.approx(0.5 * model.dt * power, rel=1e-13)


def test_forces_next_to_a_crack_go_to_their_own_side():
    """A crack that meets the loaded face: the face above it is not pulled by the load below."""
    crack = {"name": "c", "points": [[2.2, 2.0], [4.0, 2.0]], "end": "edge"}
    load = {"where": {"x": 4.0, "y": [1.0, 2.0]}, "traction": [3.0, 0.0]}
    model, state, scratch = loaded(load, cracks=[crack])
    rows, mass = scratch.rows, scratch.grid.mass
    for row in np.flatnonzero(scratch.grid.force[:, 0] > 1e-12):
        node = row if row < len(rows.first) else rows.node[row - len(rows.first)]
        if rows.first[node] >= 0:
            assert rows.place[row, 1] / mass[row] < 2.0
    assert scratch.grid.force[:, 0].sum() == pytest.approx(3.0 * 1.0 * 0.3, rel=1e-13)


@pytest.mark.parametrize("strain", ["usavg+", "usavg-", "usf", "usl+"])
def test_a_traction_on_a_face_at_rest_does_no_work(strain):
    """A beam is pulled at its right; its left face is held, and what pulls there moves nothing."""
    works = []
    for left in (0.0, -20.0):
        loads = [
            {"type": "traction", "body": "beam", "where": {"x": x}, "traction": [traction, 0.0]}
            for x, traction in ((4.0, 1e-3), (0.0, left * 1e-3))
        ]
        held = [{"where": {"x": 0.0}, "fix": ["x"]}]
        deck = {"loads": loads, "boundary": held, "solver": {"strain": strain}}
        model, state, scratch = build_deck(BEAM, **deck)
        advance(model, state, scratch, 200)
        works.append(state.books.external[0])
    assert works[1] == pytest.approx(works[0], rel=1e-9)
