"""Bodies of any place and shape: mass, centre, forces and balance are those of the geometry."""

from math import pi

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from pydantic import TypeAdapter
from support import advance, build_deck, locate, read

from cramp_cli.boundary.conditions import add_loads
from cramp_cli.build import filled
from cramp_cli.build.coverage import coverage
from cramp_cli.build.slivers import least_share
from cramp_cli.build.surface import rings_of
from cramp_cli.cracks.fields import find_openings
from cramp_cli.deck.shapes import AnyShape
from cramp_cli.scratch import make_scratch
from cramp_cli.transfer.sums import sort_particles, sum_internal_force, sum_mass_and_momentum

GROUND = """
cramp: 1
analysis: plane_strain
thickness: 0.3
grid: {cell: 1, lower: [-4, -4], upper: [20, 20]}
materials: {m: {law: elastic, density: 2, E: 1, nu: 0}}
bodies: [{name: b, material: m, shape: {type: rectangle, lower: [0, 0], upper: [1, 1]}}]
solver: {end_time: 1}
"""
PER_VOLUME = 2.0 * 0.3
DISCS_ARE_POLYGONS = 2e-4  # outlines of circles have 64 pieces to a quarter


def thousandths(low, high):
    """Return numbers between two with three decimals."""
    return st.integers(round(1000 * low), round(1000 * high)).map(lambda n: n / 1000)


place = thousandths(0.0, 14.0)
size = thousandths(0.3, 8.0)
per_cell = st.integers(1, 4)
rectangle = st.builds(
    lambda x, y, w, h: {"type": "rectangle", "lower": [x, y], "upper": [x + w, y + h]},
    place, place, thousandths(0.05, 6.0), thousandths(0.05, 6.0),
)  # fmt: skip
disk = st.builds(
    lambda x, y, r: {"type": "disk", "center": [5 + x / 3, 5 + y / 3], "radius": r},
    place, place, size,
)  # fmt: skip
annulus = st.builds(
    lambda x, y, r, share: {
        "type": "annulus", "center": [5 + x / 3, 5 + y / 3], "outer": r, "inner": share * r,
    },
    place, place, size, thousandths(0.1, 0.97),
)  # fmt: skip
ellipse = st.builds(
    lambda x, y, a, b, angle: {
        "type": "ellipse", "center": [5 + x / 3, 5 + y / 3], "radii": [a, b], "angle": angle,
    },
    place, place, size, size, thousandths(0, 180),
)  # fmt: skip
triangle = st.builds(
    lambda points: {"type": "polygon", "points": [list(p) for p in points]},
    st.lists(st.tuples(place, place), min_size=3, max_size=3, unique=True),
)
any_shape = st.one_of(rectangle, disk, annulus, ellipse, triangle)


def outline_of(shape):
    return TypeAdapter(AnyShape).validate_python(shape, context={"folder": None}).outline()


def body(shape, per_cell=2, **more):
    return {"name": "b", "material": "m", "particles_per_cell": per_cell, "shape": shape} | more


def area(shape) -> float:
    """Return the area of a shape by its formula."""
    kind = shape["type"]
    if kind == "rectangle":
        return float(np.prod(np.subtract(shape["upper"], shape["lower"])))
    if kind == "disk":
        return pi * shape["radius"] ** 2
    if kind == "annulus":
        return pi * (shape["outer"] ** 2 - shape["inner"] ** 2)
    return (
        pi * np.prod(shape["radii"]) if kind == "ellipse" else shapely.Polygon(shape["points"]).area
    )


@given(st.lists(st.lists(st.tuples(place, place), min_size=3, max_size=6), min_size=1, max_size=4))
@settings(deadline=None, max_examples=60)
def test_what_lies_in_each_box(corners):
    """Boxes cut one by one by another program are the reference: area and centroid of each."""
    region = shapely.Point(7, 7).buffer(5)
    for n, points in enumerate(corners):
        other = shapely.convex_hull(shapely.MultiPoint(points))
        region = region | other if n % 2 else region - other
    assume(region.area > 0.1)
    found = coverage(rings_of(region))
    (x, y), boxes = found.box.T, shapely.box(*found.box.T, *(found.box + 1).T)
    assert len(set(zip(x.tolist(), y.tolist(), strict=True))) == len(x)
    parts = shapely.intersection(boxes, region)
    assert found.area.sum() == pytest.approx(region.area, abs=1e-4)
    assert found.area == pytest.approx(shapely.area(parts), abs=1e-5)
    centre = shapely.get_coordinates(shapely.centroid(parts)) - found.box
    assert found.first == pytest.approx(shapely.area(parts)[:, None] * centre, abs=1e-5)
    hair = 1e-7  # what lies on the border itself belongs to neither side
    x, y = x - hair, y - hair
    right = shapely.linestrings(np.stack([np.c_[x + 1, y], np.c_[x + 1, y + 1]], axis=1))
    lower = shapely.linestrings(np.stack([np.c_[x, y], np.c_[x + 1, y]], axis=1))
    sides = (shapely.length(shapely.intersection(line, region)) for line in (right, lower))
    assert found.side[:, [0, 3]] == pytest.approx(np.stack(list(sides), axis=1), abs=1e-4)


