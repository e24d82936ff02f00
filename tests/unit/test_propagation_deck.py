"""What a deck says about growth, and every mistake in it."""

from math import inf, sqrt

import pytest

from cramp_cli.build import build
from cramp_cli.cracks.criteria.empirical import Empirical
from cramp_cli.cracks.criteria.max_ctod import MaxCtod
from cramp_cli.cracks.speed import RisingToughness, ToughnessTable
from cramp_cli.deck.deck import DeckError, read_deck

DECK = """\
cramp: 1
analysis: plane_strain
grid: {cell: 1}
materials:
  glass: {law: elastic, density: 1, E: 1, nu: 0.25, toughness: {K_Ic: 2}}
  rock: {law: elastic, density: 1, E: 1, nu: 0.25}
bodies:
  - {name: plate, material: glass, shape: {type: rectangle, lower: [0, 0], upper: [20, 10]}}
  - {name: core, material: rock, shape: {type: rectangle, lower: [14, 0], upper: [20, 10]}}
cracks:
  - {name: left, points: [[0, 5], [8, 5]], start: edge}
  - {name: right, points: [[16, 5], [20, 5]], start: plain, end: edge}
solver: {end_time: 1}
propagation: {criterion: max_hoop_stress}
"""


@pytest.fixture
def deck(tmp_path):
    def one(*overrides):
        path = tmp_path / "d.yaml"
        path.write_text(DECK, encoding="utf-8")
        return read_deck(path, overrides)

    return one


@pytest.mark.parametrize(
    ("setting", "told"),
    [
        ("propagation={}", "propagation.criterion: is missing"),
        (
            "propagation.criterion=max_hop_stress",
            "propagation.criterion: must be one of max_hoop_stress,",
        ),
        ("propagation.direction=given", "propagation.toward: is missing; it goes with"),
        ("propagation.toward=[1, 0]", "propagation.toward: goes with direction: given only"),
        ("propagation={criterion: critical_J, direction: given, toward: [0, 0]}", "not be [0, 0]"),
        (
            "propagation={criterion: critical_J, direction: given, toward: [-1, 0.1]}",
            "propagation.toward: turns the tip of crack left by 174 degrees, back beside its own",
        ),
        ("interfaces=[{between: [glass, rok], G_Ic: 1}]", "interfaces.0.between.1: "),
        ("interfaces=[{between: [rock, rock], G_Ic: 1}]", "must name two materials (got rock"),
        (
            "interfaces=[{between: [rock, glass], G_Ic: 1}, {between: [glass, rock], G_Ic: 2}]",
            "interfaces.1.between: the interface of glass and rock is given already; remove it",
        ),
        ("propagation.p=2", "propagation.p: goes with criterion: empirical only"),
        ("propagation.begin=1 s", "propagation.begin: goes with criterion: steady_state only"),
        ("propagation.criterion=steady_state", "propagation.speed: must be {law: prescribed"),
        ("propagation.fastest=1.2", "propagation.fastest: must be at most 1"),
        ("propagation.piece=3", "propagation.piece: must be 0.1 to 1 cells (got 3)"),
        ("propagation.cracks=[lefd]", "did you mean 'left'?"),
        ("propagation.cracks=[right]", "propagation: no crack that may grow has an end that is"),
        ("propagation.speed={law: prescribed}", "propagation.speed.value: is missing"),
        (
            "propagation.speed={law: table, speeds: [0, 1, 1], factors: [1, 2, 3]}",
            "propagation.speed.speeds.2: must be above the one before (1, got 1)",
        ),
        (
            "propagation.speed={law: table, speeds: [0, 1], factors: [1, 2, 3]}",
            "propagation.speed.factors: must be as many as speeds (got 3 for 2 speeds)",
        ),
        (
            "propagation.speed={law: table, speeds: [1, 2], factors: [1, 2]}",
            "propagation.speed.speeds.0: must be 0 (got 1)",
        ),
        ("propagation.criterion=empirical", "materials.glass.toughness: has no K_IIc; criterion"),
        ("propagation.criterion=max_ctod", "has no delta_Ic or delta_IIc; criterion: max_ctod"),
        (
            "cracks.right.start=tip",
            "materials.rock: has no toughness; criterion: max_hoop_stress needs it at the tip of "
            "crack right",
        ),
        (
            "materials.glass.toughness.G_Ic=4",
            "materials.glass.toughness.G_Ic: does not agree with K_Ic, which gives 3.75 J/m^2",
        ),
    ],
)
def test_mistakes(deck, setting, told):
    with pytest.raises(DeckError, match=".") as caught:
        deck(setting)
    assert told in str(caught.value)


def test_defaults(deck):
    model, state = build(deck())
    grown = model.propagation
    assert (grown.piece, grown.longest, grown.begin, grown.steady) == (0.5, inf, inf, False)
    assert grown.cracks == (True, True)
    assert isinstance(grown.speed, RisingToughness)
    assert set(grown.resistance) == {"glass"}  # what has no toughness does not break
    glass = grown.resistance["glass"]
    assert glass.criterion.K_Ic == 2.0
    assert glass.G_Ic == pytest.approx(4.0 * (1.0 - 0.25**2))
    shear_speed = sqrt(0.4)
    assert glass.rayleigh == pytest.approx(shear_speed * sqrt(2.0 - 2.0 / sqrt(3.0)))
    assert state.growth.heading.tolist() == [[-1, 0], [1, 0], [-1, 0], [1, 0]]


def test_both_measures_of_toughness_may_be_given_when_they_agree(deck):
    assert deck("materials.glass.toughness.G_Ic=3.76")


def test_other_criteria(deck):
    model, _ = build(
        deck(
            "propagation.criterion=empirical",
            "propagation.p=1.5",
            "materials.glass.toughness.K_IIc=1",
            "propagation.cracks=[left]",
            "propagation.speed={law: table, speeds: [0, 0.5], factors: [1, 3]}",
        )
    )
    assert model.propagation.resistance["glass"].criterion == Empirical(2.0, 1.0, 1.5, 2.0)
    assert model.propagation.cracks == (True, False)
    assert model.propagation.speed == ToughnessTable((0.0, 0.5), (1.0, 3.0))
    model, _ = build(
        deck("propagation.criterion=max_ctod", "materials.glass.toughness={delta_Ic: 1 mm}")
    )
    assert model.propagation.resistance["glass"].criterion == MaxCtod(1e-3, inf)


def test_no_section_no_growth(deck):
    model, _ = build(deck("propagation="))
    assert model.propagation is None
