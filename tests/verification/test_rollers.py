"""Rigid rollers and pins: bending and compact tension by the handbook, Hertz's contact of disks."""

import numpy as np
import pytest
from runs import Listener, Rows
from scipy.optimize import brentq
from support import advance, build_deck, read
from verification.solutions import hertz_line

from cramp_cli.build import build
from cramp_cli.simulation import simulate
from cramp_cli.transfer import sums

pytestmark = [pytest.mark.verification, pytest.mark.slow]

# Both specimens: W = 20 cells of 1 mm, 10 mm thick, a/W = 0.5, plane strain, no friction.
STEEL = {"law": "elastic", "density": 7800.0, "E": 200e9, "nu": 0.3}
W, THICK = 20e-3, 10e-3


def rectangle(lower, upper):
    return {"type": "rectangle", "lower": lower, "upper": upper}


def disk(x, y, radius):
    return {"type": "disk", "center": [x, y], "radius": radius}


def roller(name, shape, speed, times):
    curve = {"type": "table", "time": list(times), "value": [0, 1, 1, 0]}
    return {"name": name, "rigid": {"velocity": [0, speed], "in_time": curve}, "shape": shape}


def specimen(bodies, crack, lower, upper, end):
    """Return a deck; lower, upper: of the grid (m)."""
    return {
        "cramp": 1,
        "analysis": "plane_strain",
        "thickness": THICK,
        "grid": {"cell": 1e-3, "lower": lower, "upper": upper},
        "materials": {"steel": STEEL},
        "bodies": bodies,
        "cracks": [{"name": "notch", "points": crack, "start": "edge", "end": "tip"}],
        "contact": {"bodies": {"law": "frictional", "mu": 0}},
        "solver": {"end_time": end, "cfl": 0.8, "damping": {"particle": 40e3}},
        "output": {"every": 1.0, "history_every": end / 4},
    }


def bend(x=0.0, y=0.0):
    """Return ASTM E399 SE(B) on rollers of 5 mm; x, y: how far the grid is moved (m)."""
    beam = rectangle([-45e-3, 0.0], [45e-3, W])
    push = (0.0, 50e-6, 250e-6, 300e-6)
    bodies = [
        {"name": "beam", "material": "steel", "shape": beam},
        {"name": "left", "rigid": {}, "shape": disk(-40e-3, -5e-3, 5e-3)},
        {"name": "right", "rigid": {}, "shape": disk(40e-3, -5e-3, 5e-3)},
        roller("top", disk(0.0, 25e-3, 5e-3), -0.2, push),
    ]
    lower, upper = [x - 50e-3, y - 14e-3], [x + 51e-3, y + 36e-3]
    return specimen(bodies, [[0, 0], [0, 10e-3]], lower, upper, 0.5e-3)


def pull(x=0.0):
    """Return ASTM E399 C(T) on pins of 2.4 mm in holes of 2.5 mm; x: how far the grid is moved."""
    push = (0.0, 50e-6, 200e-6, 250e-6)
    bodies = [
        {
            "name": "plate",
            "material": "steel",
            "shape": rectangle([-5e-3, -12e-3], [W, 12e-3]),
        },
        {"name": "upper_hole", "hole": True, "shape": disk(0.0, 5.5e-3, 2.5e-3)},
        {"name": "lower_hole", "hole": True, "shape": disk(0.0, -5.5e-3, 2.5e-3)},
        roller("top", disk(0.0, 5.6e-3, 2.4e-3), 0.1, push),
        roller("bottom", disk(0.0, -5.6e-3, 2.4e-3), -0.1, push),
    ]
    lower, upper = [x - 8e-3, -16e-3], [x + 23e-3, 16e-3]
    return specimen(bodies, [[-5e-3, 0], [10e-3, 0]], lower, upper, 0.5e-3)


def handbook_bend(P):
    """Return K of SE(B), span 4 W, a/W = 0.5, under a force (N): ASTM E399, A1."""
    x = 0.5
    f = 3.0 * x**0.5 * (1.99 - x * (1 - x) * (2.15 - 3.93 * x + 2.7 * x * x))
    return P * 4.0 * W / (THICK * W**1.5) * f / (2.0 * (1 + 2 * x) * (1 - x) ** 1.5)


def handbook_pull(P):
    """Return K of C(T), a/W = 0.5, under a force (N): ASTM E399, A2."""
    x = 0.5
    f = (2 + x) / (1 - x) ** 1.5 * (0.886 + 4.64 * x - 13.32 * x**2 + 14.72 * x**3 - 5.6 * x**4)
    return P / (THICK * W**0.5) * f


def at_rest(deck):
    """Return the last row of the history and of the tip."""
    deck = read(deck)
    model, state = build(deck)
    rows = Rows()
    simulate(deck, model, state, rows, Listener())
    return rows.tables["history"][-1], rows.tables["cracks"][-1]


@pytest.mark.parametrize("y", [0.0, 0.5e-3])
def test_three_point_bend_on_rollers_is_that_of_the_handbook(y):
    """Before, K was 11 % low, and the supports pushed the beam aside with a fifth of the force."""
    history, tip = at_rest(bend(y=y))
    P = history["contact_top_y"]
    thrust = max(abs(history[f"contact_{name}_x"]) for name in ("left", "right", "top")) / P
    share = tip["K_I"] / handbook_bend(P)
    print(f"y {y}: K {share:.4f}, thrust {thrust:.1e}")
    assert share == pytest.approx(1.0, abs=0.01)
    assert thrust < 0.005


