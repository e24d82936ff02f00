"""Shapes of many pieces, from pictures, meshes and files; and bodies made of their pieces."""

from itertools import combinations
from math import hypot, pi

import meshio
import numpy as np
import pytest
from PIL import Image
from test_shapes_of_bodies import mistakes, points_of_grid, shape

from cramp_cli.deck.deck import DeckError, read_deck, to_yaml
from cramp_cli.output.manifest import Manifest
from cramp_cli.study.figures import drawing
from cramp_cli.study.outlines import solid_outlines
from cramp_cli.study.preview import draw_deck
from cramp_cli.study.templates import template_folder, write_template

BOX = {"type": "rectangle", "lower": [0, 0], "upper": [4, 3]}
DISK = {"type": "disk", "center": [1, 1], "radius": 0.25}
PACK = {"type": "pack", "inside": BOX, "radius": 0.1, "fraction": 0.4, "seed": 3}
FIRST_DISK = ["0x1.01178c9b43dfdp+0", "0x1.9fb41925492f9p+0", "0x1.999999999999ap-4"]


def area_by_counting(here):
    """Area of what `contains` holds, which has to lie within `bounds` (m^2)."""
    lower, upper = (np.array(corner) for corner in here.bounds())
    points = points_of_grid(lower - 0.1, upper + 0.1, 600)
    inside = points[here.contains(points)]
    assert (inside >= lower).all()
    assert (inside <= upper).all()
    return len(inside) / len(points) * np.prod(upper - lower + 0.2)


# arrays


def test_an_array_has_rows_and_columns():
    copies = {"type": "array", "of": DISK, "count": [3, 2], "spacing": [1, 0.75], "shift": 0.5}
    here = shape(copies)
    centres = [piece.center for piece in here.pieces()]
    assert centres == [(1, 1), (2, 1), (3, 1), (1.5, 1.75), (2.5, 1.75), (3.5, 1.75)]
    assert here.bounds() == ((0.75, 0.75), (3.75, 2.0))
    assert area_by_counting(here) == pytest.approx(6 * pi / 16, rel=5e-3)
    assert here.outline().area == pytest.approx(6 * pi / 16, rel=1e-3)


EVERY = [
    BOX,
    DISK,
    PACK,
    {"type": "ellipse", "center": [1, 2], "radii": [2, 0.5], "angle": 30},
    {"type": "polygon", "points": [[0, 0], [2, 0], [0, 1]]},
    {"type": "annulus", "center": [1, 2], "inner": 1, "outer": 2},
    {"type": "union", "of": [BOX, DISK]},
    {"type": "difference", "of": BOX, "minus": [DISK]},
    {"type": "array", "of": DISK, "count": [2, 2], "spacing": [1, 1]},
]


@pytest.mark.parametrize("data", EVERY, ids=lambda data: data["type"])
def test_every_shape_can_be_copied(data):
    here = shape(data)
    here.pieces()  # an array keeps its copies: they must not go along
    there = here.moved((2.0, -1.0))
    assert np.array(there.bounds()) == pytest.approx(np.array(here.bounds()) + [2.0, -1.0])
    points = points_of_grid((-1.0137, -1.0071), (5.0, 5.0), 97)
    assert (there.contains(points + [2.0, -1.0]) == here.contains(points)).all()


# packs


@pytest.mark.parametrize("sizes", [{}, {"smallest": 0.05}])
def test_a_pack_has_its_fraction_and_no_disk_lies_over_another(sizes):
    here = shape({**PACK, **sizes, "gap": 0.01})
    disks = here.disks
    assert sum(pi * r * r for _, _, r in disks) / 12.0 == pytest.approx(0.4, abs=pi * 0.01 / 24)
    for (x, y, r), (a, b, s) in combinations(disks, 2):
        assert hypot(x - a, y - b) >= r + s + 0.01
    assert all(r + 0.01 <= x <= 3.99 - r and r + 0.01 <= y <= 2.99 - r for x, y, r in disks)
    assert here.outline().area == pytest.approx(sum(pi * r * r for _, _, r in disks), rel=1e-3)


def test_a_pack_is_the_same_to_the_last_bit_at_every_reading():
    """Places written on 2026-11-22: Python keeps what a seed gives from version to version."""
    assert shape(PACK).disks == shape(PACK).disks
    assert shape(PACK).disks != shape({**PACK, "seed": 4}).disks
    assert [x.hex() for x in shape(PACK).disks[0]] == FIRST_DISK


