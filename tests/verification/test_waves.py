"""Waves along a bar against d'Alembert: fronts, plateaus, and the order of convergence.

With nu = 0 a bar in plane strain is a bar of uniaxial stress, of exact speed sqrt(E / rho).
"""

import numpy as np
import pytest
from support import advance, build_deck
from verification.solutions import bar_impact, bar_speed, bar_step_traction, vibrating_bar

pytestmark = pytest.mark.verification

LENGTH, E, RHO = 1.0, 100.0e6, 1000.0  # m, Pa, kg/m^3
SPEED = bar_speed(E, RHO)
PLATEAU = 0.02  # cases.md E, "1D bar impact" and "bar step traction"

BAR = f"""
cramp: 1
analysis: plane_strain
grid: {{lower: [-0.1, -0.02], upper: [1.1, 0.03], cell: 5 mm}}
materials:
  rod: {{law: elastic, density: {RHO}, E: {E}, nu: 0}}
bodies:
  - name: bar
    material: rod
    shape: {{type: rectangle, lower: [0, 0], upper: [{LENGTH}, 10 mm]}}
boundary:
  - {{name: wall, where: {{x: 0}}, fix: [x]}}
solver: {{end_time: 1}}
"""


def advance_to(deck, time):
    """Take the steps of a deck up to the step next to a time (s)."""
    model, state, scratch = deck
    advance(model, state, scratch, round((time - state.time) / model.dt))
    return state


def plateau_errors(x, value, exact, fronts, away):
    """Return mean and largest error on the places that are at least `away` from every front."""
    calm = np.all(np.abs(x[:, None] - np.atleast_1d(fronts)) > away, axis=1)
    error = value[calm] - exact[calm]
    return abs(error.mean()), np.abs(error).max()


if __name__ == "__main__":
    import yaml
    from support import merged
    for damp in ("flip", "fmpm(2)", "xpic(2)", "fmpm(4)"):
        for shape in ("ugimp", "linear"):
            d = yaml.safe_load(BAR); v0=0.1
            d["bodies"][0]["velocity"] = [-v0, 0]
            deck = build_deck(d, solver={"update": damp, "shape": shape})
            print(deck[0].dt, bar_speed(E,RHO)*deck[0].dt/.005)
            for share in (0.5, 1.5, 1.9):
                s = advance_to(deck, share * LENGTH / SPEED); p = s.particles
                st, ve = bar_impact(p.origin[:, 0], s.time, v0, LENGTH, E, RHO)
                c = SPEED * s.time; c = c if c < 1 else 2 - c
                S = RHO * SPEED * v0
                print("impact", damp, shape, share, [np.round(np.array(plateau_errors(p.origin[:, 0], p.stress[:, 0] / S, st / S, c, w)), 4) for w in (.02,.05, .1, .2)], [np.round(np.array(plateau_errors(p.origin[:, 0], p.velocity[:, 0] / v0, ve / v0, c, w)), 4) for w in (.05, .1)], (p.mass@p.velocity[:,0])/(v0*p.mass.sum())-ve.mean()/v0)
            d = yaml.safe_load(BAR)
            d["loads"] = [{"type": "traction", "body": "bar", "where": {"x": 1.0}, "traction": [1000.0, 0]}]
            deck = build_deck(d, solver={"update": damp, "shape": shape})
            for share in (0.5, 1.5, 2.5, 3.5):
                s = advance_to(deck, share * LENGTH / SPEED); p = s.particles
                st = bar_step_traction(p.origin[:, 0], s.time, 1000., LENGTH, E, RHO)
                c = SPEED * s.time
                f = abs((c - LENGTH) % 2 ) if False else None
                c = c % 2; f = abs(1 - c)
                print("traction", damp, shape, share, [np.round(np.array(plateau_errors(p.origin[:, 0], p.stress[:, 0] / 1000, st / 1000, f, w)), 4) for w in (.02,.05, .1, .2)])
