"""Bodies that touch: when they do, what they keep, Hertz's pressure, a block on an incline."""

import numpy as np
import pytest
from support import advance, build_deck
from verification.solutions import hertz_line, incline_slide

from cramp_cli.state.measures import sum_energies

pytestmark = pytest.mark.verification

# Two disks fly towards each other; gap 4 mm, closing speed 0.4 m/s: contact after 10 ms. Waves are
# a hundred times faster.
DISKS = """
cramp: 1
analysis: plane_strain
grid: {{lower: [-42 mm, -20 mm], upper: [42 mm, 20 mm], cell: {cell} mm}}
materials:
  soft: {{law: elastic, density: 1000 kg/m^3, E: 1 MPa, nu: 0.33}}
bodies:
  - name: left
    material: soft
    velocity: [0.2 m/s, 0]
    shape: {{type: disk, center: [-17 mm, 0], radius: 15 mm}}
  - name: right
    material: soft
    velocity: [-0.2 m/s, 0]
    shape: {{type: disk, center: [17 mm, 0], radius: 15 mm}}
contact: {{bodies: {{law: frictional, mu: 0.2}}, normal: {normal}}}
solver: {{end_time: 1, update: flip}}
"""
MET = 4e-3 / 0.4  # s


def collide(cell=1.0, normal="logistic", until=19e-3):
    """Return first time of contact (s), and momentum and energy lost: shares of one disk's own."""
    model, state, scratch = build_deck(DISKS.format(cell=cell, normal=normal))
    p, met = state.particles, None
    before, energy = p.mass @ p.velocity, sum(sum_energies(p))
    size = 0.5 * float(p.mass @ np.hypot(*p.velocity.T))
    while state.time < until:
        advance(model, state, scratch, 1)
        if met is None and state.contact_forces.any():
            met = state.time
    assert p.velocity[p.body == 0].mean(axis=0)[0] < 0.0  # they have bounced
    drift = np.abs(p.mass @ p.velocity - before).max()
    return met, drift / size, 1.0 - sum(sum_energies(p)) / energy


@pytest.mark.parametrize("cell", [2.0, 1.0])
def test_disks_meet_in_time_and_keep_momentum_and_energy(cell):
    met, drift, lost = collide(cell)
    print(f"{cell} mm: met {met / MET - 1:+.4f}, drift {drift:.1e}, lost {lost:.4f}")
    assert met == pytest.approx(MET, rel=0.01)
    assert drift <= 1e-12
    assert 0.0 <= lost < 0.02


# A rigid cylinder of radius 100 mm pressed into a block; x = 0 is a symmetry plane. The contact is
# half as wide as the depth at which the stress is looked at.
RADIUS, CELL, STIFFNESS, NU = 100e-3, 0.5e-3, 1e9, 0.3
ARC = [[x, RADIUS - (RADIUS**2 - x**2) ** 0.5] for x in np.linspace(0.0, 9e-3, 60).tolist()]
HERTZ = {
    "cramp": 1,
    "analysis": "plane_strain",
    "grid": {"lower": [-1e-3, -21e-3], "upper": [31e-3, 3e-3], "cell": CELL},
    "materials": {"m": {"law": "elastic", "density": 1000.0, "E": STIFFNESS, "nu": NU}},
    "bodies": [
        {
            "name": "block",
            "material": "m",
            "shape": {"type": "rectangle", "lower": [0, -20e-3], "upper": [30e-3, 0]},
        },
        {
            "name": "cylinder",
            "rigid": {
                "velocity": [0, -1.0],
                "in_time": {"type": "table", "time": [0, 250e-6, 250.1e-6], "value": [1, 1, 0]},
            },
            "shape": {"type": "polygon", "points": [*ARC, [9e-3, 1.5e-3], [0, 1.5e-3]]},
        },
    ],
    "contact": {"bodies": {"law": "frictional"}},
    "boundary": [
        {"where": {"x": 0}, "symmetry": True},
        {"where": {"y": -20e-3}, "fix": ["y"]},
    ],
    "solver": {"end_time": 1.0, "damping": {"grid": 30000.0}},
}


