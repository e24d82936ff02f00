"""A whole deck: what is read, what is filled in, and how it is written back."""

import subprocess
import sys
from math import pi

import numpy as np
import pytest

from cramp_cli.deck.deck import DeckError, Mistake, read_deck, to_yaml
from cramp_cli.deck.json_schema import deck_schema
from cramp_cli.deck.reference import deck_reference

SMALL = """\
cramp: 1
analysis: plane_strain
grid: {cell: 1 mm}
materials: {glass: {law: elastic, density: 2500, E: 70 GPa, nu: 0.2}}
bodies:
  - {name: plate, material: glass, shape: {type: rectangle, lower: [0, 0], upper: [0.1, 0.05]}}
solver: {end_time: 1 ms}
"""
CRACKED = (
    SMALL
    + """\
cracks:
  - {name: straight, points: [[0, 0.02], [0.03, 0.02]], start: edge}
  - name: bow
    arc: {center: [0.07, 0.025], radius: 1 cm, from: 0, to: 90}
    contact: {law: stick}
"""
)
FULL = (
    CRACKED
    + """\
title: "1e3"
thickness: 2 mm
contact: {cracks: {law: frictional, mu: 0.3, mu_static: 0.5}}
boundary:
  - {name: wall, where: {x: 0, y: [0, 0.05]}, fix: [x]}
  - {where: {y: 0}, symmetry: true}
  - {where: {y: 0.05}, velocity: {y: 1}, in_time: {type: ramp, until: 0.1 ms}}
loads:
  - {type: force, body: plate, where: {x: [0.09, 0.1]}, each: [0, 3 N], in_time: step}
  - {type: traction, body: plate, where: {x: 0.1}, pressure: 1 MPa}
  - {type: gravity, acceleration: [0, -9.81]}
fracture: {radius: 3 mm}
output: {every: 10 us, fields: []}
"""
)


@pytest.fixture
def write(tmp_path):
    def put(text, name="deck.yaml"):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return put


def test_defaults(write):
    deck = read_deck(write(SMALL))
    assert (deck.title, deck.thickness, deck.cracks, deck.loads) == ("", 1.0, (), ())
    assert deck.grid.cell == 0.001
    assert deck.bodies[0].particles_per_cell == 2
    assert deck.solver.update_name == "flip"
    assert deck.solver.strain == "usavg+"
    assert deck.contact.cracks.mu == 0.0
    assert deck.output.every == pytest.approx(1e-5)
    assert deck.output.history_every == pytest.approx(1e-6)
    assert deck.fracture.every == deck.output.every
    assert deck.fracture.methods == ("domain", "contour")
    assert deck.warnings == []


def test_what_build_needs_beside_the_sections(write):
    path = write(SMALL)
    deck = read_deck(path)
    assert deck.source_text == SMALL
    assert deck.folder == path.parent
    assert str(deck.mistake(("grid", "cell"), "too small")) == f"{path}:3:14: grid.cell: too small"
    assert deck.mistake(("bodies", 0, "velocity"), "x").line == 6
    assert deck.mistake(("solver", "dt"), "x").shown_path == "solver.dt"


def test_automatic_grid_has_a_margin_and_a_line_at_zero(write):
    box = read_deck(write(SMALL), ["bodies.plate.shape.lower=[0.25 mm, 0]"]).lattice_box()
    assert box.lower == pytest.approx((-0.004, -0.004))
    assert box.upper == pytest.approx((0.104, 0.054))
    assert box.cells == (108, 58)


def test_given_grid(write):
    deck = read_deck(
        write(SMALL), ["grid={cell: 2 mm, lower: [-2 mm, -2 mm], upper: [102 mm, 0.06]}"]
    )
    assert deck.lattice_box() == ((-0.002, -0.002), (0.102, 0.06), (52, 31))


def test_elastic_constants_from_either_pair(write):
    glass = read_deck(write(SMALL)).materials["glass"]
    other = f"materials.glass={{law: elastic, density: 1, K: {70e9 / 1.8}, G: {70e9 / 2.4}}}"
    again = read_deck(write(SMALL), [other]).materials["glass"]
    for name in ("young", "poisson", "lame", "shear"):
        assert getattr(again, name) == pytest.approx(getattr(glass, name), rel=1e-12)
    assert glass.K_Ic_of("plane_stress") is None


def test_toughness_either_way(write):
    """K^2 = G E' with E' = E in plane stress and E / (1 - nu^2) in plane strain."""
    deck = read_deck(write(SMALL), ["materials.glass.toughness.K_Ic=0.7 MPa*m^0.5"])
    glass = deck.materials["glass"]
    assert glass.K_Ic_of("plane_strain") == 0.7e6
    assert glass.G_Ic_of("plane_strain") == pytest.approx(0.7e6**2 * (1 - 0.04) / 70e9)
    deck = read_deck(write(SMALL), ["materials.glass.toughness.G_Ic=7"])
    assert deck.materials["glass"].K_Ic_of("plane_stress") == pytest.approx(7e5)
    assert deck.materials["glass"].G_Ic_of("plane_stress") == 7.0


