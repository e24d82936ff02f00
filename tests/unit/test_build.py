"""From a deck to a model: what a run needs, and the mistakes that show only there."""

import pytest
from support import build_deck, read

from cramp_cli.build import estimate
from cramp_cli.build.model import time_step
from cramp_cli.deck.deck import DeckError

BLOCK = """
cramp: 1
analysis: plane_strain
grid: {cell: 1}
materials:
  soft: {law: elastic, density: 1, E: 3, nu: 0}
  hard: {law: elastic, density: 1, E: 300, nu: 0}
bodies: [{name: block, material: soft, shape: {type: rectangle, lower: [0, 0], upper: [8, 6]}}]
solver: {end_time: 1}
"""


def mistakes(**sections):
    """Return what building a block with these sections complains about."""
    with pytest.raises(DeckError) as caught:
        build_deck(BLOCK, **sections)
    return [str(mistake) for mistake in caught.value.mistakes]


def test_the_time_step_is_that_of_the_materials_in_use():
    """c = sqrt(E/rho) at nu = 0; half of cell/c.."""
    assert time_step(read(BLOCK)) == pytest.approx(0.5 / 3**0.5, rel=1e-14)
    assert estimate(read(BLOCK))["steps"] == 4


@pytest.mark.parametrize(("place", "words"), [
    ({"y": 3}, "lies inside body block; give its face"),
    ({"y": 2.7}, "lies inside body block; give its face"),
    ({"y": 9}, "no face of a particle of body block lies there"),
])  # fmt: skip
def test_a_misplaced_traction_is_told_once(place, words):
    load = {"type": "traction", "body": "block", "where": place, "traction": [0, 1]}
    (told,) = mistakes(loads=[load])
    assert told.endswith(f"loads.0.where: {words}")


@pytest.mark.parametrize(("place", "words"), [
    ({"y": 3}, "lies inside a body; give its face"),
    ({"y": 7}, "no face of a particle lies there"),
])  # fmt: skip
def test_an_absorbing_boundary_needs_faces(place, words):
    (told,) = mistakes(boundary=[{"where": place, "absorbing": True}])
    assert told.endswith(f"boundary.0.where: {words}")


def test_an_absorbing_boundary_needs_speeds_of_waves():
    material = {"law": "viscoelastic", "density": 1.0, "E": 1.0, "nu": 0.3}
    material["prony"] = [{"share": 0.5, "time": 1.0}]
    boundary = [{"where": {"y": 6}, "absorbing": True}]
    (told,) = mistakes(boundary=boundary, materials={"soft": material})
    assert "the waves of 'soft' have no speed of their own" in told


@pytest.mark.parametrize("law", ["frictional", "glued", "stick"])
def test_contact_does_not_act_on_a_symmetry_plane(law):
    """The other side is an image, with no rows to press on: free faces or nothing."""
    contact = {"law": law} | ({"mu": 0.1} if law == "frictional" else {})
    crack = {"name": "c", "points": [[0, 0], [4, 0]], "start": "edge"}
    plane = [{"where": {"y": 0}, "symmetry": True}]
    for more in ({"contact": contact}, {}):
        told = mistakes(cracks=[crack | more], boundary=plane, contact={"cracks": contact})
        assert f"'{law}' does not act on a symmetry plane" in told[0]
    build_deck(BLOCK, cracks=[crack | {"contact": {"law": "ignore"}}], boundary=plane)
