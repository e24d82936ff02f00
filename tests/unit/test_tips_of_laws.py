"""K_I and K_II belong to an isotropic elastic solid: the status tells of other ones."""

from math import isnan

import pytest
from support import advance, build_deck

from cramp_cli.cracks.tips import sample_tips
from cramp_cli.state.particles import DISSIPATED

SOLID = {"density": 1, "E": 1, "nu": 0.3}
PRONY = [{"share": 0.5, "time": 10}]
METAL = SOLID | {"law": "j2_plastic", "hardening": {"type": "linear", "yield_stress": 100}}
FIBRES = {
    "law": "transverse", "density": 1, "E_axial": 3, "E_transverse": 1, "nu_axial": 0.3,
    "nu_transverse": 0.3, "G_axial": 1,
}  # fmt: skip
DECK = """
cramp: 1
analysis: plane_stress
grid: {cell: 1}
bodies: [{name: b, material: m, shape: {type: rectangle, lower: [0, 0], upper: [20, 20]}}]
cracks: [{name: c, points: [[0, 10], [10, 10]], start: edge}]
loads:
  - {type: traction, body: b, where: {y: 20}, traction: [0, 1.0e-3]}
  - {type: traction, body: b, where: {y: 0}, traction: [0, -1.0e-3]}
solver: {end_time: 1000}
"""


def tip_in(material, steps=60, dissipated=0.0):
    """Return the row of the tip after some steps; a part of the work is said to be dissipated."""
    model, state, scratch = build_deck(DECK, materials={"m": material})
    advance(model, state, scratch, steps)
    if dissipated:
        state.particles.history[:, DISSIPATED] = dissipated * state.particles.work
    (row,) = sample_tips(model, state, scratch)
    return row


@pytest.mark.parametrize("material", [FIBRES, SOLID | {"law": "viscoelastic", "prony": PRONY}])
def test_no_K_without_isotropic_elastic_constants(material):
    row = tip_in(material)
    assert "K invalid: the stiffness of the material depends on direction or time" in row["status"]
    assert all(isnan(row[name]) for name in ("K_I", "K_II", "K_I_contour", "K_II_contour"))
    assert row["J"] > 0.0
    assert row["J_contour"] > 0.0


def test_a_metal_that_has_not_yielded_is_elastic():
    """To round-off of sums over the domain: K_II is one of far larger numbers."""
    metal, elastic = tip_in(METAL), tip_in(SOLID | {"law": "elastic"})
    assert metal["status"] == elastic["status"] == "ok"
    for name in ("J", "K_I", "J_contour", "K_I_contour"):
        assert metal[name] == pytest.approx(elastic[name], rel=1e-12)
    assert metal["K_II"] == pytest.approx(elastic["K_II"], abs=1e-12 * elastic["K_I"])


def test_plastic_work_around_the_tip_is_told():
    row = tip_in(METAL, dissipated=0.3)
    assert row["status"].endswith(
        "doubtful: plastic or viscous strain took 30 % of the work around the tip"
    )
    assert "plastic" not in tip_in(METAL, dissipated=0.005)["status"]
