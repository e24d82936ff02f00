"""Crack patch tests: an explicit crack gives what the same body gives without one.

Reference case P0: a double cantilever beam whose crack lies exactly on a row of nodes, against its
upper half with a symmetry plane ahead of the tip. Nothing else differs, so the answers are the same
numbers.
"""

import numpy as np
import pytest
import yaml
from runs import INPUTS
from support import advance, build_deck, merged

from cramp_cli.build.model import SHAPES

pytestmark = pytest.mark.verification

STEPS = 1000
BEAM = yaml.safe_load((INPUTS / "dcb.yaml").read_text(encoding="utf-8"))
UPPER_HALF = {
    "bodies": [
        BEAM["bodies"][0]
        | {"shape": {"type": "rectangle", "lower": [0, 0], "upper": ["100 mm", "12 mm"]}}
    ],
    "loads": BEAM["loads"][:1],
    "boundary": [*BEAM["boundary"], {"where": {"y": 0}, "symmetry": True}],
}


def beam(contact, **changes):
    crack = BEAM["cracks"][0] | {"contact": {"law": contact}}
    return merged(merged(BEAM, {"cracks": [crack]}), changes)


def after(deck, **solver):
    """Return positions and stresses of a deck's particles after some steps, by first place."""
    model, state, scratch = build_deck(deck, solver=solver)
    advance(model, state, scratch, STEPS)
    particles = state.particles
    order = np.lexsort(particles.origin.T)
    return particles.origin[order], particles.position[order], particles.stress[order]


def largest_difference(ours, theirs):
    """Return the largest difference over the largest value."""
    return np.abs(ours - theirs).max() / np.abs(theirs).max()


@pytest.mark.parametrize("shape", list(SHAPES))
def test_a_beam_with_a_crack_is_twice_its_half_with_a_symmetry_plane(shape):
    origin, place, stress = after(beam("ignore"), shape=shape)
    of_half, place_of_half, stress_of_half = after(beam("ignore", **UPPER_HALF), shape=shape)
    upper = origin[:, 1] > 0.0
    assert np.array_equal(origin[upper], of_half)
    # round-off, with room; measured 4e-15
    assert largest_difference(place[upper], place_of_half) <= 1e-10
    assert largest_difference(place[upper] - of_half, place_of_half - of_half) <= 1e-10
    assert largest_difference(stress[upper], stress_of_half) <= 1e-10


@pytest.mark.parametrize("shape", list(SHAPES))
def test_a_glued_crack_is_no_crack(shape):
    _, place, stress = after(beam("glued"), shape=shape)
    _, place_without, stress_without = after(merged(BEAM, {"cracks": []}), shape=shape)
    # 1e-12 is what NairnMPM reaches: a crack that sticks is no crack
    assert largest_difference(place, place_without) <= 1e-12
    assert largest_difference(stress, stress_without) <= 1e-12
