"""Materials of a deck: what is said of wrong ones, and the law that right ones become."""

from typing import get_args

import numpy as np
import pytest
from support import advance, build_deck, read

from cramp_cli.build.estimate import FRAME_BYTES, estimate
from cramp_cli.build.laws import law_of
from cramp_cli.build.model import build
from cramp_cli.deck.deck import DeckError
from cramp_cli.deck.run import OutputField
from cramp_cli.materials.law import confined_modulus, memory
from cramp_cli.output.checkpoint import read_state, write_state
from cramp_cli.scratch import make_scratch
from cramp_cli.state.measures import FIELDS
from cramp_cli.state.particles import PLASTIC_STRAIN
from cramp_cli.study.particles import UNITS

SOLID = {"density": 1000, "E": "200 GPa", "nu": 0.3}
METAL = SOLID | {"law": "j2_plastic"}
WOOD = {
    "law": "orthotropic", "density": 500, "E1": 10e9, "E2": 1e9, "E3": 0.5e9, "G12": 0.7e9,
    "nu12": 0.4, "nu13": 0.4, "nu23": 0.4,
}  # fmt: skip
FIBRES = {
    "law": "transverse", "density": 1600, "E_axial": 140e9, "E_transverse": 10e9,
    "nu_axial": 0.3, "nu_transverse": 0.4, "G_axial": 5e9,
}  # fmt: skip
COPPER = {"type": "johnson_cook", "A": 90e6, "B": 292e6, "n": 0.31, "C": 0.025, "m": 1.09}
VOCE = {"type": "voce", "yield_stress": 2, "saturation": 1, "strain": 1}
PRONY = [{"share": 0.5, "time": 1}]
SOIL = SOLID | {"law": "drucker_prager", "cohesion": 1e6, "friction_angle": 30}


def deck_of(material):
    shape = {"type": "rectangle", "lower": [0, 0], "upper": [4, 4]}
    return {
        "cramp": 1,
        "analysis": "plane_stress",
        "grid": {"cell": 1},
        "materials": {"m": material},
        "bodies": [{"name": "b", "material": "m", "shape": shape}],
        "solver": {"end_time": 1},
    }


def material(data):
    return read(deck_of(data)).materials["m"]


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (METAL, "materials.m.hardening: is missing"),
        (
            METAL | {"hardening": {"type": "linar", "yield_stress": 1}},
            "materials.m.hardening.type: unknown type 'linar'; did you mean 'linear'?",
        ),
        (
            METAL | {"hardening": {"type": "linear", "yield_stress": "3 mm"}},
            "materials.m.hardening.yield_stress: '3 mm' is no stress; give Pa",
        ),
        (
            METAL
            | {"hardening": {"type": "voce", "yield_stress": 2, "saturation": 1, "strain": 1}},
            "materials.m.hardening.saturation: must be at least yield_stress, 2 Pa (got 1 Pa)",
        ),
        (
            METAL | {"hardening": COPPER | {"specific_heat": 383}},
            "materials.m.hardening.specific_heat: has no effect without melt; give T_melt too",
        ),
        (
            METAL | {"hardening": COPPER | {"melt": 280}},
            "materials.m.hardening.melt: must be above room, 293 K (got 280 K)",
        ),
        (
            METAL | {"hardening": COPPER | {"melt": 1356, "temperature": 1400}},
            "materials.m.hardening.temperature: must lie between room and melt, 293 K and 1356 K "
            "(got 1400 K)",
        ),
        (
            {"law": "mooney_rivlin", "density": 1, "C10": 3, "C01": 0.75, "K": 4},
            "materials.m.K: must be above 4 (C10 + C01)/3 = 5 Pa (got 4 Pa)",
        ),
        (
            WOOD | {"nu12": 3.2},
            "materials.m.nu12: must be below sqrt(E1/E2) = 3.16228 in size (got 3.2)",
        ),
        (WOOD | {"nu12": 2.5, "nu13": 3.0}, "materials.m: nu12, nu13 and nu23 are too large"),
        (WOOD | {"toughness": {"G_Ic": 1}}, "materials.m.toughness: unknown key"),
        (
            FIBRES | {"nu_axial": 2.1},
            "materials.m.nu_axial: must be below sqrt((1 - nu_transverse) E_axial / "
            "(2 E_transverse)) = 2.04939 in size (got 2.1)",
        ),
        (SOLID | {"law": "viscoelastic", "prony": []}, "materials.m.prony: must have at least 1"),
        (
            SOLID
            | {
                "law": "viscoelastic",
                "prony": [{"share": 0.6, "time": 1}, {"share": 0.6, "time": 2}],
            },
            "materials.m.prony: the shares must sum to at most 1 (got 1.2)",
        ),
        (
            SOLID | {"law": "viscoelastic", "prony": PRONY, "toughness": {"G_Ic": 1}},
            "materials.m.toughness: does not go with viscoelastic, where K is not known; remove it",
        ),
        (
            SOIL | {"dilation_angle": 40},
            "materials.m.dilation_angle: must be at most friction_angle (got 40 and 30 degrees)",
        ),
        (
            SOIL | {"cohesion": 0, "friction_angle": 0},
            "materials.m.cohesion: must be above 0 if friction_angle is 0 (got 0)",
        ),
    ],
)
def test_one_mistake(data, message):
    with pytest.raises(DeckError) as caught:
        material(data)
    (line,) = str(caught.value).splitlines()
    assert message in line


