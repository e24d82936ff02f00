"""What a tip does at an interface: into the other material, along it, or on as if it were free."""

from math import inf, radians

import numpy as np
import pytest
from support import build_deck

from cramp_cli.cracks.criteria.load import Load
from cramp_cli.cracks.interface import CLEAR, choose_course
from cramp_cli.cracks.site import site_of
from cramp_cli.cracks.tips import tips_of

DECK = """
cramp: 1
analysis: plane_strain
grid: {cell: 1, lower: [-2, -2], upper: [22, 22]}
materials:
  soft: {law: elastic, density: 1, E: 1, nu: 0.25, toughness: {G_Ic: 1}}
  hard: {law: elastic, density: 1, E: 1, nu: 0.25, toughness: {G_Ic: 9}}
bodies:
  - {name: plate, material: soft, shape: {type: rectangle, lower: [0, 0], upper: [20, 20]}}
  - {name: ball, material: hard, shape: {type: disk, center: [12, 10.5], radius: 3}}
cracks: [{name: c, points: [[0, 10.5], [8, 10.5]], start: edge}]
solver: {end_time: 1}
propagation: {criterion: max_hoop_stress}
"""
HEAD_ON = (8.0, 10.5)
FAR = (5.0, 10.5)


def course(K_II=0.0, wanted=0.0, tip=HEAD_ON, **sections):
    """Return the course of a tip of unit K_I that points along x."""
    cracks = [{"name": "c", "points": [[0, tip[1]], list(tip)], "start": "edge"}]
    model, state, scratch = build_deck(DECK, cracks=cracks, **sections)
    site = site_of(model, state, scratch, tips_of(state.paths)[0])
    load = Load(1.0, K_II, 1.0)
    return choose_course(model, site, np.array(tip), (1.0, 0.0), load, wanted)


def toughness_of_hard(G_Ic):
    return {"hard": {"law": "elastic", "density": 1, "E": 1, "nu": 0.25} | G_Ic}


def test_far_from_other_materials_the_criterion_decides():
    assert course(tip=FAR, wanted=0.3) == (0.3, 0.0)


@pytest.mark.parametrize("K_II", [0.1, -0.1])
def test_a_tough_inclusion_is_gone_round_on_the_side_of_the_sliding(K_II):
    """G falls to a quarter when a crack turns by 90 degrees, so nine times the toughness deters."""
    turn, cost = course(K_II)
    assert radians(30.0) < abs(turn) < radians(100.0)
    assert turn * K_II < 0.0
    assert cost == 1.0  # the bond has the toughness of the weaker side


def test_mirrored_loads_take_mirrored_ways():
    left, right = course(-0.1), course(0.1)
    assert left.turn == pytest.approx(-right.turn, abs=1e-9)


def test_a_weak_inclusion_is_entered():
    """It costs half of the matrix; along it the kink would release less."""
    weak = toughness_of_hard({"toughness": {"G_Ic": 0.5}})
    assert course(materials=weak) == (0.0, 0.5)


def test_a_material_that_does_not_break_is_never_entered():
    turn, cost = course(materials={"hard": {"toughness": {"G_Ic": 1e30}}})
    assert abs(turn) > radians(30.0)
    assert cost < inf


def test_a_weak_bond_draws_a_crack_that_would_pass():
    """Beside the ball, leaving it: the bond costs a tenth of the matrix."""
    tip, away = (12.0, 14.4), 0.2
    assert course(tip=tip, wanted=away) == (away, 0.0)
    bond = [{"between": ["hard", "soft"], "G_Ic": 0.1}]
    turn, cost = course(tip=tip, wanted=away, interfaces=bond)
    assert turn < away
    assert cost == 0.1


def test_the_way_along_keeps_its_distance():
    turn, _ = course(0.1)
    ahead = np.array(HEAD_ON) + 0.75 * np.array([np.cos(turn), np.sin(turn)])
    model, state, _ = build_deck(DECK)
    hard = next(block for block in model.blocks if block.material == "hard")
    places = state.particles.origin[hard.lo : hard.hi]
    assert np.hypot(*(places - ahead).T).min() >= CLEAR