@given(any_shape, per_cell)
@settings(deadline=None, max_examples=60)
def test_mass_and_centre_of_a_body(shape, per_cell):
    assume(area(shape) > 0.01)
    model, state, _ = build_deck(GROUND, bodies=[body(shape, per_cell)])
    particles, region = state.particles, outline_of(shape)
    assert particles.mass.sum() == pytest.approx(PER_VOLUME * area(shape), rel=DISCS_ARE_POLYGONS)
    centre = particles.mass @ particles.position / particles.mass.sum()
    assert centre == pytest.approx(shapely.get_coordinates(region.centroid)[0], abs=1e-4)
    assert particles.mass.min() > 0.0
    assert np.all(model.half is None or model.half <= 0.5)


@given(thousandths(0.1, 0.9), thousandths(0.1, 0.9), thousandths(3.0, 9.0), per_cell)
@settings(deadline=None, max_examples=30)
def test_no_particle_of_a_large_body_is_light(x, y, side, per_cell):
    """A body of several cells has no particle that stands out as a light one."""
    shape = {"type": "rectangle", "lower": [x, y], "upper": [x + side, y + 0.7 * side]}
    _, state, _ = build_deck(GROUND, bodies=[body(shape, per_cell)])
    full = PER_VOLUME / per_cell**2
    assert state.particles.mass.min() >= least_share(per_cell) * full * (1.0 - 1e-9)


@given(disk, rectangle, per_cell)
@settings(deadline=None, max_examples=40)
def test_a_later_body_leaves_neither_gap_nor_overlap(first, second, per_cell):
    """Together they have the mass of the union, the later one all of its own."""
    bodies = [body(first, per_cell), body(second, per_cell, name="later")]
    assume(area(second) > 0.01)
    regions = [outline_of(shape) for shape in (first, second)]
    assume((regions[0] - regions[1]).area > 0.01)
    _, state, _ = build_deck(GROUND, bodies=bodies)
    mass = np.bincount(state.particles.body, state.particles.mass)
    assert mass.sum() == pytest.approx(PER_VOLUME * (regions[0] | regions[1]).area, rel=1e-4)
    assert mass[1] == pytest.approx(PER_VOLUME * area(second), rel=1e-4)


@given(thousandths(0.0, 2.0), thousandths(0.4, 5.0), thousandths(0.3, 5.0))
@settings(deadline=None, max_examples=30)
def test_mass_of_rings(inner, width, height):
    """All around: the integral of 2 pi r over the section."""
    grid = {"cell": 1, "lower": [-2, -4], "upper": [20, 20]}
    shape = {"type": "rectangle", "lower": [inner, 0.3], "upper": [inner + width, 0.3 + height]}
    deck = GROUND.replace("plane_strain", "axisymmetric").replace("thickness: 0.3\n", "")
    _, state, _ = build_deck(deck, bodies=[body(shape)], grid=grid)
    wanted = 2.0 * height * 2.0 * pi * (inner + 0.5 * width) * width
    assert state.particles.mass.sum() == pytest.approx(wanted, rel=1e-9)


BOX = {"type": "rectangle", "lower": [0.37, 1.21], "upper": [9.13, 6.84]}
SPANS = {"x": (0.37, 9.13), "y": (1.21, 6.84)}


def forces(loads, shape=BOX, per_cell=2, **sections):
    """Return model, state and scratch with the forces of loads on the grid."""
    model, state, scratch = build_deck(
        GROUND, bodies=[body(shape, per_cell)], loads=loads, **sections
    )
    locate(model, state, scratch)
    sum_mass_and_momentum(model, state, scratch)
    find_openings(model, state, scratch)
    scratch.grid.force[:] = 0.0
    add_loads(model, scratch, state)
    return model, state, scratch


