"""Geometry that can not be meant is a mistake of the deck, with its line, found by `check`."""

import json
import math

import pytest
import yaml
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from support import advance, read

from cramp_cli.build import build
from cramp_cli.commands import check_deck
from cramp_cli.cracks.tips import sample_tips
from cramp_cli.deck.deck import DeckError, read_deck
from cramp_cli.scratch import make_scratch

PLATE = """cramp: 1
analysis: plane_strain
grid: {lower: [-10 mm, -30 mm], upper: [50 mm, 30 mm], cell: 2 mm}
materials:
  glass: {law: elastic, density: 2500 kg/m^3, E: 70 GPa, nu: 0.2}
bodies:
  - name: plate
    material: glass
    shape: {type: rectangle, lower: [0, -20 mm], upper: [40 mm, 20 mm]}
cracks:
  - {name: notch, points: POINTS, start: edge, end: tip}
boundary:
  - {name: grip, where: {y: -20 mm}, fix: [y]}
loads:
  - {type: force, body: plate, where: {y: 20 mm}, total: [0, 10 kN]}
solver: {end_time: 20 us}
"""


def told(tmp_path, points, text=PLATE):
    """Return mistakes and warnings of the plate with a crack."""
    path = tmp_path / "plate.yaml"
    path.write_text(text.replace("POINTS", points), encoding="utf-8")
    try:
        return [str(one).removeprefix(f"{tmp_path}/") for one in read_deck(path).warnings]
    except DeckError as error:
        return [str(one).removeprefix(f"{tmp_path}/") for one in error.mistakes]


@pytest.mark.parametrize(
    ("points", "found"),
    [
        ("[[0, 0], [60 mm, 0]]", "points.1: (0.06, 0) m is outside the grid by 0.01 m"),
        ("[[0, 0], [15.3 m, 0]]", "points.1: (15.3, 0) m is outside the grid by 15.25 m"),
        ("[[0, 1 m], [15 mm, 0]]", "points.0: (0, 1) m is outside the grid by 0.97 m"),
        ("[[0, 0], [20 mm, 0], [10 mm, 0]]", "points: turns back at (0.02, 0) m"),
        ("[[0, 0], [20 mm, 0], [10 mm, 1 mm]]", "points: turns back at (0.02, 0) m"),
        (
            "[[0, 0], [20 mm, 0], [20 mm, 5 mm], [10 mm, 5 mm], [10 mm, 0], [16 mm, 0]]",
            "points: runs twice over the same way",
        ),
    ],
)
def test_lines_that_can_not_be_meant(tmp_path, points, found):
    assert any(
        line.startswith("plate.yaml:11:") and found in line for line in told(tmp_path, points)
    )


@pytest.mark.parametrize(
    "points",
    [
        "[[-5 mm, 0], [20 mm, 0]]",
        "[[0, 0], [10 mm, 0], [10.1 mm, 0.0 mm], [10.05 mm, 0.01 mm], [20 mm, 0]]",
        "[[0, 0], [20 mm, 0], [20 mm, 6 mm], [14 mm, 6 mm]]",
    ],
)
def test_lines_that_may_be_meant(tmp_path, points):
    """Beyond the edge within the grid; noise finer than a tenth of a cell; a hook."""
    assert told(tmp_path, points) == []


@pytest.mark.parametrize("held", ["fix: [y]", "fix: [x, y]", "velocity: {y: 0}"])
def test_a_held_ligament_is_told_of_symmetry(tmp_path, held):
    """The habit of finite elements: half a plate, its ligament held."""
    half = PLATE.replace("lower: [0, -20 mm], upper: [40 mm", "lower: [0, 0], upper: [40 mm")
    half = half.replace("{y: -20 mm}, fix: [y]", f"{{y: 0, x: [20 mm, 40 mm]}}, {held}")
    (found,) = told(tmp_path, "[[0, 0], [20 mm, 0]]", half)
    assert found.startswith("plate.yaml:13:")
    assert found.endswith("for half of a body say symmetry: true instead")
    assert told(tmp_path, "[[0, 0], [20 mm, 0]]", half.replace(held, "symmetry: true")) == []


