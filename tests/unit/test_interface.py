"""What a tip does at an interface: into the other material, along it, or on as if it were free."""

from dataclasses import replace
from math import cos, inf, radians, sin

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from support import build_deck

from cramp_cli.cracks.criteria.load import Load
from cramp_cli.cracks.interface import CLEAR, choose_course
from cramp_cli.cracks.kink import kinked
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


PLANE = """
cramp: 1
analysis: plane_strain
grid: {cell: 1, lower: [-2, -2], upper: [26, 26]}
materials:
  left: {law: elastic, density: 1, E: 1, nu: 0.3, toughness: {G_Ic: 1}}
  right: {law: elastic, density: 1, E: 1, nu: 0.3, toughness: {G_Ic: 1}}
bodies:
  - {name: l, material: left, shape: {type: rectangle, lower: [0, 0], upper: [12, 24]}}
  - {name: r, material: right, shape: {type: rectangle, lower: [12, 0], upper: [24, 24]}}
cracks: [{name: c, points: [[0, 12.5], [10.6, 12.5]], start: edge}]
interfaces: [{between: [left, right], G_Ic: 0.5}]
solver: {end_time: 1}
propagation: {criterion: max_energy_release_rate}
"""


def threshold(tip, turned=0.0, ahead=1.0):
    """Return the toughness of a weak plane over that of the solid at which a crack turns into it.

    turned: direction of the crack (rad); ahead: E of the solid behind the plane over that before it
    """
    heading = np.array((cos(turned), sin(turned)))
    asked = [at_tip(np.array(tip) + way * heading, heading, ahead) for way in (0.0, 0.5, 1.0)]
    low, high = 0.0, 1.0
    for _ in range(12):
        middle = 0.5 * (low + high)
        turns = next((t for t in (ask(middle) for ask in asked) if t is not None), 0.0)
        low, high = (middle, high) if turns else (low, middle)
    return low


def at_tip(tip, heading, ahead):
    """Return what tells the turn at a tip for a toughness of the plane; None where it goes on."""
    length = 0.5 + min(x / h for x, h in zip(tip, heading, strict=True) if h > 0.01)
    start = tip - length * heading  # just beyond the left or the lower border of the body
    cracks = [{"name": "c", "points": [start.tolist(), tip.tolist()]}]
    cracks[0]["start"] = "edge"
    materials = {"right": {"E": ahead}}
    model, state, scratch = build_deck(PLANE, cracks=cracks, materials=materials)
    site = site_of(model, state, scratch, tips_of(state.paths)[0])

    def ask(toughness):
        bond = {frozenset(("left", "right")): toughness}
        changed = replace(model, propagation=replace(model.propagation, interfaces=bond))
        course = choose_course(changed, site, tip, tuple(heading), Load(1.0, 0.0, 1.0), 0.0)
        return course.turn if course.cost else None

    return ask


@settings(max_examples=15, deadline=None)
@given(st.floats(0.0, 0.49), st.floats(0.0, 1.0))
def test_a_square_hit_turns_below_a_quarter_of_the_toughness(x, y):
    """He and Hutchinson (1989): 0.26 for equal solids, wherever the tip lies in its cell."""
    assert threshold((10.76 + x, 12.0 + y)) == pytest.approx(0.26, abs=0.03)


@pytest.mark.parametrize("degrees", [30.0, 45.0, 60.0])
def test_an_oblique_hit_turns_sooner(degrees):
    """The kink into the plane is smaller: G of the angle between crack and plane."""
    k_I, k_II = kinked(1.0, 0.0, radians(90.0 - degrees))
    tip = (11.0, 12.5)
    expected = k_I**2 + k_II**2
    assert threshold(tip, radians(degrees)) == pytest.approx(expected, abs=0.04)


@pytest.mark.parametrize(("alpha", "expected"), [(-0.5, 0.286), (0.25, 0.308), (0.5, 0.421)])
def test_a_stiffer_solid_behind_the_plane_deflects(alpha, expected):
    """Finite elements: tests/verification/reference/deflection.py."""
    ahead = (1.0 + alpha) / (1.0 - alpha)
    assert threshold((11.0, 12.5), ahead=ahead) == pytest.approx(expected, abs=0.03)
