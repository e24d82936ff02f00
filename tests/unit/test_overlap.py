"""Faces that lie in each other: no tip grows there, and no number of them is ok."""

import pytest
from support import advance, advance_growing, build_deck

from cramp_cli.cracks.tips import sample_tips

PLATE = """
cramp: 1
analysis: plane_strain
grid: {cell: 0.1}
materials:
  m:
    law: elastic
    density: 1
    E: 1
    nu: 0.3
    toughness: {K_Ic: 1.0e-6, K_IIc: 1.0e-6, delta_Ic: 1.0e-6, delta_IIc: 1.0e-6}
bodies: [{name: p, material: m, shape: {type: rectangle, lower: [-1.2, -1.2], upper: [1.2, 1.2]}}]
cracks: [{name: c, points: [[-0.5, 0.02], [0.5, 0.02]], contact: {law: ignore}}]
loads:
- {type: traction, body: p, where: {y: 1.2}, traction: [0, -0.001], in_time: {type: ramp, until: 1}}
- {type: traction, body: p, where: {y: -1.2}, traction: [0, 0.001], in_time: {type: ramp, until: 1}}
solver: {end_time: 100}
fracture: {methods: [domain]}
"""
STEPS = 60  # the waves have passed the crack
INCLINED = [{"name": "c", "points": [[-0.4, -0.38], [0.4, 0.42]], "contact": {"law": "ignore"}}]
CRITERIA = [
    {"criterion": "max_hoop_stress"},
    {"criterion": "max_energy_release_rate"},
    {"criterion": "strain_energy_density"},
    {"criterion": "empirical"},
    {"criterion": "critical_J"},
    {"criterion": "critical_J", "speed": {"law": "energy_balance"}},
    {"criterion": "max_ctod"},
    {"criterion": "steady_state", "speed": {"law": "prescribed", "value": 0.3}},
]


def statuses(model, state, scratch):
    return [row["status"] for row in sample_tips(model, state, scratch)]


@pytest.mark.parametrize("cracks", [None, INCLINED], ids=["straight", "inclined"])
@pytest.mark.parametrize("rule", CRITERIA, ids=lambda rule: "-".join(map(str, rule.values()))[:30])
def test_no_criterion_lets_a_tip_grow_on_faces_that_overlap(rule, cracks):
    """With critical_J both tips ran through the plate, at half the speed of sound."""
    more = {"cracks": cracks} if cracks else {}
    model, state, scratch = build_deck(PLATE, propagation=rule, **more)
    advance_growing(model, state, scratch, STEPS)
    assert state.growth.length.max() == 0.0
    assert state.growth.load[:, 0].min() > 1e-9
    assert all("doubtful: the faces overlap" in one for one in statuses(model, state, scratch))


def test_the_same_plate_under_tension_lets_it_grow():
    loads = [
        {"type": "traction", "body": "p", "where": {"y": y}, "traction": [0, pull]}
        for y, pull in ((1.2, 1e-3), (-1.2, -1e-3))
    ]
    model, state, scratch = build_deck(PLATE, loads=loads, propagation={"criterion": "critical_J"})
    advance_growing(model, state, scratch, STEPS)
    assert state.growth.length.min() > 0.0


@pytest.mark.parametrize("law", ["frictional", "stick"])
@pytest.mark.parametrize("cracks", [None, INCLINED], ids=["straight", "inclined"])
def test_faces_in_contact_touch_and_do_not_overlap(law, cracks):
    """Inclined by 45 degrees they are stairs, which lie in each other by up to 0.45 strains."""
    crack = dict((cracks or [{"name": "c", "points": [[-0.5, 0.02], [0.5, 0.02]]}])[0])
    crack["contact"] = {"law": law}
    model, state, scratch = build_deck(PLATE, cracks=[crack])
    advance(model, state, scratch, STEPS)
    assert not any("overlap" in one for one in statuses(model, state, scratch))


def test_faces_that_overlap_far_from_an_open_tip_are_told_too():
    """A bar bent: open at its lower edge, pressed together at its upper one."""
    crack = {"name": "c", "points": [[0.02, -0.9], [0.02, 1.0]], "contact": {"law": "ignore"}}
    loads = [
        {"type": "traction", "body": "p", "where": where, "traction": [pull, 0]}
        for x in (-1.2, 1.2)
        for where, pull in (
            ({"x": x, "y": [0, 1.2]}, -1e-3 if x > 0 else 1e-3),
            ({"x": x, "y": [-1.2, 0]}, 1e-3 if x > 0 else -1e-3),
        )
    ]
    model, state, scratch = build_deck(PLATE, cracks=[crack], loads=loads)
    advance(model, state, scratch, 80)
    start, end = statuses(model, state, scratch)
    assert "the faces overlap away from the tip" in start
    assert "the faces overlap at the tip" in end
