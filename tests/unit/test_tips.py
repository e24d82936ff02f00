"""Which tips are measured, and how far their domains reach."""

import numpy as np
import pytest
from support import advance, build_deck, locate

from cramp_cli.cracks.cloud import cloud_around
from cramp_cli.cracks.domain import hooke_of
from cramp_cli.cracks.doubts import doubts
from cramp_cli.cracks.site import block_at, site_of
from cramp_cli.cracks.tips import crack_length, sample_tips, tips_of
from cramp_cli.transfer.sums import sort_particles

PLATE = """
cramp: 1
analysis: plane_stress
grid: {cell: 1}
materials:
  soft: {law: elastic, density: 1, E: 2, nu: 0.25}
  hard: {law: elastic, density: 1, E: 20, nu: 0.4}
bodies: [{name: plate, material: soft, shape: {type: rectangle, lower: [0, 0], upper: [30, 20]}}]
solver: {end_time: 1}
"""


def sampled(*cracks, **sections):
    """Return the rows of all tips of a plate at rest, by crack and end."""
    named = [{"name": f"c{n}", **crack} for n, crack in enumerate(cracks)]
    model, state, scratch = build_deck(PLATE, cracks=named, **sections)
    locate(model, state, scratch)
    return {(row["crack"], row["tip"]): row for row in sample_tips(model, state, scratch)}


def inner(*points, **more):
    return {"points": [list(p) for p in points], **more}


def test_tips_and_their_directions():
    """Out of the crack at both ends; ends at an edge and plain ends are no tips."""
    cracks = [
        {"name": "a", **inner((8, 10), (12, 13))},
        {"name": "b", **inner((0, 5), (8, 5), start="edge", end="plain")},
    ]
    _, state, _ = build_deck(PLATE, cracks=cracks)
    tips = tips_of(state.paths)
    assert [(tip.crack, tip.end) for tip in tips] == [(0, 0), (0, 1)]
    directions = [tip.direction(state.paths.point) for tip in tips]
    np.testing.assert_allclose(directions, [(-0.8, -0.6), (0.8, 0.6)], atol=1e-14)
    assert crack_length(state.paths, 0) == pytest.approx(5.0, rel=1e-14)


def test_a_body_at_rest_has_no_intensity():
    row = sampled(inner((0, 10), (15, 10), start="edge"))["c0", "end"]
    assert (row["J"], row["K_I"], row["K_II"], row["status"]) == (0.0, 0.0, 0.0, "ok")
    assert (row["x"], row["y"], row["angle"], row["length"]) == (15.0, 10.0, 0.0, 15.0)


@pytest.mark.parametrize(("crack", "word"), [
    (inner((0, 10), (11, 10), (15, 14), start="edge"), "ok"),  # 5.7 cells from the bend
    (inner((0, 10), (12, 10), (15, 13), start="edge"), "shrunk: a bend of the crack"),  # 4.2 cells
    (inner((0, 10), (14, 10), (15, 11), start="edge"), "invalid: a bend of the crack"),  # 1.4 cells
    (inner((0, 3), (15, 3), start="edge"), "shrunk: the edge of the body"),
    (inner((0, 1), (15, 1), start="edge"), "invalid: the edge of the body"),
    (inner((11, 10), (15, 10)), "shrunk: the other tip"),
])  # fmt: skip
def test_what_is_near_a_tip_shrinks_its_domain(crack, word):
    """Radius 5 cells, 2.5 at least; kinks, edges, other tips must stay outside."""
    assert sampled(crack, fracture={"methods": ["domain"]})["c0", "end"]["status"].startswith(word)


def test_another_crack_shrinks_the_domain():
    rows = sampled(
        inner((0, 10), (15, 10), start="edge"),
        inner((18, 2), (18, 18)),
        fracture={"methods": ["domain"]},
    )
    assert rows["c0", "end"]["status"].startswith("shrunk: crack c1")
    assert rows["c1", "start"]["status"].startswith("shrunk: the edge")


def test_the_frame_turns_with_the_solid():
    """Whatever the points of the crack do: the mean rotation of the particles around the tip."""
    crack = {"name": "c", **inner((0, 10), (15, 10), start="edge")}
    model, state, scratch = build_deck(PLATE, cracks=[crack])
    state.particles.F[:] = [0.8, -0.6, 0.6, 0.8]
    (tip,) = tips_of(state.paths)
    frame = site_of(model, state, scratch, tip).frame
    np.testing.assert_allclose([frame.before, frame.now], [(1.0, 0.0), (0.8, 0.6)], atol=1e-14)