def test_hertz_pressure_under_a_cylinder():
    model, state, scratch = build_deck(HERTZ)
    advance(model, state, scratch, round(500e-6 / model.dt))
    p, force = state.particles, 2.0 * float(state.contact_forces[1, 1])
    half_width, peak = hertz_line(force, RADIUS, STIFFNESS / (1.0 - NU**2))
    near = (p.body == 0) & (p.position[:, 0] < 0.5 * CELL) & (p.position[:, 1] > -1.5 * half_width)
    depth = float(p.position[p.body == 0][:, 1].max()) + 0.25 * CELL - p.position[near, 1]
    wanted = -peak / np.sqrt(1.0 + (depth / half_width) ** 2)
    off = p.stress[near, 1] / wanted - 1.0
    print(f"a {half_width / CELL:.2f} cells, p0 {peak:.4g}")
    for d, o in sorted(zip(depth / half_width, off, strict=True)):
        print(f"  depth {d:.3f} a: {o:+.4f}")
    pairs, used = scratch.meeting.pairs, int(scratch.meeting.pairs.used[0])
    touching = pairs.node[:used][pairs.state[:used] > 0] % model.strides[1]
    print("widest node", touching.max() - 2, "cells")
    assert 8.0 < half_width / CELL < 20.0
    assert np.abs(off).max() < 0.05


# A block on a rigid plane at 30 degrees. Gravity comes within 4 ms, or the block would bounce.
ANGLE, RAMP = np.radians(30.0), 4e-3
ALONG, UP = (
    np.array([np.cos(ANGLE), np.sin(ANGLE)]),
    np.array([-np.sin(ANGLE), np.cos(ANGLE)]),
)


def tilted(x, y):
    """Return the corners of a box from (x[0], y[0]) to (x[1], y[1]) in the axes of the incline."""
    corners = ((x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1]))
    return [(a * ALONG + b * UP).tolist() for a, b in corners]


def incline(mu, law):
    return {
        "cramp": 1,
        "analysis": "plane_strain",
        "grid": {"cell": 20e-3},
        "materials": {"m": {"law": "elastic", "density": 1000.0, "E": 200e6, "nu": 0.3}},
        "bodies": [
            {
                "name": "block",
                "material": "m",
                "shape": {"type": "polygon", "points": tilted((0.0, 0.24), (0.0, 0.12))},
            },
            {
                "name": "plane",
                "rigid": {},
                "shape": {"type": "polygon", "points": tilted((-0.1, 0.3), (-0.06, 0.0))},
            },
        ],
        "contact": {"bodies": {"law": law} | ({"mu": mu} if law == "frictional" else {})},
        "loads": [
            {
                "type": "gravity",
                "acceleration": [0, -9.81],
                "in_time": {"type": "ramp", "until": RAMP},
            }
        ],
        "solver": {"end_time": 1.0},
    }


def slide(mu, law="frictional", times=(20e-3, 40e-3)):
    """Return (time, way, velocity) of the block down the incline, and the energy error."""
    model, state, scratch = build_deck(incline(mu, law))
    p, seen = state.particles, []
    block = p.id[p.body == 0]
    for time in times:
        advance(model, state, scratch, round((time - state.time) / model.dt))
        mine = np.isin(p.id, block)
        way = (p.position - p.origin)[mine].mean(axis=0) @ -ALONG
        seen.append((state.time, way, p.velocity[mine].mean(axis=0) @ -ALONG))
    return seen


@pytest.mark.parametrize("mu", [0.0, 0.2, 0.4])  # tan 30 = 0.577
def test_block_slides(mu):
    for time, way, speed in slide(mu):
        wanted = incline_slide(time, ANGLE, mu, RAMP)
        print(f"mu {mu}: way {way / wanted[0] - 1:+.4f} speed {speed / wanted[1] - 1:+.4f}")
    assert way == pytest.approx(wanted[0], rel=0.01)
    assert speed == pytest.approx(wanted[1], rel=0.01)


@pytest.mark.parametrize(("law", "mu"), [("frictional", 0.7), ("stick", 0.0)])
def test_friction_holds_the_block(law, mu):
    time, way, _ = slide(mu, law)[-1]
    print(f"{law}: {way / incline_slide(time, ANGLE, 0.0, RAMP)[0]:+.2e}")
    assert abs(way) < 0.01 * incline_slide(time, ANGLE, 0.0, RAMP)[0]
