"""Bodies that stick to each other: the force that pulls or shears them apart."""

import numpy as np
import pytest
from support import advance, build_deck, read

from cramp_cli.build import build
from cramp_cli.contact.adhesion import JOINED, adhere
from cramp_cli.contact.clouds import Clouds
from cramp_cli.contact.laws import BodyLaws
from cramp_cli.contact.pairs import make_pairs
from cramp_cli.cracks.contact import FRICTIONAL, GLUED, UPDATE
from cramp_cli.output.checkpoint import read_state, write_state
from cramp_cli.schema.mistake import DeckError
from cramp_cli.scratch import make_scratch

pytestmark = pytest.mark.verification

STRENGTH = 2e-3  # Pa, of a solid with E = 1 Pa
WIDTH, RAMP = 6.0, 400.0  # m; s, in which the load rises to 1.5 times the strength


def block(face, traction, law=None, base="solid", **more):
    """Return a deck: a block that a traction on its top draws off a base, their face at y.

    The base is as wide as the block: the stress is uniform, with no peaks at the ends of the face.
    """
    lower = {"name": "base", "material": "m"}
    if base == "rigid":
        lower = {"name": "base", "rigid": {}}
    lower["shape"] = {"type": "rectangle", "lower": [0, -3], "upper": [WIDTH, face]}
    shape = {"type": "rectangle", "lower": [0, face], "upper": [WIDTH, face + 4]}
    return {
        "cramp": 1,
        "analysis": "plane_strain",
        "grid": {"cell": 1.0, "lower": [-5, -5], "upper": [12, 12]},
        "materials": {"m": {"law": "elastic", "density": 1.0, "E": 1.0, "nu": 0.0}},
        "bodies": [lower, {"name": "block", "material": "m", "shape": shape}],
        "contact": {"bodies": law or {"law": "adhesive", "strength": STRENGTH}},
        "boundary": [{"where": {"y": -3}, "fix": ["x", "y"]}] if base == "solid" else [],
        "loads": [
            {"type": "traction", "body": "block", "where": {"y": face + 4}, "traction": traction}
            | {"in_time": {"type": "ramp", "until": RAMP}}
        ],
        "solver": {"end_time": 1.0, "damping": {"particle": 0.2}} | more,
    }


def largest_force(deck, axis):
    """Return the largest force between base and block until they part, and the last gap (m)."""
    model, state, scratch = build_deck(deck)
    largest, p = 0.0, state.particles
    while state.time < RAMP:
        advance(model, state, scratch, 1)
        largest = max(largest, abs(float(state.contact_forces[1, axis])))
    return largest, (p.position - p.origin)[p.body == 1, axis].mean()


@pytest.mark.parametrize(("base", "face"), [("solid", 0.0), ("solid", 0.5), ("rigid", 0.0)])
def test_pull_off_force(base, face):
    """Strength times area, within 0.3 %; the face on a line of nodes and midway between two.

    Not a rigid base with its face between two lines: one of them bears all, and half of the load
    is enough (docs/theory/contact.md, Limits).
    """
    force, way = largest_force(block(face, [0, 1.5 * STRENGTH], base=base), 1)
    print(f"{base} {face}: {force / (STRENGTH * WIDTH) - 1:+.4f}, gone {way:.2f}")
    assert force == pytest.approx(STRENGTH * WIDTH, rel=0.02)
    assert way > 0.1  # it flies off


def test_a_weaker_pull_does_not_part_them():
    force, way = largest_force(block(0.0, [0, 0.95 * STRENGTH]), 1)
    assert force == pytest.approx(0.95 * STRENGTH * WIDTH, rel=0.02)
    assert way < 0.02  # a strain of 0.2 % over its height and that of the base


def test_the_joint_is_a_solid_until_then():
    """Half of the load: the same motion as with `glued`, bit for bit."""
    found = []
    for law in (None, {"law": "glued"}):
        model, state, scratch = build_deck(block(0.0, [0, 0.5 * STRENGTH], law))
        advance(model, state, scratch, 200)
        found.append(state.particles.position.tobytes())
    assert found[0] == found[1]


def test_strengths_of_pulling_and_shearing_go_together():
    """Area 1 m^2, dt 0.1 s: momenta of 0.2 and 0.1 N s are the strengths of 2 and 1 Pa."""
    pairs, square = make_pairs(1, 1, 2), np.zeros((2, 2))
    pairs.group[0], pairs.row[0] = (0, 1), (0, 1)
    laws = BodyLaws(square.astype(np.int64), square, square, square + 2.0, square + 1.0)
    clouds = Clouds(np.zeros(2, np.int64), np.zeros(2, np.int64), np.full(2, 0.5), square)
    holds = {(0.0, 0.19): 1, (0.0, 0.21): 0, (0.09, 0.0): 1, (-0.11, 0.0): 0}
    for dp, wanted in (holds | {(0.08, 0.13): 0, (0.08, 0.11): 1, (0.0, -9.0): 1}).items():
        pairs.bond[0] = JOINED
        kind = adhere(pairs, 0, laws, clouds, dp, (0.0, 1.0), 1.0, 0.1, UPDATE)
        assert (pairs.bond[0], kind) == (wanted, GLUED if wanted else FRICTIONAL)


def test_a_resumed_run_keeps_its_bonds(tmp_path):
    deck = block(0.0, [0, 1.5 * STRENGTH])
    model, state, scratch = build_deck(deck)
    advance(model, state, scratch, 300)
    assert len(state.bonds)
    write_state(tmp_path / "s.h5", state, {})
    again = read_state(tmp_path / "s.h5", build(read(deck))[1]).state
    advance(model, state, scratch, 300)
    advance(model, again, make_scratch(model, again), 300)
    assert again.particles.velocity.tobytes() == state.particles.velocity.tobytes()
    assert again.bonds.tobytes() == state.bonds.tobytes()


def test_cracks_have_traction_laws_instead():
    with pytest.raises(DeckError, match="unknown law 'adhesive'"):
        read(block(0.0, [0, 1]), contact={"cracks": {"law": "adhesive", "strength": 1}})


def test_half_of_a_joint_with_its_image_bears_what_the_whole_does():
    """A symmetry plane across the joint: the same bonds in every step, the same motion.

    A node on the plane holds half of the volume and, with the image, all of the momentum: before
    the volume had its image too the joint began to part there, at half of its strength.
    """
    found = []
    for half in (False, True):
        deck = block(0.0, [0, 1.5 * STRENGTH])
        for body in deck["bodies"]:
            body["shape"]["lower"][0] = 0 if half else -WIDTH
        plane = [{"where": {"x": 0}, "symmetry": True}] if half else []
        deck["grid"] = {"cell": 1.0, "lower": [-10, -5], "upper": [12, 12]}
        model, state, scratch = build_deck(deck | {"boundary": [*deck["boundary"], *plane]})
        forces, share = [], 2.0 if half else 1.0
        while state.time < RAMP:
            advance(model, state, scratch, 1)
            forces.append(share * float(state.contact_forces[1, 1]))
        found.append(forces)
    whole, half = found
    np.testing.assert_allclose(half, whole, rtol=0, atol=1e-6 * STRENGTH * WIDTH)
    assert np.max(np.abs(whole)) > STRENGTH * WIDTH
    assert whole[-1] == 0.0  # it has parted