def test_a_pack_in_a_round_box_stays_inside():
    here = shape({**PACK, "inside": {**DISK, "radius": 1}})
    assert max(hypot(x - 1, y - 1) + r for x, y, r in here.disks) <= 1.0


def test_a_pack_that_is_too_dense_is_a_mistake():
    ((path, message),) = mistakes({**PACK, "fraction": 0.7})
    assert path == ("fraction",)
    assert message.startswith("can not be reached: 267 disks of this size would fill 0.699 of ")
    assert message.endswith("(got 0.7); disks thrown at random jam near 0.5")
    small = {**BOX, "upper": [0.1, 0.1]}
    ((path, message),) = mistakes({**PACK, "inside": small, "fraction": None, "count": 1})
    assert path == ("count",)
    assert message.startswith("can not be reached: 1 disk of this size would fill 3.142 of ")


def test_a_pack_whose_disks_find_no_room_is_a_mistake():
    """Below what jams disks are thrown and counted: none fits a strip narrower than it is."""
    strip = {**BOX, "upper": [4, 0.19]}
    ((path, message),) = mistakes({**PACK, "inside": strip, "fraction": None, "count": 1})
    assert path == ("count",)
    assert "0 of 1 disks found room, a fraction of 0.000 (got 1); disks thrown at" in message


# pictures


@pytest.fixture
def picture(tmp_path):
    """Two rows of three pixels; the upper row is the first one of the file."""
    greys = np.array([[0, 100, 200], [50, 100, 255]], dtype=np.uint8)
    Image.fromarray(greys).save(tmp_path / "p.png")
    return tmp_path


def image(folder, grey, **more):
    data = {"type": "image", "file": "p.png", "grey": grey, "pixel": "1 m"}
    return shape({**data, **more}, folder)


def test_a_range_of_greys_is_a_region(picture):
    here = image(picture, [90, 210])
    assert here.mask.tolist() == [[False, True, False], [False, True, True]]  # from below
    assert here.bounds() == ((1.0, 0.0), (3.0, 2.0))
    assert here.outline().area == pytest.approx(3.0)
    assert area_by_counting(here) == pytest.approx(3.0, rel=5e-3)


def test_ranges_of_greys_share_no_point_and_lose_none(picture):
    x = np.linspace(0.0, 3.0, 31)[:-1]
    points = np.stack(np.meshgrid(x, x[:20]), axis=-1).reshape(-1, 2)
    ranges = ([0, 99], [100, 100], [101, 255])
    held = sum(image(picture, grey).contains(points).astype(int) for grey in ranges)
    assert (held == 1).all()


def test_size_and_place_of_a_picture(picture):
    here = image(picture, [0, 255], pixel=None, width="30 mm", origin=["5 mm", 0])
    assert np.array(here.bounds()) == pytest.approx(np.array([[0.005, 0], [0.035, 0.02]]))


def test_what_is_no_picture_or_has_no_such_grey(picture):
    data = {"type": "image", "file": "p.png", "grey": [101, 199], "pixel": 1}
    told = "no pixel of p.png is from 101 to 199; its greys are 0 to 255"
    assert mistakes(data, picture) == [(("grey",), told)]
    told = "must be [low, high] (got [9, 3])"
    assert mistakes({**data, "grey": [9, 3]}, picture) == [(("grey",), told)]
    (picture / "p.png").write_text("no picture")
    told = "'p.png' is no picture that pillow knows"
    assert mistakes(data, picture) == [(("file",), told)]
    Image.fromarray(np.zeros((2, 2), dtype=np.uint16)).save(picture / "p.png")
    assert "has more than 8 bit for a grey" in mistakes(data, picture)[0][1]


# meshes


@pytest.fixture
def mesh(tmp_path):
    """Three unit squares in a row: two triangles of group 1 (soft), quads of group 2 (hard)."""
    points = [[x, y, 0] for y in (0, 1) for x in range(4)]
    cells = [("triangle", [[0, 1, 5], [0, 5, 4]]), ("quad", [[1, 2, 6, 5], [2, 3, 7, 6]])]
    groups = [np.array([1, 1]), np.array([2, 2])]
    made = meshio.Mesh(
        np.array(points, dtype=float),
        cells,
        cell_data={"gmsh:physical": groups, "gmsh:geometrical": groups},
        field_data={"soft": np.array([1, 2]), "hard": np.array([2, 2])},
    )
    made.write(tmp_path / "m.msh", file_format="gmsh22", binary=False)
    made.write(tmp_path / "m.vtu")
    return tmp_path


