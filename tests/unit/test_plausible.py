"""Numbers that are possible but hardly meant are told with the unit that was likely meant."""

import pytest
from support import read

from cramp_cli.build.estimate import estimate
from cramp_cli.commands import refuse_too_few_steps
from cramp_cli.deck.deck import DeckError

PLATE = """
cramp: 1
analysis: plane_strain
grid: {cell: 2 mm}
materials:
  glass: {law: elastic, density: 2500, E: 70 GPa, nu: 0.2, toughness: {K_Ic: 1.2 MPa*m^0.5}}
bodies:
  - {name: plate, material: glass, shape: {type: rectangle, lower: [0, 0], upper: [40 mm, 20 mm]}}
loads:
  - {type: force, body: plate, where: {y: 20 mm}, total: [0, 1], in_time: {type: ramp, until: 9 us}}
solver: {end_time: 20 us}
"""


def test_what_is_usual_is_not_told():
    assert read(PLATE).warnings == []


@pytest.mark.parametrize(
    ("right", "odd", "found"),
    [
        ("E: 70 GPa", "E: 70", "materials.glass.E: 70 Pa is softer than any solid; 70 GPa or"),
        ("1.2 MPa*m^0.5", "1.2", "materials.glass.toughness.K_Ic: 1.2 Pa*m^0.5 is less than"),
        ("density: 2500", "density: 2.5", "materials.glass.density: 2.5 kg/m^3 is lighter than"),
        ("20 us}", "20 us, damping: {grid: 1.0e+9}}", "solver.damping.grid: 1e+09 1/s stops all"),
        ("cell: 2 mm", "cell: 20 mm", "bodies.plate.shape: is 2 cells long, too few"),
        (
            "until: 9 us",
            "until: 9 ms",
            "loads.0.in_time.until: 0.009 s is after the end of the run",
        ),
    ],
)
def test_what_is_odd_is_told(right, odd, found):
    assert PLATE.count(right) == 1
    (warning,) = read(PLATE.replace(right, odd)).warnings
    assert f"{warning.shown_path}: {warning.message}".startswith(found)


def test_a_deck_in_units_of_its_own_is_left_alone():
    own = (
        PLATE.replace("2500", "1")
        .replace("70 GPa", "1")
        .replace(", toughness: {K_Ic: 1.2 MPa*m^0.5}", "")
    )
    assert read(own.replace("20 us}", "20 s}")).warnings == []


@pytest.mark.parametrize(("end", "wrong"), [("3 us", True), ("4 us", False)])
def test_fewer_than_twenty_steps_are_a_mistake(end, wrong):
    """The wave speed is 5578 m/s, so a step of half a cell takes 0.179 us."""
    deck = read(PLATE.replace("end_time: 20 us", f"end_time: {end}"))
    if not wrong:
        refuse_too_few_steps(deck, estimate(deck))
        return
    with pytest.raises(DeckError, match="solver.end_time: is only 17 time steps of"):
        refuse_too_few_steps(deck, estimate(deck))