@pytest.mark.parametrize("fibres", ["in_plane", "normal"])
def test_a_transverse_solid_is_isotropic_across_its_fibres(fibres):
    """C22 - C23 = 2 G23 across fibres along 1; C11 - C12 = 2 G12 across fibres along 3."""
    law = law_of(material(FIBRES | {"fibres": fibres, "angle": 30}))
    across = 10e9 / (2.0 * 1.4)
    if fibres == "normal":
        assert pytest.approx(2.0 * law.G12, rel=1e-12) == law.C11 - law.C12
        assert pytest.approx(across, rel=1e-12) == law.G12
        assert pytest.approx(law.C13, rel=1e-12) == law.C23
    else:
        assert pytest.approx(2.0 * across, rel=1e-12) == law.C22 - law.C23
        assert law.C11 > 140e9
    compliance = np.linalg.inv(
        [[law.C11, law.C12, law.C13], [law.C12, law.C22, law.C23], [law.C13, law.C23, law.C33]]
    )
    place = 2 if fibres == "normal" else 0
    assert compliance[place, place] == pytest.approx(1.0 / 140e9, rel=1e-12)
    assert compliance[place, 1] == pytest.approx(-0.3 / 140e9, rel=1e-12)


def test_heat_of_johnson_and_cook():
    """T* = (T - T_room)/(T_melt - T_room); a joule warms by 0.9/(rho c)."""
    data = COPPER | {"melt": 1293, "temperature": 393, "specific_heat": 400}
    law = law_of(material(METAL | {"hardening": data})).hardening
    assert law.start == pytest.approx(0.1)
    assert law.heating == pytest.approx(0.9 / (1000 * 400 * 1000))


def test_the_history_is_as_wide_as_the_law_that_remembers_most():
    branches = [{"share": 0.1, "time": t} for t in (1, 2)]
    polymer = SOLID | {"law": "viscoelastic", "prony": branches}
    deck = deck_of(SOLID | {"law": "elastic"})
    assert build(read(deck))[1].particles.history.shape == (64, 0)
    right = {"type": "rectangle", "lower": [4, 0], "upper": [8, 4]}
    deck["materials"]["p"] = polymer
    deck["bodies"].append({"name": "right", "material": "p", "shape": right})
    assert build(read(deck))[1].particles.history.shape == (128, 2 + 6 * 2)
    assert memory(law_of(material(polymer))) == 14


def test_the_estimate_counts_the_history():
    """Two columns of 8 bytes for each of 16 cells of 4 particles."""
    metal = deck_of(METAL | {"hardening": {"type": "linear", "yield_stress": 1}})
    plain = deck_of(SOLID | {"law": "elastic"})
    sizes = [estimate(read(deck))["memory_bytes"] for deck in (metal, plain)]
    assert sizes[0] - sizes[1] == 64 * 2 * 8


def test_the_time_step_follows_the_stiffest_direction():
    """Fibres at any angle have the same wave speed, above sqrt(E_axial/rho)."""
    moduli = [confined_modulus(law_of(material(FIBRES | {"angle": a}))) for a in (0, 30, 90)]
    assert moduli == pytest.approx([moduli[0]] * 3, rel=1e-12)
    assert moduli[0] > 140e9


def test_every_field_can_be_asked_for_written_counted_and_drawn():
    assert set(get_args(OutputField)) == set(FIELDS) == set(FRAME_BYTES) == set(UNITS)


def test_a_checkpoint_keeps_what_the_laws_remember(tmp_path):
    """A run that goes on from it gives the same bits; the block yields from the first steps on."""
    metal = deck_of(METAL | {"hardening": {"type": "linear", "yield_stress": 1e6}})
    metal["bodies"][0]["angular_velocity"] = 100.0  # rad/s: the spin alone strains it
    model, state, scratch = build_deck(metal)
    advance(model, state, scratch, 20)
    write_state(tmp_path / "half.h5", state, {})
    advance(model, state, scratch, 20)
    again, _ = read_state(tmp_path / "half.h5", state)
    assert again.particles.history[:, PLASTIC_STRAIN].max() > 0.0
    advance(model, again, make_scratch(model, again), 20)
    np.testing.assert_array_equal(again.particles.history, state.particles.history)
    np.testing.assert_array_equal(again.particles.stress, state.particles.stress)