@pytest.mark.parametrize(
    ("file", "group", "corners"),
    [
        ("m.msh", None, ((0, 0), (3, 1))),
        ("m.msh", "soft", ((0, 0), (1, 1))),
        ("m.msh", "hard", ((1, 0), (3, 1))),
        ("m.msh", 2, ((1, 0), (3, 1))),
        ("m.vtu", 1, ((0, 0), (1, 1))),
    ],
)
def test_groups_of_a_mesh(mesh, file, group, corners):
    here = shape({"type": "mesh", "file": file, "group": group, "origin": [1, 0]}, mesh)
    assert np.array(here.bounds()) == pytest.approx(np.array(corners) + [1, 0])
    area = corners[1][0] - corners[0][0]
    assert area_by_counting(here) == pytest.approx(area, rel=5e-3)


def test_a_unit_makes_a_mesh_small(mesh):
    here = shape({"type": "mesh", "file": "m.msh", "unit": "1 mm"}, mesh)
    assert here.outline().area == pytest.approx(3e-6)


def test_sections_of_a_surface_in_space(tmp_path):
    """A cube of side 2 around a hollow cube of side 1: the section has a hole."""
    corners = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], dtype=float)
    quads = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]]
    faces = np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])
    points = np.vstack([2.0 * corners, corners + 0.5])
    both = meshio.Mesh(points, [("triangle", np.vstack([faces, faces + 8]))])
    both.write(tmp_path / "cubes.stl")
    data = {"type": "mesh", "file": "cubes.stl", "height": 1.0}
    assert shape(data, tmp_path).outline().area == pytest.approx(3.0)
    assert shape({**data, "height": 0.5}, tmp_path).outline().area == pytest.approx(3.0)
    assert shape({**data, "height": 0.2}, tmp_path).outline().area == pytest.approx(4.0)
    told = "is missing: cubes.stl lies in space, z from 0 m to 2 m"
    assert mistakes({**data, "height": None}, tmp_path) == [(("height",), told)]
    told = "gives no area: cubes.stl has no cells there"
    assert mistakes({**data, "height": 3.0}, tmp_path) == [(("height",), told)]


@pytest.mark.parametrize(
    ("more", "path", "message"),
    [
        ({"group": "sofd"}, "group", "unknown group 'sofd'; did you mean 'soft'?"),
        ({"group": 7}, "group", "no cell has the number 7 (known: 1, 2)"),
        ({"group": 1, "array": "gmsh:fysical"}, "array", "did you mean 'gmsh:physical'?"),
        ({"height": 1.0}, "height", "is for surfaces in space; m.msh is plane"),
    ],
)
def test_mistakes_in_meshes(mesh, more, path, message):
    ((found, told),) = mistakes({"type": "mesh", "file": "m.msh", **more}, mesh)
    assert found == (path,)
    assert message in told


def test_what_is_no_mesh(tmp_path):
    (tmp_path / "m.msh").write_text("no mesh")
    ((path, told),) = mistakes({"type": "mesh", "file": "m.msh"}, tmp_path)
    assert path == ("file",)
    assert told.startswith("cannot read 'm.msh' as a mesh: ")


# files


def test_a_polygon_in_another_unit(tmp_path):
    (tmp_path / "a.csv").write_text("x,y\n0,0\n2,0\n0,1\n")
    data = {"type": "polygon", "file": "a.csv", "unit": "1 mm"}
    assert shape(data, tmp_path).points == ((0.0, 0.0), (0.002, 0.0), (0.0, 0.001))
    wrong = {"type": "polygon", "points": [[0, 0], [2, 0], [0, 1]], "unit": "1 mm"}
    told = "goes with file; points in the deck carry their own units"
    assert mistakes(wrong) == [(("unit",), told)]


def test_a_unit_that_is_none_is_told(tmp_path):
    (tmp_path / "a.csv").write_text("0,0\n2,0\n0,1\n")
    data = {"type": "polygon", "file": "a.csv", "unit": "1 kg"}
    assert [path for path, _ in mistakes(data, tmp_path)] == [("unit",)]


DECK = """\
cramp: 1
analysis: plane_strain
grid: {cell: 0.1}
materials: {m: {law: elastic, density: 1000, E: 1e6, nu: 0.3}}
bodies:
  - {name: b, material: m, shape: {type: image, file: p.png, grey: [90, 210], pixel: 1}}
solver: {end_time: 1}
"""