def test_crack_paths(write):
    deck = read_deck(write(CRACKED))
    straight, bow = deck.cracks
    path = straight.path(straight.segment)
    assert straight.segment == 0.0005
    assert path.shape == (61, 2)
    assert path[[0, -1]].tolist() == [[0.0, 0.02], [0.03, 0.02]]
    arc = bow.path(bow.segment)
    assert np.hypot(*(arc - [0.07, 0.025]).T) == pytest.approx(0.01, rel=1e-12)
    steps = np.hypot(*np.diff(arc, axis=0).T)
    assert steps.max() <= bow.segment
    assert steps.max() / steps.min() == pytest.approx(1.0, abs=1e-4)
    assert bow.length == pytest.approx(0.005 * pi, rel=1e-5)
    assert deck.contact_of(straight) is deck.contact.cracks
    assert deck.contact_of(bow).law == "stick"


def test_crack_path_keeps_corners_and_drops_repeated_points(write):
    points = "cracks=[{name: kink, points: [[0.01, 0], [0.02, 0], [0.02, 0], [0.02, 0.0107]]}]"
    path = read_deck(write(SMALL), [points]).cracks[0].path(0.001)
    assert [0.02, 0.0] in path.tolist()
    assert len(path) == 10 + 11 + 1
    assert np.hypot(*np.diff(path, axis=0).T).max() <= 0.001 * (1 + 1e-9)


