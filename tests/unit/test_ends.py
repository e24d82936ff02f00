"""What the ends of cracks are: chosen by where they lie, and words that contradict it."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from support import read

from cramp_cli.build.estimate import estimate
from cramp_cli.deck.deck import DeckError

PLATE = """
cramp: 1
analysis: plane_strain
grid: {cell: 1 mm}
materials: {m: {law: elastic, density: 1000, E: 1 GPa, nu: 0.25}}
bodies:
  - {name: plate, material: m, shape: {type: rectangle, lower: [0, 0], upper: [40 mm, 20 mm]}}
  - {name: bore, hole: true, shape: {type: disk, center: [30 mm, 10 mm], radius: 4 mm}}
solver: {end_time: 1 us}
"""
MM = 1e-3


def ends(*lines, **sections):
    """Return what the deck takes the ends of cracks to be; lines: points in mm, and more keys."""
    cracks = [
        {"name": f"c{n}", "points": [[x * MM, y * MM] for x, y in points], **more}
        for n, (points, more) in enumerate(lines)
    ]
    deck = read(PLATE, cracks=cracks, **sections)
    return [(crack.start, crack.end) for crack in deck.cracks], deck


@pytest.mark.parametrize(
    ("points", "wanted"),
    [
        (((5, 5), (15, 5)), ("tip", "tip")),
        (((0, 5), (15, 5)), ("edge", "tip")),  # at the surface
        (((-3, 5), (15, 5)), ("edge", "tip")),  # beyond it
        (((0.4, 5), (15, 5)), ("edge", "tip")),  # a ligament of less than half a cell
        (((0.6, 5), (15, 5)), ("tip", "tip")),
        (((20, 10), (26, 10)), ("tip", "edge")),  # at a hole
        (((20, 10), (30, 10)), ("tip", "edge")),  # in it
        (((5, -1), (5, 21)), ("edge", "edge")),
    ],
)
def test_ends_of_one_crack(points, wanted):
    found, _ = ends((points, {}))
    assert found == [wanted]


@given(st.integers(-1000, 3000))
def test_a_word_that_auto_chooses_is_no_mistake(depth):
    """depth: inside the surface, in thousandths of a cell."""
    found, deck = ends((((depth / 1000, 5), (15, 5)), {}))
    again = read(deck.resolved())
    assert [(crack.start, crack.end) for crack in again.cracks] == found


@pytest.mark.parametrize("word", ["edge", "tip"])
@pytest.mark.parametrize("depth", [0.11, 0.4, 0.6, 1.0])
def test_near_the_surface_a_deck_may_say_either_word(word, depth):
    """dcb.yaml has its edge a quarter of a cell inside, or a whole cell of a grid four times finer.

    There 40 mm - 39 mm is more than 1 mm by round-off.
    """
    found, _ = ends((((15, 5), (40 - depth, 5)), {"end": word}))
    assert found == [("tip", word)]


@pytest.mark.parametrize(("word", "depth"), [("edge", 1.01), ("tip", 0.09)])
def test_further_in_it_is_no_edge_nearer_it_is_no_tip(word, depth):
    with pytest.raises(DeckError, match=f"'{word}' "):
        ends((((15, 5), (40 - depth, 5)), {"end": word}))


def test_an_end_in_a_held_plane_is_a_tip():
    """Half of a plate with its ligament held: a warning tells of symmetry, no word is wrong."""
    held = [{"where": {"y": 0, "x": [0.015, 0.04]}, "fix": ["y"]}]
    for more in ({}, {"start": "edge", "end": "tip"}):
        found, deck = ends((((0, 0), (15, 0)), more), boundary=held)
        assert found == [("edge", "tip")]
        (warning,) = deck.warnings
        assert "for half of a body say symmetry: true" in warning.message


def test_an_end_at_a_plane_that_is_held_but_not_followed_is_at_the_surface():
    found, _ = ends((((0, 5), (15, 5)), {}), boundary=[{"where": {"x": 0}, "fix": ["x"]}])
    assert found == [("edge", "tip")]


@pytest.mark.parametrize("off", [0.0, 0.05, -0.05])
def test_an_end_on_another_crack_is_a_junction(off):
    lines = [(((5, 5), (15, 5)), {}), (((10, 5 + off), (10, 12)), {})]
    found, deck = ends(*lines)
    assert found == [("tip", "tip"), ("junction", "tip")]
    told = estimate(deck)
    assert told["crack c0"] == "start: tip, end: tip"
    assert told["crack c1"] == "start: junction with c0, end: tip"


def test_an_end_near_another_crack_is_a_tip():
    found, _ = ends((((5, 5), (15, 5)), {}), (((10, 5.2), (10, 12)), {}))
    assert found[1] == ("tip", "tip")


@pytest.mark.parametrize(
    ("points", "wanted"),
    [
        (((0, 5), (15, 5)), ("edge", "tip")),  # meets the plane: goes on in the image
        (((5, 0), (15, 0)), ("tip", "tip")),  # lies in the other one
        (((0, 0), (15, 0)), ("edge", "tip")),  # lies in one and meets the other
        (((25, 0), (40, 0)), ("tip", "edge")),  # lies in it and leaves the body
    ],
)
def test_ends_on_symmetry_planes(points, wanted):
    planes = [{"where": {"x": 0}, "symmetry": True}, {"where": {"y": 0}, "symmetry": True}]
    found, deck = ends((points, {}), boundary=planes)
    assert found == [wanted]
    if points[0][0] == 0:
        assert estimate(deck)["crack c0"].startswith("start: edge on the symmetry plane x = 0 m")


@pytest.mark.parametrize(
    ("points", "more", "trouble"),
    [
        (
            ((12, 5), (30, 5)),
            {"start": "edge", "end": "plain"},
            "'edge' is 0.005 m inside the body",
        ),
        (((0, 5), (15, 5)), {"start": "tip"}, "'tip' lies at the surface of the body"),
        (((-3, 5), (15, 5)), {"start": "tip"}, "'tip' lies outside every body"),
        (((0, 5), (15, 5)), {"start": "plain"}, "'plain' lies at the surface of the body"),
        (((5, 5), (15, 5)), {"end": "junction"}, "'junction' lies on no other crack"),
        (((5, 5), (10, 15)), {"end": "tip"}, "'tip' lies on crack c1; write 'junction' or 'auto'"),
        (((5, 5), (10, 15)), {"end": "edge"}, "'edge' lies on crack c1; write 'junction'"),
    ],
)
def test_words_that_contradict_geometry(points, more, trouble):
    with pytest.raises(DeckError) as caught:
        ends((points, more), (((5, 15), (15, 15)), {}))
    (line,) = str(caught.value).splitlines()
    key = "start" if "start" in more else "end"
    assert line.startswith(f"test:1:1: cracks.c0.{key}: ") or f"cracks.c0.{key}: " in line
    assert trouble in line


def test_a_tip_on_a_symmetry_plane_is_a_mistake():
    planes = [{"where": {"x": 0}, "symmetry": True}]
    with pytest.raises(DeckError, match="'tip' lies on the symmetry plane x = 0 m; write 'edge'"):
        ends((((0, 5), (15, 5)), {"start": "tip"}), boundary=planes)


def test_plain_ends_may_lie_anywhere_inside_and_on_cracks():
    plain = {"start": "plain", "end": "plain"}
    found, _ = ends((((5, 5), (15, 5)), plain), (((10, 5), (10, 12)), plain))
    assert found == [("plain", "plain"), ("plain", "plain")]


def test_a_deck_with_its_ends_chosen_reads_back():
    found, deck = ends((((0, 5), (15, 5)), {}), (((10, 5), (10, 12)), {}))
    again = read(deck.resolved())
    assert [(crack.start, crack.end) for crack in again.cracks] == found


def test_bodies_that_touch_have_surfaces_of_their_own():
    """An edge where two bodies touch is inside neither of them; glued by default it is inside."""
    upper = {
        "name": "upper", "material": "m",
        "shape": {"type": "rectangle", "lower": [0, 0.02], "upper": [0.04, 0.04]},
    }  # fmt: skip
    bodies = [read(PLATE).resolved()["bodies"][0], upper]
    touching = {"bodies": {"law": "frictional"}}
    line = (((10, 20), (10, 8)), {})
    found, _ = ends(line, bodies=bodies, contact=touching)
    assert found == [("edge", "tip")]
    found, _ = ends(line, bodies=bodies)
    assert found == [("tip", "tip")]
