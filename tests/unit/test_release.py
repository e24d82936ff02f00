"""What resists the opening behind a running tip acts on the faces of its crack and nothing else."""

import numpy as np
import pytest
from support import build_deck, locate

from cramp_cli.cracks.release import resist_opening
from cramp_cli.transfer.sums import sum_mass_and_momentum

MATERIALS = {"m": {"law": "elastic", "density": 1.0, "E": 1.0, "nu": 0.3}}


def box(name, left, right):
    shape = {"type": "rectangle", "lower": [left, 0], "upper": [right, 6]}
    return {"name": name, "material": "m", "shape": shape}


def opening(*order):
    """Return model, state, scratch of two bodies that meet at x = 4, in the order of the deck.

    The tip of a crack through the right one has run to half a cell from the left one, which the
    nodes around the tip see as well.
    """
    bodies = {"left": box("left", 0, 4), "right": box("right", 4, 8)}
    deck = {
        "cramp": 1,
        "analysis": "plane_strain",
        "grid": {"cell": 1.0},
        "materials": MATERIALS,
        "bodies": [bodies[name] for name in order],
        "contact": {"bodies": {"law": "frictional"}},
        "cracks": [{"name": "c", "points": [[8, 3.2], [4.5, 3.2]], "start": "edge"}],
        "solver": {"end_time": 1.0},
    }
    model, state, scratch = build_deck(deck)
    velocity = np.random.default_rng(1).normal(size=state.particles.velocity.shape)
    state.particles.velocity[:] = velocity
    state.growth.running[1], state.growth.length[1], state.growth.reach[1] = 1, 3.0, 5.0
    locate(model, state, scratch)
    sum_mass_and_momentum(model, state, scratch)
    return model, state, scratch


def of_body(model, state, scratch, name):
    """Return the rows that the particles of a body see."""
    left = state.particles.origin[:, 0] < 4.0
    mine = left if name == "left" else ~left
    state.particles.velocity[:] = mine[:, None]
    before = scratch.grid.momentum.copy()
    sum_mass_and_momentum(model, state, scratch)
    rows = np.flatnonzero(scratch.grid.momentum[: scratch.row_count, 0])
    scratch.grid.momentum[:] = before
    return rows


@pytest.mark.parametrize("order", [("left", "right"), ("right", "left")])
def test_a_body_beside_the_tip_feels_nothing(order):
    model, state, scratch = opening(*order)
    beside, cracked = (of_body(model, state, scratch, name) for name in ("left", "right"))
    assert not np.intersect1d(beside, cracked).size
    before = scratch.grid.momentum.copy()
    resist_opening(model, state, scratch)
    taken = np.abs(scratch.grid.momentum - before).max(axis=1)
    assert taken[beside].max() == 0.0
    assert np.count_nonzero(taken[cracked]) >= 8  # four nodes, both sides


def test_momentum_is_kept_and_energy_falls():
    model, state, scratch = opening("left", "right")
    grid, count = scratch.grid, scratch.row_count
    mass = grid.mass[:count]
    seen = mass > 0.0

    def energy():
        return 0.5 * np.sum(grid.momentum[:count][seen] ** 2 / mass[seen, None])

    total, held = grid.momentum[:count].sum(axis=0), energy()
    resist_opening(model, state, scratch)
    assert grid.momentum[:count].sum(axis=0) == pytest.approx(total, abs=1e-13)
    assert energy() < 0.999 * held