@given(
    st.sampled_from([("x", 0), ("x", 1), ("y", 0), ("y", 1)]),
    thousandths(0.0, 1.0), thousandths(0.0, 1.0), per_cell,
    st.sampled_from(["ugimp", "linear", "bspline2"]),
)  # fmt: skip
@settings(deadline=None, max_examples=60)
def test_a_traction_acts_on_the_patch_of_the_deck(side, start, end, per_cell, kind):
    (axis, which), along = side, "y" if side[0] == "x" else "x"
    low, high = (float(np.interp(s, (0, 1), SPANS[along])) for s in sorted((start, end)))
    assume(high - low > 0.01)
    where = {axis: SPANS[axis][which], along: [low, high]}
    load = {"type": "traction", "body": "b", "where": where, "traction": [3.0, -5.0]}
    model, _, scratch = forces([load], per_cell=per_cell, solver={"shape": kind})
    total = np.array([3.0, -5.0]) * 0.3 * (high - low)
    assert scratch.grid.force.sum(axis=0) == pytest.approx(total, rel=1e-9)
    if kind == "ugimp" and per_cell > 1:
        nodes = model.lattice.node_positions()
        middle = scratch.grid.force[: len(nodes), 0] @ nodes / total[0]
        wanted = {axis: SPANS[axis][which], along: 0.5 * (low + high)}
        assert middle == pytest.approx([wanted["x"], wanted["y"]], abs=1e-9)


@given(thousandths(0.0, 1.0), thousandths(0.0, 1.0), per_cell)
@settings(deadline=None, max_examples=40)
def test_a_force_acts_on_the_region_of_the_deck(start, end, per_cell):
    """The sum is the deck's; its place is the middle of the region within half a particle."""
    low, high = (float(np.interp(s, (0, 1), SPANS["x"])) for s in sorted((start, end)))
    assume(high - low > 0.01)
    where = {"x": [low, high], "y": [0, 8]}
    load = {"type": "force", "body": "b", "where": where, "total": [3.0, -5.0]}
    model, _, scratch = forces([load], per_cell=per_cell)
    assert scratch.grid.force.sum(axis=0) == pytest.approx([3.0, -5.0], rel=1e-9)
    nodes = model.lattice.node_positions()
    middle = scratch.grid.force[: len(nodes), 0] @ nodes / 3.0
    assert middle[1] == pytest.approx(np.mean(SPANS["y"]), abs=1e-9)
    assert middle[0] == pytest.approx(0.5 * (low + high), abs=0.5 * 1.6 / per_cell)


@given(
    thousandths(0.0, 1.0), thousandths(0.0, 1.0), thousandths(3.0, 7.0), thousandths(3.0, 7.0),
    st.integers(2, 4),
)  # fmt: skip
@settings(deadline=None, max_examples=25)
def test_a_uniform_stress_is_in_balance_with_its_tractions(x, y, width, height, per_cell):
    """At every node, whatever the place and size of a rectangle: the patch test at the border."""
    shape = {"type": "rectangle", "lower": [x, y], "upper": [x + width, y + height]}
    stress = [[2.0, 0.7], [0.7, -3.0]]
    loads = [
        {
            "type": "traction", "body": "b", "where": {axis: shape[side][d]},
            "traction": [sign * component for component in stress[d]],
        }
        for d, axis in enumerate("xy")
        for side, sign in (("lower", -1.0), ("upper", 1.0))
    ]  # fmt: skip
    model, state, scratch = forces(loads, shape, per_cell)
    state.particles.stress[:] = [2.0, -3.0, 0.0, 0.7]
    sum_internal_force(model, state, scratch)
    assert np.abs(scratch.grid.force).max() < 1e-12


@pytest.mark.parametrize("kind", ["ugimp", "cpdi"])
def test_sizes_go_with_their_particles(kind):
    """Sorted anew, every particle still has its own size: not a bit of its sums changes."""
    model, state, scratch = forces([], solver={"shape": kind})
    assert model.half is not None
    for turned in (False, True):
        if turned:
            state.particles.position[:, 0] = 9.5 - state.particles.position[:, 0]
            sort_particles(model, state, scratch)
        half = model.half[state.particles.id]
        np.testing.assert_array_equal(scratch.stencil.half, half)
    assert not np.array_equal(state.particles.id, np.arange(len(half)))


