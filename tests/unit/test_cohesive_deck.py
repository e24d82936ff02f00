"""What a deck says about traction laws, and every mistake in it."""

import numpy as np
import pytest
from support import build_deck

from cramp_cli.build.cohesion import traction_law
from cramp_cli.cohesive.law import strength, work
from cramp_cli.cracks.extend import add_point, cover_end
from cramp_cli.cracks.faces import lay_out_faces
from cramp_cli.deck.deck import DeckError, read_deck

DECK = """\
cramp: 1
analysis: plane_strain
grid: {cell: 1}
materials: {m: {law: elastic, density: 1, E: 1, nu: 0.25, toughness: {K_Ic: 2}}}
bodies: [{name: plate, material: m, shape: {type: rectangle, lower: [0, 0], upper: [20, 10]}}]
cracks:
  - name: cut
    points: [[0, 5], [8, 5]]
    start: edge
    traction: {law: triangular, normal: {peak: 2, toughness: 3}}
solver: {end_time: 1}
"""


@pytest.fixture
def deck(tmp_path):
    def one(*overrides):
        path = tmp_path / "d.yaml"
        path.write_text(DECK, encoding="utf-8")
        return read_deck(path, overrides)

    return one


def law_of(deck, text):
    return traction_law(deck(f"cracks.cut.traction={text}").cracks[0].traction)


ENDS = ("peak: 2, toughness: 3", "peak: 2, opening: {d}", "toughness: 3, opening: {d}")
CRITICAL = {"triangular": 3.0, "cubic": 16.0 / 9.0 * 1.5, "exponential": None}
STIFF = ("", ", stiffness: 2.5")


@pytest.mark.parametrize("stiffness", STIFF)
@pytest.mark.parametrize("kind", ["triangular", "exponential"])
def test_two_of_three_give_the_third(deck, kind, stiffness):
    """Peak, toughness and critical opening of one law, told in three ways."""
    first = law_of(deck, f"{{law: {kind}, normal: {{peak: 2, toughness: 3{stiffness}}}}}")
    d = next(x for x in np.linspace(0.0, 20.0, 200_001)[1:] if strength(first, 0.0, x) == 0.0)
    for ends in ENDS[1:]:
        again = law_of(deck, f"{{law: {kind}, normal: {{{ends.format(d=d)}{stiffness}}}}}")
        assert np.array(again.modes.peak) == pytest.approx(first.modes.peak, rel=1e-3)
        assert np.array(again.modes.toughness) == pytest.approx(first.modes.toughness, rel=1e-3)
        assert np.array(again.modes.stiffness) == pytest.approx(first.modes.stiffness, rel=1e-3)


@pytest.mark.parametrize("ends", ["peak: 2, toughness: 3", "peak: 2, opening: {d}", ENDS[2]])
def test_cubic_in_three_ways(deck, ends):
    """Toughness = 9/16 peak times opening; the peak stands at a third of the opening."""
    d = 16.0 * 3.0 / (9.0 * 2.0)
    law = law_of(deck, f"{{law: cubic, normal: {{{ends.format(d=d)}}}}}")
    assert strength(law, 0.0, d / 3.0) == pytest.approx(2.0, rel=1e-12)
    assert work(law, 0.0, d) == pytest.approx(3.0, rel=1e-12)


def test_trilinear_goes_through_its_corners(deck):
    normal = "{openings: [1, 2, 6], stresses: [4, 1]}"
    law = law_of(deck, f"{{law: trilinear, normal: {normal}}}")
    told = [strength(law, 0.0, d) for d in (0.5, 1.0, 2.0, 4.0, 6.0)]
    assert told == pytest.approx([2.0, 4.0, 1.0, 0.5, 0.0], abs=1e-12)
    assert work(law, 0.0, 6.0) == pytest.approx(2.0 + 2.5 + 2.0, rel=1e-12)