def test_particles_on_a_crack_lie_below_it_for_both_tips():
    """A diagonal through particles: faces are a row of particles above it, the frames go midway."""
    model, state, scratch = build_deck(PLATE, cracks=[{"name": "c", **inner((8, 4), (20, 16))}])
    shifts = []
    for tip in tips_of(state.paths):
        place = state.paths.origin[tip.points[0]]
        shifts.append(np.array(site_of(model, state, scratch, tip).frame.origin) - place)
    np.testing.assert_allclose(shifts[0], shifts[1], atol=1e-9)
    assert shifts[0] @ (-1.0, 1.0) > 0.1  # above: particles are a quarter of sqrt(2) cells apart


def test_a_fixed_crack_has_no_opening():
    row = sampled(inner((0, 10), (15, 10), start="edge", motion="fixed"))["c0", "end"]
    assert np.isnan([row["ctod_n"], row["ctod_t"]]).all()


def rectangle(x0, y0, x1, y1):
    return {"type": "rectangle", "lower": [x0, y0], "upper": [x1, y1]}


def pieces(*materials):
    """Return a plate of 30 x 20 whose right half is another body."""
    shapes = rectangle(0, 0, 15, 20), rectangle(15, 0, 30, 20)
    parts = enumerate(zip(materials, shapes, strict=True))
    return [{"name": f"b{n}", "material": m, "shape": s} for n, (m, s) in parts]


def test_constants_are_those_of_the_material_at_the_tip():
    """Plane stress: kappa = (3 - nu)/(1 + nu), E' = E, nu/(1 + nu) for nu."""
    model, state, scratch = build_deck(PLATE, bodies=pieces("soft", "hard"))
    for x, E, nu in ((14.9, 2.0, 0.25), (15.1, 20.0, 0.4)):
        place = np.array([x, 10.0])
        law = block_at(model, cloud_around(model, state, scratch, place, 3.0), place).law
        wanted = (E / (2 + 2 * nu), (3 - nu) / (1 + nu), nu / (1 + nu), E)
        assert tuple(hooke_of(law, model.geometry)) == pytest.approx(wanted, rel=1e-13)


def test_the_angle_is_in_radians():
    """As columns.json says: to the upper left, three quarters of pi."""
    assert sampled(inner((20, 5), (15, 10)))["c0", "end"]["angle"] == pytest.approx(3 * np.pi / 4)


def test_a_radius_that_is_too_small_is_named():
    """Below 2.5 cells there is no number; 2.5 cells are enough."""
    crack = inner((0, 10), (15, 10), start="edge")
    for radius, word in (([2.4], "invalid: the radius is below 2.5 cells"), ([2.5], "ok")):
        row = sampled(crack, fracture={"radius": radius, "methods": ["domain"]})["c0", "end"]
        assert row["status"] == word


def test_radii_to_compare_keep_away_from_obstacles():
    """Nothing left to compare: the spread is no number, and not zero."""
    crack, radii = inner((8, 10), (15, 10)), [3.0, 8.0]
    row = sampled(crack, fracture={"radius": radii, "methods": ["domain"]})["c0", "end"]
    assert row["status"] == "ok"
    assert np.isnan(row["J_spread"])


def test_a_tip_near_another_crack_has_no_room():
    rows = sampled(inner((0, 10), (14.8, 10), start="edge"), inner((15, 5), (15, 15)))
    assert rows["c0", "end"]["status"].startswith("invalid: crack c1 is nearer than 2.5 cells")


def test_an_end_on_another_crack_is_no_tip():
    rows = sampled(inner((0, 10), (15, 10), start="edge"), inner((15, 5), (15, 15)))
    assert set(rows) == {("c1", "start"), ("c1", "end")}


LAYERED = inner((0, 10), (12, 10), start="edge")  # its tip is 3 cells before the second half