SHIFTS = [0.0, 0.0, 1e-12, 1e-4, 0.001]
LENGTHS = [0.0, 0.0, 0.005, 0.01, 0.02, 0.04, 0.0153, 0.0401, 0.045, 0.06, 0.1, 15.3, 1e9]
numbers = st.builds(
    lambda size, sign, more: sign * size + more,
    st.sampled_from(LENGTHS), st.sampled_from([1, 1, -1]), st.sampled_from(SHIFTS),
)  # fmt: skip
sizes = numbers.map(abs)
points = st.tuples(numbers, numbers).map(list)
plates = st.just({"type": "rectangle", "lower": [0.0, -0.02], "upper": [0.04, 0.02]})
disks = st.builds(lambda c, r: {"type": "disk", "center": c, "radius": r}, points, sizes)
shapes = st.one_of(
    plates,
    plates,
    st.builds(lambda a, b: {"type": "rectangle", "lower": a, "upper": b}, points, points),
    disks,
    st.lists(points, min_size=3, max_size=5).map(lambda p: {"type": "polygon", "points": p}),
    st.builds(lambda of, cut: {"type": "difference", "of": of, "minus": [cut]}, plates, disks),
)  # fmt: skip
lines = st.one_of(
    st.lists(points, min_size=2, max_size=4).map(lambda p: {"points": p}),
    st.builds(
        lambda c, r, to: {"arc": {"center": c, "radius": r, "from": 0, "to": to}},
        points, sizes, st.sampled_from([-90, 180, 360]),
    ),
)  # fmt: skip
ends = st.sampled_from(["tip", "tip", "edge", "plain"])
cracks = st.builds(lambda line, a, b: line | {"start": a, "end": b}, lines, ends, ends)
planes = st.builds(lambda axis, at: {axis: at}, st.sampled_from("xy"), numbers)
acts = st.sampled_from(
    [{"fix": ["y"]}, {"symmetry": True}, {"absorbing": True}, {"velocity": {"x": 1.0}}]
)


def absurd(shape, other, hole, lines, where, act, load, cell, boxed, radius):
    """Return a deck of parts that need not fit together."""
    bodies = [{"name": "plate", "material": "glass", "shape": shape}]
    if other:
        bodies.append(
            {"name": "more", "shape": other} | ({"hole": True} if hole else {"material": "glass"})
        )
    box = {"lower": [-0.01, -0.03], "upper": [0.05, 0.03]} if boxed and cell < 0.01 else {}
    deck = yaml.safe_load(PLATE.replace("POINTS", "[]")) | {
        "bodies": bodies,
        "cracks": [{"name": f"c{n}"} | line for n, line in enumerate(lines)],
        "boundary": [{"where": where} | act] if where else [],
        "loads": [{"type": "force", "body": "plate", "where": load, "total": [0, 1]}]
        if load
        else [],
        "grid": {"cell": cell} | box,
    }
    return deck | ({"fracture": {"radius": radius}} if radius else {})


decks = st.builds(
    absurd, shapes, st.none() | shapes, st.booleans(), st.lists(cracks, max_size=2),
    st.none() | planes, acts, st.none() | planes, st.sampled_from([0.002, 0.002, 0.005, 0.02, 0.1]),
    st.booleans(), st.none() | sizes,
)  # fmt: skip


@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(decks)
def test_an_absurd_deck_is_checked_to_an_answer(tmp_path_factory, deck):
    """Every mistake stands in a line; what has none is a model of finite numbers."""
    path = tmp_path_factory.getbasetemp() / "absurd.yaml"
    path.write_text(json.dumps(deck, indent=1), encoding="utf-8")
    answer = check_deck(path, (), strict=False, report=False)
    assert answer["valid"] == (not answer["mistakes"])
    assert all(line.startswith(f"{path}:") for line in answer["mistakes"])


@settings(max_examples=15, deadline=None, suppress_health_check=list(HealthCheck))
@given(
    st.lists(st.tuples(st.floats(-9.0, 49.0), st.floats(-29.0, 29.0)), min_size=2, max_size=3), ends
)
def test_a_tip_anywhere_in_the_grid_has_a_row(points, end):
    """Also in free space, beside a corner, along an edge: numbers or nan with a word, no fault."""
    points = [[1e-3 * x, 1e-3 * y] for x, y in points]
    deck = yaml.safe_load(PLATE.replace("POINTS", json.dumps(points)))
    deck["cracks"][0] |= {"start": end}
    deck["grid"]["upper"] = ["110 mm", "30 mm"]
    try:
        model, state = build(read(deck))
    except DeckError:
        return
    scratch = make_scratch(model, state)
    advance(model, state, scratch, 2)
    for row in sample_tips(model, state, scratch):
        assert row["status"] != "ok" or math.isfinite(row["J"])
