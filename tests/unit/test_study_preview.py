"""The picture of a deck: everything at its place."""

import numpy as np
import pytest

from cramp_cli.deck.deck import read_deck
from cramp_cli.study.figures import drawing
from cramp_cli.study.outlines import exteriors, region_of, solid_outlines
from cramp_cli.study.preview import draw_deck

DECK = """\
cramp: 1
title: All that can be drawn
analysis: plane_strain
grid: {cell: 1 mm, margin: 2}
materials:
  steel: {law: elastic, density: 7800 kg/m^3, E: 200 GPa, nu: 0.3}
  pmma: {law: elastic, density: 1190 kg/m^3, E: 3 GPa, nu: 0.35}
bodies:
  - {name: block, material: pmma, shape: {type: rectangle, lower: [0, 0], upper: [40 mm, 30 mm]}}
  - {name: core, material: steel, shape: {type: disk, center: [10 mm, 20 mm], radius: 5 mm}}
  - {name: bore, hole: true, shape: {type: disk, center: [30 mm, 10 mm], radius: 3 mm}}
cracks:
  - {name: slot, points: [[0, 8 mm], [8 mm, 8 mm]], start: edge, end: tip}
boundary:
  - {name: floor, where: {y: 0}, fix: [x, y]}
  - {name: side, where: {x: 40 mm, y: [18 mm, 30 mm]}, velocity: {x: -1 m/s}}
loads:
  - {type: traction, name: press, body: block, where: {x: 0}, pressure: 2 MPa}
  - {type: gravity, acceleration: [0, -9.81]}
solver: {end_time: 10 us}
"""


@pytest.fixture
def deck(tmp_path):
    path = tmp_path / "deck.yaml"
    path.write_text(DECK, encoding="utf-8")
    return read_deck(path)


def region(deck, where):
    return region_of(where, solid_outlines(deck)[0], deck.grid.cell)


def test_later_bodies_and_holes_are_cut_out(deck):
    outlines = solid_outlines(deck)
    assert list(outlines) == [0, 1]
    cut = 1e-6 * (40 * 30 - np.pi * (25 + 9))
    assert outlines[0].area == pytest.approx(cut, rel=1e-3)
    assert [len(holes) for _, holes in exteriors(outlines[0])] == [2]


def test_a_plane_shows_as_its_part_on_the_body(deck):
    floor, side = (region(deck, boundary.where) for boundary in deck.boundary)
    np.testing.assert_allclose(np.sort(floor.lines[0][:, 0]), [0.0, 0.04], atol=2e-6)
    np.testing.assert_allclose(np.sort(side.lines[0][:, 1]), [0.018, 0.03], atol=2e-6)


def test_a_box_shows_as_its_part_of_the_body(deck):
    box = deck.loads[0].where.model_copy(update={"x": (-0.01, 0.004), "y": None})
    assert region(deck, box).area.area == pytest.approx(0.004 * 0.03)


def test_a_pressure_pushes_into_the_body(deck):
    np.testing.assert_allclose(region(deck, deck.loads[0].where).inward(), [1.0, 0.0], atol=1e-9)


def test_arrows_along_a_face_do_not_cover_each_other(deck):
    face = region(deck, deck.loads[0].where)
    across, along = (face.places(9, np.array(way), 0.01) for way in ([1.0, 0.0], [0.0, 1.0]))
    assert (len(across), len(along)) == (9, 3)


def test_the_legend_tells_every_part_once(deck):
    with drawing() as plt:
        figure = draw_deck(plt, deck)
        texts = [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
    assert texts == [
        "grid, cell 1 mm",
        "pmma: block",
        "steel: core",
        "floor: x and y fixed",
        "side: x at -1 m/s",
        "press: 2 MPa",
        "load 2: gravity 9.81 m/s²",
        "slot (contact: frictional)",
        "edge",
        "tip",
        "J domain, if there is room",
        "J contour",
    ]


def test_the_domain_has_the_radius_that_a_run_wants(deck):
    with drawing() as plt:
        patches = draw_deck(plt, deck).axes[0].patches
        circle = next(patch for patch in patches if hasattr(patch, "radius"))
        assert circle.radius == pytest.approx(5.0)  # mm: five cells
        assert circle.center == pytest.approx((8.0, 8.0))


def test_arrows_stay_inside_the_picture(deck):
    """The pressure acts from outside: the axes reach beyond the grid for its arrows."""
    with drawing() as plt:
        low, _ = draw_deck(plt, deck).axes[0].get_xlim()
    assert low < -2.0  # mm: where the grid begins
    assert low > -6.0