@pytest.mark.parametrize(("materials", "contour", "word"), [
    (("soft", "twin"), 2, "ok"),
    (("soft", "hard"), 2, "corrected: the domain holds another material"),
    (("soft", "heavy"), 3, "ok"),
    (("heavy", "soft"), 3, "ok"),
    (("soft", "hard"), 3, "corrected: the domain holds another material; "
     "contour invalid: another material lies within the contour"),
])  # fmt: skip
def test_materials_are_told_apart_by_their_law(materials, contour, word):
    """Two names for one law are one material; another density does no harm."""
    soft = {"law": "elastic", "density": 1, "E": 2, "nu": 0.25}
    more = {"twin": soft, "heavy": {**soft, "density": 3}}
    fracture = {"contour": {"cells": contour}}
    bodies = pieces(*materials)
    row = sampled(LAYERED, bodies=bodies, materials=more, fracture=fracture)["c0", "end"]
    assert row["status"] == word


def test_the_edge_of_the_body_is_told_from_another_material():
    """A hole beside the tip, cut into the second half."""
    hole = {"name": "gap", "hole": True, "shape": rectangle(15, 0, 22, 20)}
    bodies = [*pieces("soft", "hard"), hole]
    row = sampled(LAYERED, bodies=bodies, fracture={"methods": ["domain"]})
    assert row["c0", "end"]["status"].startswith("shrunk: the edge of the body")


def pulled(axis, low, high, mirror, pull=1e-3, law=None, steps=60, **more):
    """Return J, K_I, K_II of a plate that is pulled apart across an edge crack, after some steps.

    axis: the normal of the crack; low, high: where the plate ends along it
    """

    def turned(along, across):
        return [along, across] if axis == 1 else [across, along]

    shape = {"type": "rectangle", "lower": turned(0, low), "upper": turned(20, high)}
    where = "xy"[axis]
    load = {"type": "traction", "body": "plate"}
    crack = inner(turned(0, 0), turned(10.3, 0), start="edge", contact=law or {"law": "ignore"})
    model, state, scratch = build_deck(
        PLATE,
        bodies=[{"name": "plate", "material": "soft", "shape": shape}],
        cracks=[{"name": "c", **crack}],
        loads=[
            load | {"where": {where: at}, "traction": turned(0, pull if at > 0 else -pull)}
            for at in (low, high)
            if at
        ],
        boundary=[{"where": {where: 0}, "symmetry": True}] if mirror else [],
        **more,
    )
    advance(model, state, scratch, steps)
    return sample_tips(model, state, scratch)[0]


@pytest.mark.parametrize("axis", [0, 1])
def test_a_crack_on_a_symmetry_plane_has_half_a_domain(axis):
    """The other half is its image: J and K_I are those of the whole plate, K_II is none."""
    whole = pulled(axis, -8, 8, mirror=False)
    assert whole["K_I"] > 0.0
    for low, high in ((0, 8), (-8, 0)):
        half = pulled(axis, low, high, mirror=True)
        for name in ("J", "K_I", "J_spread"):
            assert half[name] == pytest.approx(whole[name], rel=1e-9)
        assert half["K_II"] == 0.0
        assert half["status"] == "contour invalid: the crack lies on a symmetry plane"


@pytest.mark.parametrize("tips", ["smooth", "sharp"])
@pytest.mark.parametrize("y", [10.0, 10.3, 10.5])
def test_the_contour_sees_the_whole_side_of_a_node(tips, y):
    """Beside a smooth tip a side has two rows; a uniform pull along the crack has J = 0."""
    crack = {"name": "c", **inner((0, y), (15.2, y), start="edge")}
    model, state, scratch = build_deck(PLATE, cracks=[crack], solver={"tips": tips})
    locate(model, state, scratch)
    particles = state.particles
    particles.F[:], particles.stress[:, 0], particles.work[:] = [1.01, 0, 0, 1], 0.02, 1e-4
    (row,) = sample_tips(model, state, scratch)
    assert row["status"] == "ok"
    assert row["J_contour"] == pytest.approx(0.0, abs=1e-16)


def test_faces_that_are_pressed_together_are_closed():
    """Contact leaves no K_I below zero, whatever the nodes say at this moment."""
    law = {"law": "frictional", "mu": 0.3}
    row = pulled(1, -8, 8, mirror=False, pull=-1e-3, law=law, steps=30)
    closed, *doubt = row["status"].split("; ")
    assert (row["K_I"], closed) == (0.0, "closed")
    assert [text.startswith("doubtful: J is -") for text in doubt] == [True]  # touched while apart


def test_the_end_of_a_symmetry_plane_is_an_obstacle():
    """Beyond it the body is free, and no half of a cracked one."""
    sides = {"bodies": [{"name": "b", "material": "soft", "shape": rectangle(0, 0, 30, 20)}]}
    crack = inner((0, 0), (15, 0), start="edge", contact={"law": "ignore"})
    plane = {"where": {"y": 0, "x": [0, 18]}, "symmetry": True}
    row = sampled(crack, boundary=[plane], fracture={"methods": ["domain"]}, **sides)["c0", "end"]
    assert row["status"] == "shrunk: the end of a symmetry plane within 5 cells"


