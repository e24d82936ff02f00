"""A symmetry plane: half a body with its image is the whole body."""

import numpy as np
import pytest
from support import advance, build_deck

from cramp_cli.boundary.symmetry import reflect, stop_normal
from cramp_cli.build.model import SHAPES
from cramp_cli.cracks.rows import add_row
from cramp_cli.state.grid import make_grid

NONE = -1
WHOLE = 0  # the only contact group
ROW = {"cramp": 1, "analysis": "plane_strain", "grid": {"cell": 1.0}}
STEEL = {"m": {"law": "elastic", "density": 1.0, "E": 1.0, "nu": 0.3}}


def test_sums_of_both_sides_are_given_to_each_other():
    """Three nodes, plane through the second: vectors are mirrored, masses added."""
    grid, rows = make_grid(3, 2, 0)
    out, inside = np.array([0]), np.array([2])
    field = np.array([[1.0, 2.0], [9.0, 9.0], [10.0, 20.0]])
    grid.mass[:] = (1.0, 5.0, 2.0)
    reflect(field, rows, 0, NONE, out, inside, True)
    reflect(grid.mass.reshape(-1, 1), rows, NONE, NONE, out, inside, True)
    assert field.tolist() == [[-9.0, 22.0], [9.0, 9.0], [9.0, 22.0]]
    assert grid.mass.tolist() == [3.0, 5.0, 3.0]


def test_images_are_repeated_without_adding():
    _, rows = make_grid(3, 2, 0)
    field = np.array([[1.0, 2.0], [9.0, 9.0], [10.0, 20.0]])
    reflect(field, rows, 1, NONE, np.array([0]), np.array([2]), False)
    assert field.tolist() == [[10.0, -20.0], [9.0, 9.0], [10.0, 20.0]]


def test_rows_across_a_crack_have_images_of_their_own():
    """Rows across a crack through the plane face each other; one without an image stays."""
    _, rows = make_grid(3, 2, 3)
    out, inside = add_row(rows, 0, WHOLE, 4, 1, NONE, 0), add_row(rows, 2, WHOLE, 4, 1, NONE, 0)
    alone = add_row(rows, 0, WHOLE, 5, 1, NONE, 0)
    field = np.zeros((6, 2))
    field[[out, inside, alone]] = [[1.0, 2.0], [10.0, 20.0], [7.0, 7.0]]
    reflect(field, rows, 0, NONE, np.array([0]), np.array([2]), True)
    np.testing.assert_array_equal(field[[out, inside, alone]], [[-9, 22], [9, 22], [7, 7]])


def test_a_crack_on_the_plane_parts_body_and_image():
    """Rows reached through it are free, and so are the nodes of the plane on it."""
    _, rows = make_grid(3, 2, 2)
    out, on = add_row(rows, 0, WHOLE, 4, 1, NONE, 0), add_row(rows, 1, WHOLE, 4, 1, NONE, 0)
    rows.owner[:] = rows.crack  # one branch each
    field = np.full((5, 2), 3.0)
    reflect(field, rows, 0, 4, np.array([0]), np.array([2]), True)
    assert field[out].tolist() == [3.0, 3.0]
    taken = stop_normal(field, rows, 0, 4, np.array([1]), np.array([False]))
    assert taken == 3.0
    assert field[[1, on]].tolist() == [[0.0, 3.0], [3.0, 3.0]]
    field[1] = 3.0
    assert stop_normal(field, rows, 0, 4, np.array([1]), np.array([True])) == 0.0
    assert field[1].tolist() == [3.0, 3.0]


def plate(whole, cracks=(), shape="ugimp", update="flip", scale=0.97, **more):
    """Return a plate of 12 x 6 cells in motion, or its right half with a symmetry plane.

    The scale moves the first particles over the plane, or away from it: at 1 they end there, and
    round-off is divided by tiny masses.
    """
    left = -6.0 if whole else 0.0
    body = {"type": "rectangle", "lower": [left, 0.0], "upper": [6.0, 6.0]}
    bodies = [{"name": "plate", "material": "m", "shape": body}]
    plane = [] if whole else [{"where": {"x": 0.0}, "symmetry": True}]
    solver = {"end_time": 1.0, "shape": shape, "update": update} | more
    parts = {"materials": STEEL, "bodies": bodies, "boundary": plane, "solver": solver}
    model, state, scratch = build_deck({**ROW, **parts, "cracks": list(cracks)})
    x, y = state.particles.position.T
    x *= scale
    state.particles.origin[:] = state.particles.position
    moving = np.stack([np.sin(x) * (1.0 + y), np.cos(x) * (2.0 - 0.4 * y)], axis=1)
    state.particles.velocity[:] = 1e-3 * moving
    return model, state, scratch


def right_half(particles):
    """Return position, velocity and stress of the particles with x > 0, in the order of place."""
    mine = particles.origin[:, 0] > 0.0
    order = np.lexsort(particles.origin[mine].T)
    return [a[mine][order] for a in (particles.position, particles.velocity, particles.stress)]


def crack(points, law, start="edge"):
    return {
        "name": "c", "points": points, "start": start, "segment": 0.55, "contact": {"law": law}
    }  # fmt: skip


def across(tip, law):
    """Return a crack from tip to tip for the whole plate, and the right half of it."""
    return (
        (crack([[-tip, 3.3], [tip, 3.3]], law, "tip"),),
        (crack([[0.0, 3.3], [tip, 3.3]], law, "edge"),),
    )


OPEN_ALONG = crack([[0.0, -0.5], [0.0, 2.7]], "ignore")


@pytest.mark.parametrize("update", ["flip", "fmpm(2)", "xpic(2)"])
@pytest.mark.parametrize("shape", list(SHAPES))
@pytest.mark.parametrize("tips", ["smooth", "sharp"])
@pytest.mark.parametrize(
    ("whole", "half"),
    [
        ((), ()),
        across(5.3, "ignore"),
        across(5.3, "glued"),
        across(4.4, "ignore"),  # a smooth tip wants four cells to a plane that its crack crosses
        ((OPEN_ALONG,), (OPEN_ALONG,)),
    ],
    ids=["no crack", "open across", "glued across", "short across", "open along"],
)
def test_half_a_body_moves_as_the_whole_one(whole, half, tips, shape, update):
    """20 steps of a symmetric motion; only the order of the sums differs, positions are below 10.

    The contact laws are those without a decision: round-off at the limit of contact would show.
    """
    both = [
        plate(True, whole, shape, update, tips=tips),
        plate(False, half, shape, update, tips=tips),
    ]
    for one in both:
        advance(*one, 20)
    full, right = (right_half(state.particles) for _, state, _ in both)
    assert np.abs(full[2]).max() > 1e-4
    for a, b in zip(full, right, strict=True):
        np.testing.assert_allclose(b, a, rtol=0.0, atol=1e-13)


def test_the_reaction_of_the_plane_is_the_force_between_the_halves():
    """Newton: the sum of the momenta changes by the reaction times dt.

    That of particles that do not reach over the plane: the others are part of the other half, too.
    """
    model, state, scratch = plate(False, scale=1.03)
    p = state.particles
    advance(model, state, scratch, 5)
    before = p.mass @ p.velocity[:, 0]
    advance(model, state, scratch, 1)
    change = p.mass @ p.velocity[:, 0] - before
    assert change == pytest.approx(state.reactions[0, 0] * model.dt, rel=1e-10)