def test_a_stiffness_not_given_puts_the_peak_at_a_fifth(deck):
    law = law_of(deck, "{law: triangular, normal: {peak: 2, toughness: 3}}")
    assert law.modes.stiffness[0] == pytest.approx(2.0 / (0.2 * 3.0), rel=1e-12)


WRONG = [
    ("{law: triangular, normal: {peak: 2}}", "normal: give two of peak, toughness, opening (got"),
    (
        "{law: triangular, normal: {peak: 2, toughness: 3, opening: 3}}",
        "normal.opening: follows from peak and toughness; give two of",
    ),
    (
        "{law: triangular, normal: {peak: 2, toughness: 3, stiffness: 0.5}}",
        "normal.stiffness: must be at least peak^2/(2 toughness) = 0.66667 Pa/m (got 0.5 Pa/m)",
    ),
    ("{law: cubic, normal: {peak: 2, toughness: 3, stiffness: 1}}", "stiffness: unknown key"),
    ("{law: triangle, normal: {peak: 2, toughness: 3}}", "did you mean 'triangular'?"),
    ("{law: triangular, normal: {peak: 2, toughness: 3}, power: 0.5}", "power: must be at least 1"),
    (
        "{law: trilinear, normal: {openings: [2, 1, 6], stresses: [4, 1]}}",
        "normal.openings.1: must be above 2 m (got 1 m)",
    ),
    (
        "{law: trilinear, normal: {openings: [1, 2, 6], stresses: [4, 5]}}",
        "normal.stresses.1: must be 0 to the peak, 4 Pa (got 5 Pa)",
    ),
    ("{law: elastic, normal: 2 MPa}", "'2 MPa' is no stiffness of faces; give Pa/m"),
    ("{law: pressure}", "traction.value: is missing"),
]


@pytest.mark.parametrize(("text", "told"), WRONG)
def test_mistakes_are_told(deck, text, told):
    with pytest.raises(DeckError) as caught:
        deck(f"cracks.cut.traction={text}")
    assert told in str(caught.value).replace("[", ".").replace("]", "")


@pytest.mark.parametrize(
    ("setting", "told"),
    [
        ("cracks.cut.traction_along=[5, 2]", "traction_along: must be 0 <= from < to"),
        ("cracks.cut.traction_along=[9, 12]", "from below the length of the crack, 8 m"),
        ("cracks.cut.motion=fixed", "motion: must be free: traction: {law: triangular} needs"),
    ],
)
def test_places_are_checked(deck, setting, told):
    with pytest.raises(DeckError) as caught:
        deck(setting)
    assert told in str(caught.value)


@pytest.mark.parametrize("grown", [False, True])
def test_a_crack_on_a_symmetry_plane_has_no_law(grown):
    half = {"bodies": [{"name": "plate", "material": "m"}]}
    half["bodies"][0]["shape"] = {"type": "rectangle", "lower": [0, 5], "upper": [20, 10]}
    half["boundary"] = [{"where": {"y": 5}, "symmetry": True}]
    half["contact"] = {"cracks": {"law": "ignore"}}
    if grown:
        crack = {"name": "cut", "points": [[0, 5], [8, 5]], "start": "edge"}
        law = {"law": "pressure", "value": 1.0}
        half |= {"cracks": [crack], "propagation": {"criterion": "critical_J", "traction": law}}
    with pytest.raises(DeckError, match="symmetry plane can have none: model both halves"):
        build_deck(DECK, **half)


def covered(**changes):
    """Return length and ends (m) of what carries a law on the crack of the deck."""
    _, state, _ = build_deck(DECK, **changes)
    x = state.paths.origin[state.paths.law == 0, 0]
    return lay_out_faces(state.paths).length.sum(), x.min(), x.max()


@pytest.mark.parametrize("part", [[2.1, 2.4], [2.1, 4.3], [2.0, 5.0]])
def test_a_part_ends_where_the_deck_says(part):
    """Points are put in where the part begins and ends; before, whole pieces of 0.5 m counted."""
    expected = (part[1] - part[0], part[0], part[1])
    assert covered(cracks=[_cut(part)]) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("begin", [0.0, -0.2, -1.7])
