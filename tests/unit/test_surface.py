"""The gap between an elastic body and a rigid one is that of geometry, wherever both lie."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from support import build_deck, locate

from cramp_cli.build.surface import surface_beside
from cramp_cli.contact.bodies import find_pairs
from cramp_cli.contact.outline import make_outlines, nearest_beside, normal_on

GRID = {"cell": 1.0, "lower": [-16.0, -12.0], "upper": [16.0, 20.0]}


def met(elastic, rigid):
    """Return the pairs of an elastic shape and a rigid one, with the places of their nodes."""
    deck = {
        "cramp": 1,
        "analysis": "plane_strain",
        "grid": GRID,
        "materials": {"m": {"law": "elastic", "density": 1.0, "E": 1.0, "nu": 0.3}},
        "bodies": [
            {"name": "elastic", "material": "m", "shape": elastic},
            {"name": "rigid", "rigid": {}, "shape": rigid},
        ],
        "contact": {"bodies": {"law": "frictional"}},
        "solver": {"end_time": 1000.0},
    }
    model, state, scratch = build_deck(deck)
    locate(model, state, scratch)
    find_pairs(model, state, scratch)
    pairs, used = scratch.meeting.pairs, int(scratch.meeting.pairs.used[0])
    places = model.lattice.node_positions()[pairs.node[:used]]
    return type(pairs)(*(array[:used] for array in pairs)), places


def disk(x, y, radius):
    return {"type": "disk", "center": [x, y], "radius": radius}


def numbers(low, high):
    """Draw lengths that are whole millionths of a cell."""
    return st.integers(round(low * 1e6), round(high * 1e6)).map(lambda n: n / 1e6)


offsets = numbers(0.0, 1.0)


@settings(max_examples=25)
@given(offsets, numbers(4.0, 9.0), numbers(0.0, 0.3))
def test_a_roller_over_a_flat_face_has_the_gap_of_geometry(x, radius, gap):
    """Told by the lowest particle a node sees it was up to a quarter of a cell less, and tilted."""
    block = {"type": "rectangle", "lower": [-10, -5], "upper": [10, 0]}
    pairs, places = met(block, disk(x, round(radius + gap, 6), radius))
    near = (np.abs(places[:, 0] - x) < 2.0) & (np.abs(places[:, 1]) < 0.5)
    assert near.sum() >= 3
    way = places[near, 0] - x
    under = np.hypot(way, radius + gap) - radius  # the node lies on the face
    alone = pairs.beside[near] < 0
    np.testing.assert_allclose(pairs.gap[near][alone], under[alone], atol=0.01)
    leaning = ~alone & (np.abs(way) < 0.5)
    np.testing.assert_allclose(pairs.gap[near][leaning], gap, atol=0.005)
    assert np.abs(pairs.normal[near][leaning][:, 0]).max(initial=0.0) < 0.005


@settings(max_examples=15)
@given(offsets, offsets, numbers(6.0, 9.0), numbers(0.0, 0.2))
def test_an_elastic_disk_over_a_plane_has_the_gap_of_geometry(x, y, radius, gap):
    """Its surface is steps of half a cell, but its particles know where it is."""
    low = round(y - gap, 6)
    plane = {"type": "rectangle", "lower": [-14, round(low - 4, 6)], "upper": [14, low]}
    pairs, places = met(disk(x, round(y + radius, 6), radius), plane)
    near = (np.abs(places[:, 0] - x) < 0.5) & (pairs.gap < 0.9)
    assert near.any()
    way = places[near, 0] - x
    wanted = y + radius - np.sqrt(radius**2 - way**2) - low
    found = np.where(pairs.beside[near] < 0, pairs.gap[near] - wanted, pairs.gap[near] - gap)
    assert np.abs(found).max() < 0.03
    assert np.abs(pairs.normal[near][:, 0]).max() < 1e-12


@given(st.floats(0.0, 360.0), st.integers(24, 256))
def test_normals_of_a_polygon_that_stands_for_a_circle_are_the_circles(angle, pieces):
    t = np.linspace(0.0, 2.0 * np.pi, pieces + 1)
    outlines = make_outlines([[np.stack([np.cos(t), np.sin(t)], axis=1)]])
    x, y = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    s, way = nearest_beside(outlines, 0, np.cos(0.1), np.sin(0.1))  # it walks around
    s, way = nearest_beside(outlines, s, x, y)
    if abs(np.cos(np.radians(angle)) + 1.0) > 0.1:  # not straight across, where both ways are one
        nx, ny = normal_on(outlines, s, way)
        turned = np.arctan2(ny * np.cos(np.radians(angle)) - nx * np.sin(np.radians(angle)), 1.0)
        assert abs(turned) < 0.3 * (np.pi / pieces) ** 2 + 1e-12


def test_a_flat_side_keeps_its_normal_up_to_the_arc_beside_it():
    t = np.linspace(-np.pi / 2, np.pi / 2, 33)
    arc = np.stack([5.0 + np.cos(t), np.sin(t)], axis=1)
    ring = np.concatenate([[[-5.0, -1.0]], arc, [[-5.0, 1.0], [-5.0, -1.0]]])
    outlines = make_outlines([ring[None]])
    assert normal_on(outlines, 0, 9.9) == pytest.approx((0.0, -1.0), abs=1e-15)
    assert normal_on(outlines, 0, 10.0)[0] > 0.02  # half the turn of a piece of the arc


def test_particles_within_a_body_know_no_surface():
    from shapely import box

    way, normal = surface_beside(
        np.array([[0.25, 3.0], [3.0, 3.0], [3.0, 6.2]]), box(0, 0, 6, 6), 0.5
    )
    assert way.tolist() == [[-0.25, 0.0], [0.0, 0.0], [0.0, pytest.approx(-0.2)]]
    assert normal.tolist() == [[-1.0, 0.0], [0.0, 0.0], [0.0, 1.0]]