@pytest.mark.parametrize("kind", ["ugimp", "cpdi"])
def test_threads_and_stops_do_not_change_a_bit(kind):
    moving = body(BOX, velocity=[0.06, -0.04], angular_velocity=0.01)
    places = []
    for threads, parts in ((1, (20,)), (2, (20,)), (4, (10, 10))):
        solver = {"shape": kind, "strain": "usavg-"}
        model, state, _ = build_deck(GROUND, bodies=[moving], solver=solver)
        for steps in parts:
            advance(model, state, make_scratch(model, state, threads), steps)
        places.append(state.particles.position[np.argsort(state.particles.id)].tobytes())
    assert places[0] == places[1] == places[2]


@pytest.mark.parametrize("analysis", ["plane_strain", "axisymmetric"])
def test_the_report_says_what_is_asked_and_filled(analysis):
    loads = [
        {"type": "force", "body": "b", "where": {"y": [3, 4]}, "total": [2.0, 0.0]},
        {"type": "traction", "body": "b", "where": {"y": 6.84, "x": [2, 3.3]}, "traction": [0, 4]},
        {"type": "traction", "body": "b", "where": {"y": 1.21}, "pressure": 4, "name": "below"},
    ]
    deck = GROUND.replace("plane_strain", analysis)
    if analysis == "axisymmetric":
        deck = deck.replace("thickness: 0.3\n", "")
    model, state, _ = build_deck(deck, bodies=[body(BOX)], loads=loads)
    facts = filled(read(deck, bodies=[body(BOX)], loads=loads), model, state)
    deep = (lambda x: 0.3) if analysis == "plane_strain" else (lambda x: 2.0 * pi * x)
    mass = 2.0 * area(BOX) * deep(4.75)
    assert facts["b: mass, kg"] == f"{mass:.6g} asked, {mass:.6g} filled (0.000 % off)"
    assert facts["load 1: force, N"] == "2, 0 asked, 2, 0 filled (0.000 % off)"
    up, below = 4 * 1.3 * deep(2.65), 4 * 8.76 * deep(4.75)
    assert facts["load 2: force, N"] == f"0, {up:.6g} asked, 0, {up:.6g} filled (0.000 % off)"
    wanted = f"0, {below:.6g} asked, 0, {below:.6g} filled (0.000 % off)"
    assert facts["load below: force, N"].replace("-0,", "0,") == wanted


@pytest.mark.parametrize(("height", "told"), [(0.74, "0.74"), (1.9, "1.9"), (2.0, None)])
def test_a_thin_body_is_told(height, told):
    shape = {"type": "rectangle", "lower": [0, 0.3], "upper": [10, 0.3 + height]}
    warnings = [str(one) for one in read(GROUND, bodies=[body(shape)]).warnings]
    wanted = [] if told is None else [f"is {told} cells thick: too few for stresses across it"]
    assert len(warnings) == len(wanted)
    assert all(text in warning for text, warning in zip(wanted, warnings, strict=True))


@pytest.mark.parametrize(("pixel", "seed"), [(0.31, 1), (0.5, 2), (0.77, 3), (1.63, 4)])
def test_mass_of_a_picture(tmp_path, pixel, seed):
    """As many pixels as have the grey, each as large as it is, whatever the cell."""
    pictures = pytest.importorskip("PIL.Image")
    mask = np.random.default_rng(seed).random((7, 9)) < 0.6
    pictures.fromarray(np.where(mask, 0, 255).astype(np.uint8)).save(tmp_path / "cut.png")
    shape = {"type": "image", "file": str(tmp_path / "cut.png"), "grey": [0, 99], "pixel": pixel}
    shape["origin"] = [0.3, 0.1]
    _, state, _ = build_deck(GROUND, bodies=[body(shape)])
    wanted = PER_VOLUME * mask.sum() * pixel**2
    assert state.particles.mass.sum() == pytest.approx(wanted, rel=1e-4)


def test_mass_of_a_mesh(tmp_path):
    """The area of its triangles."""
    import meshio

    points = np.random.default_rng(5).uniform(0.0, 12.0, (12, 2))
    corners = [
        triangle for triangle in shapely.delaunay_triangles(shapely.MultiPoint(points)).geoms
    ]
    cells = np.array([
        [int(np.argmin(np.hypot(*(points - c).T))) for c in triangle.exterior.coords[:3]]
        for triangle in corners[::2]
    ])  # fmt: skip
    meshio.Mesh(np.c_[points, np.zeros(12)], [("triangle", cells)]).write(tmp_path / "part.vtu")
    shape = {"type": "mesh", "file": str(tmp_path / "part.vtu")}
    _, state, _ = build_deck(GROUND, bodies=[body(shape)])
    wanted = PER_VOLUME * sum(triangle.area for triangle in corners[::2])
    assert state.particles.mass.sum() == pytest.approx(wanted, rel=1e-4)
