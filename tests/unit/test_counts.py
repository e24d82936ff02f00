"""What a deck makes is counted before it is made: too much of it is a mistake at once."""

import json
import time

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import TypeAdapter
from shapely import union_all

from cramp_cli.deck.assembly import MOST_PIECES, union_of
from cramp_cli.deck.deck import DeckError, read_deck
from cramp_cli.deck.shapes import AnyShape
from cramp_cli.deck.sweep import read_study
from cramp_cli.study.cases import expand

HEAD = """cramp: 1
analysis: plane_stress
grid: {cell: 1 mm}
materials: {m: {law: elastic, density: 1000, E: 1 GPa, nu: 0.3}}
solver: {end_time: 1 us}
bodies:
"""
DISK = "{type: disk, center: [5 mm, 5 mm], radius: 1 mm}"
BORE = "{type: disk, center: [5 mm, 5 mm], radius: 0.1 mm}"
SHAPES = TypeAdapter(AnyShape)


def copies(shape, nx=2, ny=2):
    return f"{{type: array, of: {shape}, count: [{nx}, {ny}], spacing: [3 mm, 3 mm]}}"


def mistakes(tmp_path, *shapes):
    path = tmp_path / "d.yaml"
    rows = [f"  - {{name: b{n}, material: m, shape: {shape}}}\n" for n, shape in enumerate(shapes)]
    path.write_text(HEAD + "".join(rows), encoding="utf-8")
    begun = time.perf_counter()
    with pytest.raises(DeckError) as caught:
        read_deck(path)
    assert time.perf_counter() - begun < 5.0
    return [f"{one.shown_path}: {one.message}" for one in caught.value.mistakes]


def test_arrays_of_arrays_are_multiplied_out(tmp_path):
    shape = DISK
    for _ in range(18):
        shape = copies(shape)
    (found,) = mistakes(tmp_path, shape)
    assert found.endswith(
        "makes 4 copies of 65536 shapes, 262144 in all; at most 100000 are possible"
    )


@pytest.mark.parametrize(
    "shape",
    [
        copies(f"{{type: union, of: [{', '.join([copies(DISK, 300, 300)] * 2)}]}}", 2, 1),
        copies(f"{{type: difference, of: {DISK}, minus: [{copies(BORE, 100, 100)}]}}", 4, 4),
        copies("{type: pack, inside: {type: disk, center: [0, 0], radius: 1}, radius: 9 mm, "
               "count: 1000}", 100, 2),
    ],
)  # fmt: skip
def test_all_kinds_of_shapes_in_an_array_count(tmp_path, shape):
    (found,) = mistakes(tmp_path, shape)
    assert "in all; at most 100000 are possible" in found


def test_bodies_count_together(tmp_path):
    (found,) = mistakes(tmp_path, *[copies(DISK, 200, 200)] * 3)
    text = "b2.shape: the shapes of all bodies have 120000 pieces up to this one"
    assert found == f"bodies.{text}; at most {MOST_PIECES} are possible"


def test_more_disks_than_ever_find_room_are_not_thrown(tmp_path):
    """Random sequential addition of equal disks jams at 0.547 (Feder 1980)."""
    box = "{type: rectangle, lower: [0, 0], upper: [1, 1]}"
    pack = f"{{type: pack, inside: {box}, radius: 3 mm, count: 19800}}"
    (found,) = mistakes(tmp_path, pack)
    assert "19800 disks of this size would fill 0.560 of the region" in found


def test_cases_of_a_study_are_counted(tmp_path):
    values = list(range(40))
    vary = [
        {"type": "grid", "over": {"a": values, "b": values}},
        {"type": "zip", "over": {"c": values, "d": values}},
        {"type": "list", "cases": [{"e": 1}, {"e": 2}]},
    ]
    text = json.dumps({"cramp_sweep": 1, "deck": "none.yaml", "vary": vary})
    path = tmp_path / "s.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(DeckError, match="vary: makes 128000 cases; at most 100000 are possible"):
        expand(read_study(path))


places = st.tuples(*[st.integers(0, 600).map(lambda n: 0.01 * n)] * 2)
disks = st.builds(
    lambda c, r: {"type": "disk", "center": c, "radius": r}, places, st.floats(0.1, 2)
)
boxes = st.builds(
    lambda c, w, h: {"type": "rectangle", "lower": c, "upper": [c[0] + w, c[1] + h]},
    places,
    st.floats(0.1, 2.0),
    st.floats(0.1, 2.0),
)


@settings(max_examples=100, deadline=None)
@given(st.lists(disks | boxes, min_size=1, max_size=8), st.integers(0, 2**32 - 1))
def test_a_union_is_that_of_all_pieces(pieces, seed):
    """Overlaid only where pieces touch, asked only near them: the same region, the same points."""
    shape = SHAPES.validate_python({"type": "union", "of": pieces})
    outlines = [piece.outline() for piece in shape.of]
    found, right = union_of(outlines), union_all(outlines)
    assert found.is_valid
    assert found.symmetric_difference(right).area < 1e-12
    points = np.random.default_rng(seed).uniform(-1.0, 9.0, (500, 2))
    points = np.concatenate([points, [corner for p in shape.of for corner in p.bounds()]])
    assert (shape.contains(points) == np.any([p.contains(points) for p in shape.of], axis=0)).all()
