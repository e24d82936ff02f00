"""Which tips are measured, and how far their domains reach."""

import numpy as np
import pytest
from support import build_deck

from cramp_cli.cracks.tips import crack_length, hooke_at, sample_tips, tips_of
from cramp_cli.simulation import find_rows, locate_particles

PLATE = """
cramp: 1
analysis: plane_stress
grid: {cell: 1}
materials:
  soft: {law: elastic, density: 1, E: 2, nu: 0.25}
  hard: {law: elastic, density: 1, E: 20, nu: 0.4}
bodies: [{name: plate, material: soft, shape: {type: rectangle, lower: [0, 0], upper: [30, 20]}}]
solver: {end_time: 1}
"""


def sampled(*cracks, **sections):
    """Return the rows of all tips of a plate at rest, by crack and end."""
    named = [{"name": f"c{n}", **crack} for n, crack in enumerate(cracks)]
    model, state, scratch = build_deck(PLATE, cracks=named, **sections)
    locate_particles(model, state, scratch)
    find_rows(model, state, scratch)
    return {(row["crack"], row["tip"]): row for row in sample_tips(model, state, scratch)}


def inner(*points, **more):
    return {"points": [list(p) for p in points], **more}


def test_tips_and_their_directions():
    """Out of the crack at both ends; ends at an edge and plain ends are no tips."""
    cracks = [
        {"name": "a", **inner((8, 10), (12, 13))},
        {"name": "b", **inner((0, 5), (8, 5), start="edge", end="plain")},
    ]
    _, state, _ = build_deck(PLATE, cracks=cracks)
    tips = tips_of(state.paths)
    assert [(tip.crack, tip.end) for tip in tips] == [(0, 0), (0, 1)]
    directions = [tip.direction(state.paths.point) for tip in tips]
    np.testing.assert_allclose(directions, [(-0.8, -0.6), (0.8, 0.6)], atol=1e-14)
    assert crack_length(state.paths, 0) == pytest.approx(5.0, rel=1e-14)


def test_a_body_at_rest_has_no_intensity():
    row = sampled(inner((0, 10), (15, 10), start="edge"))["c0", "end"]
    assert (row["J"], row["K_I"], row["K_II"], row["status"]) == (0.0, 0.0, 0.0, "ok")
    assert (row["x"], row["y"], row["angle"], row["length"]) == (15.0, 10.0, 0.0, 15.0)


@pytest.mark.parametrize(("crack", "word"), [
    (inner((0, 10), (11, 10), (15, 14), start="edge"), "ok"),  # 5.7 cells from the bend
    (inner((0, 10), (12, 10), (15, 13), start="edge"), "shrunk: a bend of the crack"),  # 4.2 cells
    (inner((0, 10), (14, 10), (15, 11), start="edge"), "invalid: a bend of the crack"),  # 1.4 cells
    (inner((0, 3), (15, 3), start="edge"), "shrunk: the edge of the body"),
    (inner((0, 1), (15, 1), start="edge"), "invalid: the edge of the body"),
    (inner((11, 10), (15, 10)), "shrunk: the other tip"),
])  # fmt: skip
def test_what_is_near_a_tip_shrinks_its_domain(crack, word):
    """Radius 5 cells, 2.5 at least; kinks, edges, other tips must stay outside."""
    assert sampled(crack, fracture={"methods": ["domain"]})["c0", "end"]["status"].startswith(word)


def test_another_crack_shrinks_the_domain():
    rows = sampled(
        inner((0, 10), (15, 10), start="edge"),
        inner((18, 2), (18, 18)),
        fracture={"methods": ["domain"]},
    )
    assert rows["c0", "end"]["status"].startswith("shrunk: crack c1")
    assert rows["c1", "start"]["status"].startswith("shrunk: the edge")


def test_constants_are_those_of_the_material_at_the_tip():
    """Plane stress: kappa = (3 - nu)/(1 + nu), E' = E, nu/(1 + nu) for nu."""
    right = {"type": "rectangle", "lower": [15, 0], "upper": [30, 20]}
    left = {"type": "rectangle", "lower": [0, 0], "upper": [30, 20]}
    bodies = [
        {"name": "one", "material": "soft", "shape": left},
        {"name": "two", "material": "hard", "shape": right},
    ]
    model, state, _ = build_deck(PLATE, bodies=bodies)
    for x, E, nu in ((14.9, 2.0, 0.25), (15.1, 20.0, 0.4)):
        got = hooke_at(model, state.particles, np.array([x, 10.0]))
        wanted = (E / (2 + 2 * nu), (3 - nu) / (1 + nu), nu / (1 + nu), E)
        assert tuple(got) == pytest.approx(wanted, rel=1e-13)