def test_elliptic_arc_is_cut_evenly(write):
    arc = "cracks=[{name: e, arc: {center: [0.05, 0.02], radii: [2 cm, 5 mm], from: 180, to: 0}}]"
    path = read_deck(write(SMALL), [arc]).cracks[0].path(0.0005)
    steps = np.hypot(*np.diff(path, axis=0).T)
    assert steps.max() / steps.min() < 1.01
    assert path[0] == pytest.approx((0.03, 0.02))
    assert path[-1] == pytest.approx((0.07, 0.02))
    assert path[len(path) // 2, 1] > 0.02  # clockwise over the top


def test_crack_from_a_file_beside_the_deck(write):
    write("0.0,0.02\n0.03,0.02\n", "line.csv")
    deck = read_deck(write(SMALL), ["cracks=[{name: a, file: line.csv}]"])
    assert deck.cracks[0].points == ((0.0, 0.02), (0.03, 0.02))


@pytest.mark.parametrize(
    ("update", "name", "order"),
    [("flip", "flip", 0), ("pic", "pic", 1), ("fmpm(2)", "fmpm", 2), ("xpic(12)", "xpic", 12)],
)
def test_velocity_updates(write, update, name, order):
    solver = read_deck(write(SMALL), [f"solver.update={update}"]).solver
    assert (solver.update_name, solver.update_order) == (name, order)


def test_boundary_components(write):
    wall, mirror, top = read_deck(write(FULL)).boundary
    assert wall.components == ((0, 0.0),)
    assert wall.where.planes == ((0, 0.0),)
    assert wall.where.span(1) == (0.0, 0.05)
    assert mirror.components == ((1, 0.0),)
    assert top.components == ((1, 1.0),)
    assert top.in_time.value(5e-5) == pytest.approx(0.5)


def test_where_holds_points(write):
    where = read_deck(write(FULL)).boundary[0].where
    points = np.array([[0.0, 0.0], [1e-9, 0.05], [1e-3, 0.02], [0.0, 0.06]])
    assert where.contains(points, 1e-8).tolist() == [True, True, False, False]


def test_one_radius_or_a_list(write):
    assert read_deck(write(FULL)).fracture.radius == (0.003,)
    assert read_deck(write(FULL), ["fracture.radius=[3 mm, 4 mm]"]).fracture.radius == (
        0.003,
        0.004,
    )


@pytest.mark.parametrize("text", [SMALL, CRACKED, FULL])
def test_a_resolved_deck_reads_back_to_itself(write, text):
    once = read_deck(write(text)).resolved()
    again = read_deck(write(to_yaml(once), "again.yaml")).resolved()
    assert again == once


@pytest.mark.parametrize(
    "override",
    [
        "grid={cell: 1 mm, lower: [-0.01, -0.01], upper: [0.11, 0.06]}",
        "bodies=[{name: plate, material: glass, shape: {type: disk, center: [1, 2], radius: 0.02}},"
        " {name: cut, hole: true, shape: {type: disk, center: [1, 2], radius: 1e-3}}]",
        "boundary=[{where: {x: 0}, fix: [x]}]",
    ],
)
def test_more_decks_that_read_back(write, override):
    once = read_deck(write(SMALL), [override]).resolved()
    assert read_deck(write(to_yaml(once), "again.yaml")).resolved() == once


def test_writing_quotes_what_yaml_1_2_would_misread(write):
    assert read_deck(write(FULL)).resolved()["title"] == "1e3"
    assert "title: '1e3'" in to_yaml({"title": "1e3"})
    assert to_yaml({"a": "NO", "b": [0.001]}) == "a: 'NO'\nb: [0.001]\n"


def test_overrides_by_name_by_index_and_into_new_sections(write):
    settings = [
        "cracks.bow.end=plain",
        "cracks[0].end=plain",
        "solver.damping.grid=25 1/s",
        "output.fields=[stress]",
        "title=a=b",
    ]
    deck = read_deck(write(CRACKED), settings)
    assert deck.cracks[1].end == "plain"
    assert deck.cracks[0].end == "plain"
    assert deck.solver.damping.grid == 25.0
    assert deck.output.fields == ("stress",)
    assert deck.title == "a=b"
    assert deck.source_text == CRACKED


def test_a_warning_of_schemes_that_may_be_unstable(write):
    """fmpm(2) with usl- grows without bound at a cfl of 0.5, in a plate without cracks."""
    pair = ["solver.update=fmpm(2)", "solver.strain=usl-"]
    (found,) = read_deck(write(SMALL), pair).warnings
    assert "solver.strain: 'usl-' may grow without bound with fmpm(2); use 'usl+'" in str(found)
    for other in ("solver.cfl=0.1", "solver.update=xpic(2)", "solver.strain=usl+"):
        assert read_deck(write(SMALL), [*pair, other]).warnings == []


def test_a_warning_of_schemes_that_tear_domains(write):
    """Places and domains of particles drift apart with all but flip and usavg-."""
    (found,) = read_deck(write(SMALL), ["solver.shape=cpdi"]).warnings
    assert "with flip and usavg+; use update: flip and strain: usavg-" in str(found)
    good = ["solver.shape=cpdi", "solver.strain=usavg-"]
    assert read_deck(write(SMALL), good).warnings == []
    (found,) = read_deck(write(SMALL), [*good, "solver.update=xpic(2)"]).warnings
    assert "with xpic(2) and usavg-" in str(found)


def test_doubts_are_warnings(write):
    settings = [
        "bodies.0.particles_per_cell=1",
        "cracks.straight.segment=5 mm",
        "cracks.straight.start=tip",
        "cracks.straight.points=[[0.0005, 0.02], [0.03, 0.02]]",
        "materials.glass.nu=0.48",
        "materials.spare={law: elastic, density: 1, E: 1, nu: 0}",
    ]
    found = read_deck(write(CRACKED), settings).warnings
    assert all(isinstance(one, Mistake) for one in found)
    assert [f"{one.shown_path}: {one.message}" for one in found] == [
        "cracks.straight.segment: is 5 cells; usual are 0.1 to 2",
        "cracks.straight.start: is a tip within a cell of free space; 'edge' may be meant",
        "bodies.plate.particles_per_cell: fewer than 2 along each side of a cell, "
        "but crack straight runs here",
        "bodies.plate.particles_per_cell: fewer than 2 along each side of a cell, "
        "but crack bow runs here",
        "materials.glass.nu: nearly incompressible (nu = 0.48): stresses may lock",
        "materials.spare: is used by no body",
    ]


def test_import_is_quick_and_light():
    heavy = "{'numba', 'pint', 'h5py', 'scipy', 'matplotlib', 'shapely', 'numpy'}"
    script = f"import sys, cramp_cli.deck.deck; assert not {heavy} & set(sys.modules)"
    subprocess.run([sys.executable, "-c", script], check=True)


def test_json_schema_has_units_and_descriptions():
    schema = deck_schema()
    for section in [schema, *schema["$defs"].values()]:
        for key, field in section["properties"].items():
            assert field.get("description"), key
    cell = schema["$defs"]["GridSection"]["properties"]["cell"]
    assert cell["anyOf"][0] == {"type": "number", "exclusiveMinimum": 0}
    assert "length (SI: m), or text with a unit" in cell["description"]
    assert schema["$defs"]["Rectangle"]["required"] == ["type", "lower", "upper"]
    assert "step" in schema["$defs"]["ForceSection"]["properties"]["in_time"]["anyOf"][0]["enum"]


def test_reference_names_every_key():
    page = deck_reference()
    for key in (
        "cell",
        "K_Ic",
        "particles_per_cell",
        "from",
        "mu_static",
        "until",
        "history_every",
    ):
        assert f"\n| `{key}` |" in page
    assert "| `cell` | length (m) > 0 | required | width of a cell |" in page


def test_missing_files_are_os_errors(tmp_path):
    with pytest.raises(FileNotFoundError):
        read_deck(tmp_path / "none" / "deck.yaml")
    with pytest.raises(IsADirectoryError):
        read_deck(tmp_path)


def test_paths_with_spaces_and_umlauts(write):
    assert read_deck(write(SMALL, "ein schönes Deck.yaml")).analysis == "plane_strain"
    with pytest.raises(DeckError, match="ein schönes Deck.yaml:1:1: the deck is empty"):
        read_deck(write("", "ein schönes Deck.yaml"))