def test_a_law_acts_inside_the_solid_only(begin):
    """A crack that begins in free space has no faces there."""
    cut = _cut(points=[[begin, 5], [8, 5]])
    assert covered(cracks=[cut]) == pytest.approx((8.0, 0.0, 8.0), abs=2e-6)


def test_a_law_leaves_out_a_hole():
    bodies = [{"name": "plate", "material": "m"}, {"name": "bore", "hole": True}]
    bodies[0]["shape"] = {"type": "rectangle", "lower": [0, 0], "upper": [20, 10]}
    bodies[1]["shape"] = {"type": "rectangle", "lower": [2.2, 3], "upper": [4.1, 7]}
    length, *_ = covered(cracks=[_cut()], bodies=bodies)
    assert length == pytest.approx(8.0 - 1.9, abs=4e-6)


def test_a_part_outside_the_solid_is_a_mistake():
    cut = _cut([0.1, 0.9], points=[[-1, 5], [8, 5]])
    with pytest.raises(DeckError, match="covers no part of the crack that is inside a body"):
        build_deck(DECK, cracks=[cut])


def test_faces_that_are_glued_can_not_part():
    with pytest.raises(DeckError, match="traction: must not be given for faces that are glued"):
        build_deck(DECK, contact={"cracks": {"law": "glued"}})


def test_a_law_covers_its_part():
    model, state, _ = build_deck(DECK, cracks=[_cut([2.0, 5.0])])
    assert lay_out_faces(state.paths).length.sum() == pytest.approx(3.0, rel=1e-12)
    x = state.paths.origin[state.paths.law == 0, 0]
    assert (x.min(), x.max()) == (2.0, 5.0)
    assert len(model.cohesion.laws) == 1


def _cut(part=None, **more):
    crack = {"name": "cut", "points": [[0, 5], [8, 5]], "start": "edge"}
    crack |= {"traction_along": part} if part else {}
    law = {"law": "triangular", "normal": {"peak": 2.0, "toughness": 3.0}}
    return crack | {"traction": law} | more


def test_a_growing_end_takes_the_law_along():
    """The length with a law grows by the new piece, from the old tip on; nothing jumps."""
    growth = {"criterion": "critical_J", "traction": {"law": "pressure", "value": 3.0}}
    model, state, _ = build_deck(DECK, cracks=[_cut([2.0, 5.0])], propagation=growth)
    assert model.cohesion.grown == 1
    before = lay_out_faces(state.paths).length.sum()
    paths = add_point(state.paths, 0, 1)
    cover_end(paths, 0, 1, model.cohesion.grown)
    assert lay_out_faces(paths).length.sum() == pytest.approx(before, rel=1e-12)
    paths.origin[-1] += (0.3, 0.0)
    assert lay_out_faces(paths).length.sum() == pytest.approx(before + 0.3, rel=1e-12)
    assert paths.law[-2:].tolist() == [1, 1]
    assert paths.damage[-2:].tolist() == [0.0, 0.0]


def test_without_a_law_for_growth_the_end_hands_on_its_own():
    growth = {"criterion": "critical_J"}
    model, state, _ = build_deck(DECK, cracks=[_cut([2.0, 8.0])], propagation=growth)
    paths = add_point(state.paths, 0, 1)
    cover_end(paths, 0, 1, model.cohesion.grown)
    assert paths.law[-3:].tolist() == [0, 0, 0]


def test_a_pressure_follows_its_curve():
    law = {"law": "pressure", "value": 4.0, "in_time": {"type": "ramp", "until": 2.0}}
    model, _, _ = build_deck(DECK, cracks=[_cut([0.0, 8.0], traction=law, motion="fixed")])
    assert [model.cohesion.at(t)[0].value for t in (0.0, 0.5, 5.0)] == [0.0, 1.0, 4.0]
