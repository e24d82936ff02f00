"""Every mistake of a deck, in one answer, at its place."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cramp_cli.deck.deck import DeckError, check_deck, read_deck
from cramp_cli.schema.loader import load

GOOD = """\
cramp: 1
analysis: plane_stress
grid: {cell: 1, lower: [-2, -2], upper: [12, 12]}
materials:
  glass: {law: elastic, density: 2500, E: 7.0e10, nu: 0.2}
bodies:
  - {name: plate, material: glass, shape: {type: rectangle, lower: [0, 0], upper: [10, 10]}}
  - {name: hole, hole: true, shape: {type: disk, center: [5, 5], radius: 2}}
cracks:
  - {name: left, points: [[0, 5], [3, 5]], start: edge, end: edge}
boundary:
  - {name: wall, where: {x: 0}, fix: [x]}
loads:
  - {type: force, name: pull, body: plate, where: {x: 10}, total: [1, 0]}
solver: {end_time: 1}
"""
TEN = """\
cramp: 1
titel: ten mistakes
analysis: plane_strian
grid: {cell: 2 mm, lower: [0, 0], upper: [0.1, 0.1]}
materials:
  steel: {law: elastic, density: 1190 lb, E: -210 GPa, nu: 0.6}
bodies:
  - name: plate
    material: stel
    shape: {type: rectangle, lower: [0, 0.01], upper: [0.05, 0.05]}
loads:
  - {type: force, body: plat, where: {x: 0}, total: [0, 1], total: [0, 2]}
solver:
  cfl: NO
