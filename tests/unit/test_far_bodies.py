"""What is far away changes no bit of a plate with a crack: neither its motion nor J and K."""

import numpy as np
import pytest
from support import advance, build_deck, merged

from cramp_cli.cracks.tips import sample_tips

PLATE = {
    "name": "plate",
    "material": "m",
    "shape": {"type": "rectangle", "lower": [0.0, 0.0], "upper": [14.0, 12.0]},
}
DECK = {
    "cramp": 1,
    "analysis": "plane_strain",
    "grid": {"cell": 1.0, "lower": [-2.0, -2.0], "upper": [36.0, 14.0]},
    "materials": {name: {"law": "elastic", "density": 1.0, "E": 1.0, "nu": 0.3} for name in "amz"},
    "bodies": [PLATE],
    "cracks": [{"name": "c", "points": [[0, 5.6], [7.3, 6.1]], "start": "edge", "end": "tip"}],
    "loads": [
        {"type": "traction", "body": "plate", "where": {"y": 12.0}, "traction": [1e-4, 1e-3]}
    ],
    "solver": {"end_time": 100.0, "strain": "usavg+"},
    "fracture": {"methods": ["domain", "contour"]},
}
STEPS = 12


def far(material, per_cell, **keys):
    shape = {"type": "rectangle", "lower": [28.0, 4.0], "upper": [32.0, 8.0]}
    body = {"name": "far", "material": material, "shape": shape, "particles_per_cell": per_cell}
    return {**body, **keys}


WALL = {"name": "far", "shape": far("", 1)["shape"], "rigid": {"velocity": [0.0, 0.0]}}
STICKY = {"contact": {"bodies": {"law": "frictional", "mu": 0.3}}}
OTHERS = {
    "coarse, sorts first": ({"bodies": [PLATE, far("a", 1)]}, {}),
    "fine, sorts last": ({"bodies": [PLATE, far("z", 4)]}, {}),
    "coarse, of the same material": ({"bodies": [PLATE, far("m", 1)]}, {}),
    "first in the deck": ({"bodies": [far("a", 3), PLATE]}, {}),
    "may touch": ({"bodies": [PLATE, far("a", 1)]}, STICKY),
    "a rigid wall": ({"bodies": [PLATE, {**WALL, "particles_per_cell": 1}]}, STICKY),
    "a rigid wall first": ({"bodies": [{**WALL, "particles_per_cell": 4}, PLATE]}, STICKY),
    "flies": ({"bodies": [PLATE, far("a", 1, velocity=[0.01, 0.0])]}, STICKY),
}


def outcome(*changes):
    """Return what the plate, its crack and its tip are after some steps."""
    deck = DECK
    for change in changes:
        deck = merged(deck, change)
    model, state, scratch = build_deck(deck)
    advance(model, state, scratch, STEPS)
    p = state.particles
    number = [body["name"] for body in deck["bodies"]].index("plate")
    mine = p.body == number
    row = sample_tips(model, state, scratch)[0]
    solid = [array[mine] for array in (p.position, p.velocity, p.F, p.stress, p.work)]
    return solid, list(state.paths), row


@pytest.fixture(scope="module")
def alone():
    return outcome()


@pytest.mark.parametrize("other", list(OTHERS))
def test_a_far_body_changes_no_bit(alone, other):
    solid, paths, row = alone
    found = outcome(*OTHERS[other])
    for mine, theirs in zip((*solid, *paths), (*found[0], *found[1]), strict=True):
        np.testing.assert_array_equal(mine, theirs)
    assert repr(row) == repr(found[2])  # nan as well
    assert row["J"] > 0.0
    assert row["J_contour"] > 0.0