def test_a_cloud_holds_all_particles_around_a_place():
    """Also after they were sorted, and at the corner of the grid."""
    model, state, scratch = build_deck(PLATE, bodies=pieces("soft", "hard"))
    state.particles.position[:] = state.particles.position[::-1].copy()  # any other order of cells
    sort_particles(model, state, scratch)
    for place in (np.array([15.2, 9.7]), np.array([0.0, 0.0])):
        cloud = cloud_around(model, state, scratch, place, 4.0)
        everyone, found = (
            np.sort(p.id[np.hypot(*(p.origin - place).T) < 4.0])
            for p in (state.particles, cloud.particles)
        )
        np.testing.assert_array_equal(found, everyone)
        assert len(cloud.particles.id) < len(state.particles.id)
        assert sum(hi - lo for _, lo, hi in cloud.parts) == len(cloud.particles.id)


def test_a_solid_that_turns_fast_makes_k_of_its_own():
    """A plate that turns freely has no stress but the centrifugal; K found there is the grid's."""
    crack = {"name": "c", **inner((0, 10), (15.3, 10), start="edge", contact={"law": "ignore"})}
    for spin, doubtful in ((0.02, True), (0.0, False)):
        body = {"name": "b", "material": "soft", "shape": rectangle(0, 0, 30, 20)}
        bodies = [body | {"angular_velocity": spin}]
        model, state, scratch = build_deck(PLATE, bodies=bodies, cracks=[crack])
        advance(model, state, scratch, 20)
        (row,) = sample_tips(model, state, scratch)
        assert ("the solid turns by" in row["status"]) is doubtful


def test_a_tip_close_to_another_material_is_corrected():
    """A cell before the second half no domain of one material fits; on the border none does."""
    near, on = inner((0, 10), (14, 10), start="edge"), inner((0, 10), (15, 10), start="edge")
    fracture = {"methods": ["domain"]}
    row = sampled(near, bodies=pieces("soft", "hard"), fracture=fracture)["c0", "end"]
    assert row["status"] == "corrected: the domain holds another material"
    row = sampled(on, bodies=pieces("soft", "hard"), fracture=fracture)["c0", "end"]
    assert row["status"].startswith("invalid: another material")


def test_another_body_shrinks_the_domain_before_it_empties_it():
    """The disk takes next to nothing off the domain, but what it does to the plate is a load in it.

    As one solid with the plate it is none.
    """
    disk = {"name": "disk", "material": "soft"}
    disk["shape"] = {"type": "disk", "center": [15, 16], "radius": 2}
    plate = {"name": "b", "material": "soft", "shape": rectangle(0, 0, 30, 20)}
    crack, more = inner((0, 10), (15, 10), start="edge"), {"bodies": [plate, disk]}
    more["fracture"] = {"methods": ["domain"]}
    assert sampled(crack, **more)["c0", "end"]["status"] == "ok"
    more["contact"] = {"bodies": {"law": "frictional"}}
    row = sampled(crack, **more)["c0", "end"]
    assert row["status"] == "shrunk: another body within 5 cells"


@pytest.mark.parametrize(("J", "K_II", "doubtful"), [
    (-0.10, 0.0, True),  # energy flows out of the tip
    (0.10, 0.6, True),  # less than that of K_II, 0.18
    (0.10, 0.3, False),  # with the work of friction
    (-0.004, 0.0, False),  # noise
])  # fmt: skip
def test_closed_faces_have_no_less_than_the_J_of_K_II(J, K_II, doubtful):
    """The solid around the tip holds 0.1 J/m^3, in five cells 0.5 J/m^2, of which 1 % is noise."""
    crack = inner((0, 10), (15, 10), start="edge")
    model, state, scratch = build_deck(PLATE, cracks=[{"name": "c", **crack}])
    locate(model, state, scratch)
    state.particles.work[:] = 0.1
    (tip,) = tips_of(state.paths)
    site = site_of(model, state, scratch, tip)
    row = {"J": J, "J_tip": J, "K_I": 0.0, "K_II": K_II, "status": "closed"}
    assert bool(doubts(model, site, row, ())) is doubtful