"""


@pytest.fixture
def tell(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    def mistakes(text, *overrides):
        (tmp_path / "d.yaml").write_text(text, encoding="utf-8")
        with pytest.raises(DeckError) as caught:
            read_deck("d.yaml", overrides)
        return str(caught.value).splitlines()

    return mistakes


def test_ten_mistakes_and_two_more(tell):
    assert tell(TEN) == [
        "d.yaml:2:1: titel: unknown key; did you mean 'title'?",
        "d.yaml:3:11: analysis: must be one of plane_strain, plane_stress, axisymmetric "
        "(got 'plane_strian'); did you mean 'plane_strain'?",
        "d.yaml:6:34: materials.steel.density: '1190 lb' is no density; "
        "give kg/m^3 or a unit of that kind",
        "d.yaml:6:46: materials.steel.E: must be above 0 (got -210 GPa)",
        "d.yaml:6:60: materials.steel.nu: must be below 0.5 (got 0.6)",
        "d.yaml:9:15: bodies.plate.material: unknown material 'stel'; did you mean 'steel'? "
        "(known: steel)",
        "d.yaml:10:12: bodies.plate.shape: its left side (x = 0 m) leaves no empty layer of cells "
        "to the border of the grid; 0.002 m more is needed",
        "d.yaml:12:25: loads.0.body: unknown body 'plat'; did you mean 'plate'? (known: plate)",
        "d.yaml:12:61: loads.0.total: duplicate key; 'total' stands already in line 12",
        "d.yaml:13:1: solver.end_time: is missing",
        "d.yaml:14:8: solver.cfl: must be a number: a plain number (got 'NO')",
    ]


def test_the_good_deck_is_good(tmp_path):
    (tmp_path / "d.yaml").write_text(GOOD)
    assert read_deck(tmp_path / "d.yaml").warnings == []


@pytest.mark.parametrize(
    ("setting", "found"),
    [
        ("cramp=2", "cramp: this program reads deck format 1 (got 2)"),
        ("cramp=true", "cramp: must be a whole number (got true)"),
        ("title=3", "title: must be text (got 3)"),
        ("thickness=0", "thickness: must be above 0 (got 0)"),
        ("grid=3", "grid: must be a section of keys such as {key: value} (got 3)"),
        ("grid.upper=", "grid.upper: is missing; it goes with lower"),
        ("grid.margin=3", "grid.margin: is for a grid without lower and upper"),
        (
            "grid.upper=[12, 12.4]",
            "grid.upper.1: must be a whole number of cells above lower (got 14.4 cells); "
            "nearest that fits: 12 m",
        ),
        ("grid.upper=[12, -2]", "grid.upper.1: must be above lower (-2 m) (got -2 m)"),
        ("grid={cell: 1, margin: 1}", "grid.margin: must be at least 2 (got 1)"),
        (
            "materials.glass.toughness={K_Ic: 1, G_Ic: 1}",
            "materials.glass.toughness.G_Ic: does not agree with K_Ic, which gives",
        ),
        (
            "materials.glass.toughness={}",
            "materials.glass.toughness: give one of K_Ic, G_Ic, K_IIc",
        ),
        ("materials.glass.G=3", "materials.glass: give E and nu, or K and G"),
        ("materials.glass.nu=", "materials.glass.nu: is missing; it goes with E"),
        (
            "materials.glass.law=",
            "materials.glass.law: must be one of elastic, j2_plastic, neo_hookean, mooney_rivlin, "
            "orthotropic, transverse, viscoelastic, drucker_prager (got nothing)",
        ),
        (
            "materials.a b={law: elastic, density: 1, E: 1, nu: 0}",
            "materials.a b: must start with a letter and hold only letters, digits, _ and - "
            "(got 'a b')",
        ),
        ("bodies=[]", "bodies: must have at least 1 entry (got 0)"),
        (
            "bodies.0.particles_per_cell=5",
            "bodies.plate.particles_per_cell: must be at most 4 (got 5)",
        ),
        ("bodies.0.hole=yes", "bodies.plate.hole: must be true or false (got 'yes')"),
        ("bodies.0.material=", "bodies.plate.material: is missing"),
        ("bodies.1.material=glass", "bodies.hole.material: does not go with hole: true"),
        ("bodies.1.velocity=[1, 0]", "bodies.hole.velocity: does not go with hole: true"),
        (
            "bodies.0.shape.upper=[10, 12.5]",
            "bodies.plate.shape: its top side (y = 12.5 m) is outside the grid by 0.5 m; "
            "leave one empty layer of cells as well",
        ),
        (
            "cracks.0.points=[[0, 5]]",
            "cracks.left.points: must have at least 2 different points (got 1)",
        ),
        ("cracks.0.points=", "cracks.left: give one of points, arc, file"),
        (
            "cracks.0.arc={center: [0, 0], radius: 1, from: 0, to: 1}",
            "cracks.left.arc: give only one of points, arc, file",
        ),
        ("cracks.0.points=[[11.5, 5], [11, 5]]", "cracks.left: lies wholly outside every body"),
        ("cracks.0.points=[[4, 5], [6, 5]]", "cracks.left: lies wholly outside every body"),
        (
            "cracks.0={name: a, arc: {center: [1, 1], radius: 1e-30, from: 0, to: 90}}",
            "cracks.a.arc: is too small beside its coordinates",
        ),
        ("cracks.0.segment=0", "cracks.left.segment: must be above 0 (got 0)"),
        (
            "cracks.0.segment=1e-9",
            "cracks.left.segment: would be cut into 3e+09 pieces (at most 1000000)",
        ),
        (
            "cracks.0.contact={mu: 0.3}",
            "cracks.left.contact.law: is missing; give one of frictional, ignore, stick, glued",
        ),
        (
            "contact.cracks={law: frictional, mu: 0.3, mu_static: 0.2}",
            "contact.cracks.mu_static: must be at least mu (0.3) (got 0.2)",
        ),
        ("boundary.0.where={}", "boundary.wall.where: give x or y or both"),
        (
            "boundary.0.where={x: [2, 1]}",
            "boundary.wall.where.x.1: must not be below 2 m (got 1 m)",
        ),
        (
            "boundary.0.where={x: [1, 2]}",
            "boundary.wall.where: must be a plane: give one number for x or y",
        ),
        (
            "boundary.0.where.x=0.4",
            "boundary.wall.where.x: x = 0.4 m is not on a grid line; nearest are 0 m and 1 m",
        ),
        (
            "boundary.0.where.x=20",
            "boundary.wall.where.x: x = 20 m is outside the grid (-2 m to 12 m)",
        ),
        ("boundary.0.fix=[x, x]", "boundary.wall.fix: names a direction twice"),
        ("boundary.0.fix=x", "boundary.wall.fix: must be a list [...] (got 'x')"),
        (
            "boundary.0={where: {x: 0, y: 0}, symmetry: true}",
            "boundary.0.where: must be exactly one plane: one number for x or y (got 2)",
        ),
        (
            "boundary.0={where: {x: 0}, symmetry: false}",
            "boundary.0.symmetry: must be true; leave it out otherwise",
        ),
        (
            "boundary.0={where: {x: 0}, absorbing: false}",
            "boundary.0.absorbing: must be true; leave it out otherwise",
        ),
        (
            "boundary.0={where: {x: 0, y: 0}, absorbing: true}",
            "boundary.0.where: must be exactly one plane: one number for x or y (got 2)",
        ),
        (
            "boundary.0={where: {x: 0}, velocity: {}}",
            "boundary.0.velocity: give x or y or both",
        ),
        (
            "boundary.0.in_time={type: ramp, until: 1}",
            "boundary.wall.in_time: goes with velocity only",
        ),
        ("boundary.0.in_time=stepp", "boundary.wall.in_time: unknown curve 'stepp'; did you mean"),
        ("loads.0.each=[1, 0]", "loads.pull.each: give only one of total, each"),
        ("loads.0.body=hole", "loads.pull.body: 'hole' is a hole"),
        (
            "loads.0.type=pressure",
            "loads.pull.type: unknown type 'pressure' (known: force, traction",
        ),
        (
            "loads.0={type: traction, body: plate, where: {x: [0, 1]}, pressure: 1}",
            "loads.0.where: must be exactly one plane: one number for x or y (got 0)",
        ),
        ("solver.update=fmpm", "solver.update: must be written fmpm(k) with a whole number k"),
        ("solver.update=flop", "solver.update: unknown update 'flop'; did you mean 'flip'?"),
        (
            "solver={end_time: 1, shape: linear, strain: usl-}",
            "solver.strain: 'usl-' does not go with shape: linear; use 'usl+'",
        ),
        ("fracture.radius=[1, 0]", "fracture.radius.1: must be above 0 (got 0 m)"),
        ("fracture.methods=[domain, domain]", "fracture.methods.1: 'domain' is given twice"),
        ("fracture.contour.terms=3", "fracture.contour.terms: must be at most 2 (got 3)"),
        ("output.every=0", "output.every: must be above 0 (got 0)"),
        ("outptu.every=1", "outptu: unknown key; did you mean 'output'?"),
        (
            "cracks.lef.end=tip",
            "cracks: has 1 entry (left) and none is 'lef'; did you mean 'left'?",
        ),
        ("cracks.1.end=tip", "cracks: has 1 entry (left) and none is '1'"),
        ("cramp.x=1", "cramp: has no keys below it; set it as a whole"),
        ("solver", "must be path.to.key=value, as in solver.cfl=0.3"),
        ("=3", "must be path.to.key=value, as in solver.cfl=0.3"),
        ("solver.cfl=[", "solver.cfl: not valid YAML"),
        ("solver.cfl=&a 3", "solver.cfl: anchors (&) and aliases (*) are not allowed"),
    ],
)
def test_one_mistake_of_an_override(tell, setting, found):
    lines = tell(GOOD, setting)
    assert len(lines) == 1
    assert lines[0].startswith(f"-s {setting}: {found}")


def test_mistakes_of_the_deck_come_before_those_of_overrides(tell):
    lines = tell(GOOD.replace("E: 7.0e10", "E: 0"), "solver.cfl=3", "thickness=-1")
    assert lines == [
        "d.yaml:5:43: materials.glass.E: must be above 0 (got 0)",
        "-s solver.cfl=3: solver.cfl: must be at most 1 (got 3)",
        "-s thickness=-1: thickness: must be above 0 (got -1)",
    ]


def test_names_given_twice(tell):
    lines = tell(GOOD.replace("name: hole", "name: plate"))
    assert lines == ["d.yaml:8:12: bodies.1.name: 'plate' is taken already in bodies"]


def test_a_misspelt_key_that_is_needed_is_one_mistake(tell):
    lines = tell(GOOD.replace("nu:", "un:").replace("end_time", "end_tiem"))
    assert lines == [
        "d.yaml:5:51: materials.glass.un: unknown key; did you mean 'nu'?",
        "d.yaml:15:10: solver.end_tiem: unknown key; did you mean 'end_time'?",
    ]


def test_missing_sections(tell):
    assert tell("cramp: 1\n") == [
        f"d.yaml:1:1: {key}: is missing"
        for key in ("analysis", "bodies", "grid", "materials", "solver")
    ]


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("", "d.yaml:1:1: the deck is empty; it begins with 'cramp: 1'"),
        ("[1, 2]", "d.yaml:1:1: a deck is a list of sections such as 'grid: {cell: 1 mm}'"),
        ("hello", "d.yaml:1:1: a deck is a list of sections such as 'grid: {cell: 1 mm}'"),
        ("a: {b", "d.yaml:1:6: not valid YAML"),
    ],
)
def test_what_is_no_deck(tell, text, found):
    assert tell(text)[0].startswith(found)


def test_planes_and_bodies_in_an_automatic_grid(tell):
    text = GOOD.replace(", lower: [-2, -2], upper: [12, 12]", "").replace("x: 0}", "x: 0.25}")
    assert tell(text) == [
        "d.yaml:12:29: boundary.wall.where.x: x = 0.25 m is not on a grid line; "
        "nearest are 0 m and 1 m"
    ]


WORDS = st.sampled_from(GOOD.replace("{", " ").replace("}", " ").replace(",", " ").split())
VALUES = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=8) | WORDS,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(WORDS | st.text(max_size=5), inner),
    max_leaves=6,
)


def places(data, path=()):
    yield path
    items = data.items() if isinstance(data, dict) else enumerate(data)
    for key, value in items if isinstance(data, dict | list) else ():
        yield from places(value, (*path, key)) if isinstance(value, dict | list) else [(*path, key)]


@settings(max_examples=300)
@given(st.data())
def test_a_changed_deck_is_read_or_refused(tmp_path_factory, data):
    """No change of any value leads to anything but a deck or a DeckError that names something."""
    source = load(GOOD)
    path = data.draw(st.sampled_from([path for path in places(source.data) if path]))
    node = source.data
    for key in path[:-1]:
        node = node[key]
    node[path[-1]] = data.draw(VALUES)
    try:
        check_deck(source, tmp_path_factory.getbasetemp())
    except DeckError as error:
        found = str(error)
    else:
        found = "d"
    assert found
