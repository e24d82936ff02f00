"""A crack along an arc of 90 degrees in a pulled plate, wherever it lies in its cells.

Exact: boundary collocation (arc_crack.py). Errors count as shares of the size of K.
"""

import numpy as np
import pytest
from support import advance, build_deck
from verification.arc_crack import Arc, ArcCrack

from cramp_cli.cracks.tips import sample_tips

pytestmark = [pytest.mark.verification, pytest.mark.slow]

RADIUS, HALF, SIGMA = 0.1016, np.pi / 4, 1e6  # m, rad, Pa
END = 0.9e-3  # s, of which the load rises for a sixth
PLATE = """
cramp: 1
analysis: plane_strain
materials:
  steel: {law: elastic, density: 7800, E: 200 GPa, nu: 0.3}
solver: {end_time: 0.9 ms, cfl: 0.8, damping: {particle: 50000}}
fracture: {methods: [domain]}
"""


def errors(cells, shift):
    """Return the errors of K_I, K_II of both tips (2, 2); cells: to half a chord of 72 mm."""
    h = RADIUS * float(np.sin(HALF)) / cells
    wide, high = round(0.14 / h) * h, round(0.21 / h) * h
    center = (h * shift[0], h * shift[1] - 0.85 * RADIUS)
    ramp = {"type": "ramp", "until": END / 6}
    loads = [
        {"type": "traction", "body": "plate", "where": {"y": s * high}, "in_time": ramp}
        | {"traction": [0, s * SIGMA]}
        for s in (-1, 1)
    ]
    shape = {"type": "rectangle", "lower": [-wide, -high], "upper": [wide, high]}
    arc = {"center": list(center), "radius": RADIUS, "from": 135.0, "to": 45.0}
    model, state, scratch = build_deck(
        PLATE,
        grid={"cell": h},
        bodies=[{"name": "plate", "material": "steel", "shape": shape}],
        cracks=[{"name": "c", "arc": arc, "contact": {"law": "ignore"}}],
        loads=loads,
    )
    advance(model, state, scratch, round(END / model.dt))
    exact = ArcCrack(Arc(center, RADIUS, np.pi / 2, HALF), (-wide, -high), (wide, high))
    found = np.array([[row["K_I"], row["K_II"]] for row in sample_tips(model, state, scratch)])
    wanted = SIGMA * np.array([exact.intensities(end) for end in (1, -1)])
    return (found - wanted) / np.hypot(*wanted.T)[:, None]


def places(n):
    return np.random.default_rng(15).uniform(0.0, 1.0, (n, 2)).tolist()


@pytest.fixture(scope="module")
def at_10_cells():
    return np.abs([errors(10, shift) for shift in places(25)]).max(axis=2).ravel()


def test_at_10_cells(at_10_cells):
    """Reached on 2026-11-28: 49 of 50 tips within 3 %, one 3.4 %; before there was no number."""
    assert np.mean(at_10_cells < 0.03) >= 0.98
    assert at_10_cells.max() < 0.036


@pytest.mark.xfail(reason="wanted; one tip of 50 is 3.4 % off, why is not known yet")
def test_all_tips_at_10_cells(at_10_cells):
    assert at_10_cells.max() < 0.03


def test_at_20_cells():
    """Within 1.5 % at three of them; 3.3 % in straight coordinates."""
    assert np.abs([errors(20, shift) for shift in places(3)]).max() < 0.015