@pytest.mark.parametrize("x", [0.3e-3, 0.5e-3])
def test_rollers_between_nodes_bear_the_beam_where_they_are(x):
    """The node next to a roller took all, 0.3 cells aside, and tilted: 5 % of thrust."""
    model, state, scratch = build_deck(bend(x=x))
    advance(model, state, scratch, round(0.4e-3 / model.dt))
    pairs, used = scratch.meeting.pairs, int(scratch.meeting.pairs.used[0])
    scratch.grid.force[:] = 0.0
    sums.sum_internal_force(model, state, scratch)
    place = model.lattice.node_positions()[pairs.node[:used]]
    force, group = scratch.grid.force[pairs.row[:used, 0]], pairs.group[:used, 1]
    for number, at in ((1, -40e-3), (2, 40e-3), (3, 0.0)):
        mine = group == number
        total = force[mine].sum(axis=0)
        line = place[mine, 0] @ force[mine, 1] / total[1]
        print(f"roller {number}: {(line - at) * 1e3:+.3f} cells, thrust {total[0] / total[1]:+.4f}")
        assert abs(line - at) < 0.05e-3
        assert abs(total[0]) < 0.005 * abs(total[1])


def test_compact_tension_on_pins_is_that_of_the_handbook():
    history, tip = at_rest(pull())
    P = 0.5 * (history["contact_bottom_y"] - history["contact_top_y"])
    share = tip["K_I"] / handbook_pull(abs(P))
    print(f"K {share:.4f}")
    assert share == pytest.approx(1.0, abs=0.01)


E, NU, CELL = 1e9, 0.3, 1e-3


def pressed(radius, die, push):
    """Return a quarter of an elastic disk under a rigid one, or a plate, and when it stops (s).

    radius: in cells; die: radius of the rigid disk in cells, 0 for a plate; push: over the radius
    """
    R, until = radius * CELL, float(400 * CELL * np.sqrt(1000.0 / E))
    if die:
        x = np.linspace(0.0, 0.5 * R, 60)
        low = np.stack([x, R + die * CELL - np.sqrt((die * CELL) ** 2 - x**2)], axis=1)
        ring = [*low.tolist(), [0.5 * R, R + 8 * CELL], [0.0, R + 8 * CELL]]
        shape = {"type": "polygon", "points": ring}
    else:
        shape = rectangle([0.0, R], [0.6 * R, R + 5 * CELL])
    curve = {"type": "table", "time": [0, until, 1.0001 * until], "value": [1, 1, 0]}
    moved = {"velocity": [0, -push * R / until], "in_time": curve}
    return until, {
        "cramp": 1,
        "analysis": "plane_strain",
        "grid": {"cell": CELL},
        "materials": {"m": {"law": "elastic", "density": 1000.0, "E": E, "nu": NU}},
        "bodies": [
            {"name": "disk", "material": "m", "shape": disk(0.0, 0.0, R)},
            {"name": "left", "hole": True, "shape": rectangle([-2 * R, -2 * R], [0, 2 * R])},
            {"name": "low", "hole": True, "shape": rectangle([-2 * R, -2 * R], [2 * R, 0])},
            {"name": "die", "rigid": moved, "shape": shape},
        ],
        "contact": {"bodies": {"law": "frictional"}},
        "boundary": [
            {"where": {"x": 0}, "symmetry": True},
            {"where": {"y": 0}, "symmetry": True},
        ],
        "solver": {"end_time": 1.0, "damping": {"particle": 0.75 * (E / 1000.0) ** 0.5 / R}},
    }


@pytest.mark.parametrize(
    ("radius", "die", "push"), [(40.0, 80.0, 0.02), (40.0, 0.0, 0.02), (40.5, 0.0, 0.02)]
)
def test_hertz_contact_of_a_rigid_and_an_elastic_disk(radius, die, push):
    """Force against approach (Johnson 1985, 5.57), half width against force (Hertz).

    The half width is that of the ellipse with the second moment of the forces of the nodes.
    """
    until, deck = pressed(radius, die, push)
    model, state, scratch = build_deck(deck)
    advance(model, state, scratch, round(2.5 * until / model.dt))
    force = 2.0 * float(state.contact_forces[1, 1])
    curved = CELL / (1.0 / radius + (1.0 / die if die else 0.0))
    stiff = E / (1.0 - NU**2)

    def approach(P):
        wide, _ = hertz_line(P, curved, stiff)
        return P / (np.pi * stiff) * (2.0 * np.log(4.0 * radius * CELL / wide) - 1.0)

    wanted = brentq(lambda P: approach(P) - push * radius * CELL, 0.1 * force, 10.0 * force)
    pairs, used = scratch.meeting.pairs, int(scratch.meeting.pairs.used[0])
    scratch.grid.force[:] = 0.0
    sums.sum_internal_force(model, state, scratch)
    x = model.lattice.node_positions()[pairs.node[:used], 0]
    f = scratch.grid.force[pairs.row[:used, 0], 1]
    half_width, (hertz, _) = 2.0 * np.sqrt(x**2 @ f / f.sum()), hertz_line(force, curved, stiff)
    print(f"force {force / wanted:.4f}, half width {half_width / hertz:.4f} of {hertz / CELL:.1f}")
    assert force == pytest.approx(wanted, rel=0.03)
    assert half_width == pytest.approx(hertz, rel=0.03)
