"""Blocks cut from side to side whose halves hold together by traction laws alone."""

import numpy as np
import pytest
from support import advance, build_deck, read

from cramp_cli.cracks.cohesion import cohesive_energies, tractions_now
from cramp_cli.cracks.faces import lay_out_faces
from cramp_cli.energy_balance import Balance
from cramp_cli.state.measures import cauchy_stress

pytestmark = pytest.mark.verification
WIDE, HIGH, MIDDLE, SPEED = 0.008, 0.008, 0.004, 0.02  # m, m, m, m/s
BLOCK = """
cramp: 1
analysis: plane_strain
thickness: 2 mm
grid: {cell: 1 mm}
materials: {m: {law: elastic, density: 1000, E: 1 GPa, nu: 0}}
bodies: [{name: block, material: m,
  shape: {type: rectangle, lower: [0, 0], upper: [8 mm, 8 mm]}}]
cracks:
  - {name: cut, points: [[0, 4 mm], [8 mm, 4 mm]], start: edge, end: edge}
boundary:
  - {name: foot, where: {y: 0}, fix: [x, y]}
solver: {end_time: 1}
"""
PULL = {"name": "head", "where": {"y": HIGH}, "velocity": {"x": 0.0, "y": SPEED}}
SHEAR = {"name": "head", "where": {"y": HIGH}, "velocity": {"x": SPEED, "y": 0.0}}
FOOT = {"name": "foot", "where": {"y": 0.0}, "fix": ["x", "y"]}
ENDS = {"normal": {"peak": 1e5, "toughness": 2.0}}
KNEE = {"normal": {"openings": [4e-6, 1.2e-5, 6e-5], "stresses": [1e5, 4e4]}}
LAWS = {
    "triangular": {"law": "triangular", **ENDS},
    "exponential": {"law": "exponential", **ENDS},
    "cubic": {"law": "cubic", **ENDS},
    "trilinear": {"law": "trilinear", **KNEE},
}
G_KNEE = 0.5 * (1e5 * 1.2e-5 + 4e4 * (6e-5 - 4e-6))
EVERY_LAW = pytest.mark.parametrize("name", LAWS)


def cut(law, *boundary, contact="ignore", **more):
    """Return the deck of a block whose halves hold together by a law.

    contact: without it nothing but the law acts; contact of blocks that slide on a row of nodes
    begins to chatter by itself, without any law
    """
    crack = {"name": "cut", "points": [[0.0, MIDDLE], [WIDE, MIDDLE]], "start": "edge"}
    crack |= {"end": "edge", "traction": law, "contact": {"law": contact}}
    return {"cracks": [crack], "boundary": list(boundary) or [FOOT], **more}


def parted(law, head):
    """Run a block until its halves have parted; return model, state and the books."""
    deck = read(BLOCK, **cut(law, FOOT, head))
    model, state, scratch = build_deck(BLOCK, **cut(law, FOOT, head))
    books = Balance(state, deck.solver)
    while state.paths.damage.min() < 1.0:
        advance(model, state, scratch, 50)
        assert state.time < 0.02
    return model, state, books.row(model, state)


@EVERY_LAW
@pytest.mark.parametrize("head", [PULL, SHEAR], ids=["opening", "sliding"])
def test_full_debond_takes_the_toughness_of_the_cut(name, head):
    """Dissipated energy = G_c times length times thickness, and the books close with it."""
    model, state, row = parted(LAWS[name], head)
    toughness = G_KNEE if name == "trilinear" else 2.0
    assert row["cohesive_energy"] == pytest.approx(toughness * WIDE * 2e-3, rel=0.01)
    assert row["cohesive_stored"] == 0.0
    assert abs(row["energy_error"]) < 0.01
    mode = state.paths.spent.sum(axis=0) @ np.eye(2)[0 if head is PULL else 1]
    assert mode == pytest.approx(state.paths.spent.sum(), rel=1e-3)


STIFF = 1e9  # Pa/m
ELASTIC = {"law": "elastic", "normal": STIFF, "shear": STIFF}


@pytest.mark.parametrize(
    ("traction", "component"), [([0.0, 1e4], 1), ([1e4, 0.0], 0)], ids=["opening", "sliding"]
)
def test_patch_of_two_blocks_with_elastic_faces(traction, component):
    """Uniform load: opening = stress/k, stress as in a whole block (nu = 0; the head is pulled).

    Sliding: the block bends as well; only the mean over the faces is told by equilibrium.
    """
    load = {"type": "traction", "body": "block", "where": {"y": HIGH}, "traction": traction}
    load["in_time"] = {"type": "ramp", "until": 1e-4}
    deck = cut(
        ELASTIC, FOOT, contact="frictional", loads=[load], solver={"damping": {"particle": 1e4}}
    )
    model, state, scratch = build_deck(BLOCK, **deck)
    advance(model, state, scratch, 6000)
    drawn, length = tractions_now(model, state), lay_out_faces(state.paths).length
    mean = length @ drawn / length.sum()
    assert mean @ traction == pytest.approx(1e8, rel=5e-3)
    gap = state.paths.above - state.paths.below
    if component == 1:
        np.testing.assert_allclose(gap[:, 1], 1e4 / STIFF, rtol=5e-3)
        stress = cauchy_stress(state.particles)[:, 1, 1]
        np.testing.assert_allclose(stress, 1e4, rtol=0.01)
    held, spent = cohesive_energies(model, state)
    assert spent == 0.0
    assert held >= 0.5 * 1e4**2 / STIFF * WIDE * 2e-3 * 0.99


def test_forces_of_faces_leave_momentum_as_it_is():
    """Two free halves thrown apart: their sum of momenta stays to round-off."""
    model, state, scratch = build_deck(BLOCK, **cut(ELASTIC) | {"boundary": []})
    up = state.particles.position[:, 1] > MIDDLE
    state.particles.velocity[up] = (0.3, 1.0)
    before = state.particles.mass @ state.particles.velocity
    advance(model, state, scratch, 300)
    after = state.particles.mass @ state.particles.velocity
    size = np.abs(state.particles.mass @ np.abs(state.particles.velocity)).max()
    assert np.abs(after - before).max() < 1e-12 * size
    lower = state.particles.velocity[~up, 1].mean()
    assert lower > 0.05  # the law has drawn the lower half along


def test_a_stiff_law_shortens_the_step():
    """omega^2 is below 8 k/(rho h) beside waves, wherever the faces lie (test_stiff_faces.py)."""
    stiff = {"law": "elastic", "normal": 1e14}
    model, state, scratch = build_deck(BLOCK, **cut(stiff) | {"boundary": []})
    assert model.dt == pytest.approx(0.5 * np.sqrt(1000.0 * 1e-3 / 8e14), rel=1e-3)
    up = state.particles.position[:, 1] > MIDDLE
    state.particles.velocity[up] = (0.0, 1e-3)
    start = 0.5 * state.particles.mass @ (state.particles.velocity**2).sum(axis=1)
    advance(model, state, scratch, 3000)
    end = 0.5 * state.particles.mass @ (state.particles.velocity**2).sum(axis=1)
    assert end + cohesive_energies(model, state)[0] < 1.05 * start