def write(folder, text):
    path = folder / "deck.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def test_the_resolved_deck_knows_its_files(picture, tmp_path):
    """A resumed run reads the resolved deck, from another folder."""
    deck = read_deck(write(picture, DECK))
    run = tmp_path / "run"
    run.mkdir()
    again = read_deck(write(run, to_yaml(deck.resolved())))
    assert again.resolved() == deck.resolved()
    assert deck.file_digests() == {"p.png": deck.bodies[0].shape.sha256}
    Image.fromarray(np.full((2, 3), 100, dtype=np.uint8)).save(picture / "p.png")
    with pytest.raises(DeckError, match="is another file, with SHA-256 .*; bring the old one back"):
        read_deck(run / "deck.yaml")


def test_the_manifest_keeps_what_the_files_were_at_the_start(tmp_path):
    begun = Manifest(tmp_path, "deck", 1, files={"p.png": "ab"})
    assert begun.record["files_sha256"] == {"p.png": "ab"}
    goes_on = Manifest(tmp_path, "deck", 1, {"step": 3, "wall_time": 1.0}, {})
    assert goes_on.record["files_sha256"] == {"p.png": "ab"}


def test_a_template_brings_its_files(tmp_path):
    written = write_template("foam", tmp_path / "mine.yaml")
    assert [path.name for path in written] == ["mine.yaml", "foam.png"]
    assert read_deck(written[0]).bodies[0].name == "foam"


def test_the_picture_of_the_foam_is_that_of_its_script(monkeypatch):
    """Pixel by pixel: the file may be packed in another way."""
    monkeypatch.syspath_prepend(template_folder())
    from foam import Random, centres, picture

    with Image.open(template_folder() / "foam.png") as file:
        found = np.asarray(file.convert("L"))
    assert (found == picture(centres(Random(6)))).all()


# bodies of pieces

EACH = """\
cramp: 1
analysis: plane_strain
grid: {cell: 0.1}
materials: {m: {law: elastic, density: 1000, E: 1e6, nu: 0.3}}
bodies:
  - name: grain
    material: m
    each: true
    shape:
      type: array
      of: {type: disk, center: [0, 0], radius: 1}
      count: [2, 2]
      spacing: [3, 3]
  - {name: floor, rigid: {}, shape: {type: rectangle, lower: [-2, -2], upper: [5, -1]}}
contact: {bodies: {law: frictional}}
solver: {end_time: 1}
"""


def test_every_piece_becomes_a_body(tmp_path):
    deck = read_deck(write(tmp_path, EACH))
    names = ["grain_1", "grain_2", "grain_3", "grain_4", "floor"]
    assert [body.name for body in deck.bodies] == names
    assert deck.bodies[3].shape.center == (3.0, 3.0)
    again = write(tmp_path, to_yaml(deck.resolved()))
    assert read_deck(again).resolved() == deck.resolved()


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        (
            "name: floor",
            "name: grain_2",
            ":6:11: bodies.grain.name: 'grain_2' is taken, and a piece",
        ),
        (
            "solver:",
            "loads: [{type: force, body: grain, total: [0, 1], where: {y: 1}}]\nsolver:",
            "'grain' is 4 bodies (each: true); load a body of its own",
        ),
        ("material: m\n", "hole: true\n", "each: does not go with hole: true"),
        (
            "contact: {bodies: {law: frictional}}\n",
            "",
            ":14:26: bodies.floor.rigid: acts by contact only; give contact",
        ),
    ],
)
def test_mistakes_are_told_where_the_deck_has_them(tmp_path, old, new, told):
    assert EACH.count(old) == 1
    with pytest.raises(DeckError) as caught:
        read_deck(write(tmp_path, EACH.replace(old, new)))
    assert told in str(caught.value)


def test_two_hundred_disks_are_drawn_and_none_is_lost():
    deck = read_deck(template_folder() / "packed_bed.yaml")
    outlines = solid_outlines(deck)
    assert len(outlines) == 204
    grains = [outlines[number].area for number in range(200)]
    assert grains == pytest.approx([pi * 0.003**2] * 200, rel=1e-3)
    with drawing() as plt:
        axes = draw_deck(plt, deck).axes[0]
        texts = [text.get_text() for text in axes.get_legend().get_texts()]
    assert "rubber: grain_1, grain_2, ..., grain_200 (200 bodies)" in texts
    assert len(axes.patches) == 2 * 204
