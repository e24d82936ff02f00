"""Nodes ahead of a smooth tip open as those behind it, and keep their momentum."""

import numpy as np
import pytest
from support import build_deck, locate

from cramp_cli.cracks.fields import follow_behind_tips
from cramp_cli.transfer.sums import sum_mass_and_momentum

DECK = """
cramp: 1
analysis: plane_strain
grid: {cell: 1}
materials: {m: {law: elastic, density: 1.0, E: 1.0, nu: 0.3}}
bodies: [{name: b, material: m, shape: {type: rectangle, lower: [0, 0], upper: [16, 12]}}]
solver: {end_time: 1.0}
"""
LINES = {
    "along a row": [[0, 6.0], [8.4, 6.0]],
    "between rows": [[0, 6.4], [8.4, 6.4]],
    "to the left": [[16, 6.4], [7.3, 6.4]],
    "oblique": [[0, 2.3], [8.4, 6.4]],
}


@pytest.fixture(params=list(LINES), ids=list(LINES))
def plate(request):
    """Return model, state, scratch of a plate with random velocities, summed to its rows."""
    crack = {"name": "c", "points": LINES[request.param], "start": "edge", "end": "tip"}
    model, state, scratch = build_deck(DECK, cracks=[crack])
    state.particles.velocity[:] = np.random.default_rng(1).normal(size=(768, 2))
    locate(model, state, scratch)
    sum_mass_and_momentum(model, state, scratch)
    return model, state, scratch


def used(scratch):
    """Return the rows of followers and leads, and the weights (followers, leads)."""
    f, (n, m) = scratch.followers, scratch.followers.count
    weights = np.zeros((n, m))
    for k in range(4):
        np.add.at(weights, (np.arange(n), f.lead[:n, k]), f.weight[:n, k])
    return f.follower[:n], f.row[:m], weights


def jump(scratch, rows):
    grid = scratch.grid
    mass = np.where(grid.mass[rows] > 0.0, grid.mass[rows], np.inf)  # an empty row opens nothing
    v = grid.momentum[rows] / mass[..., None]
    return v[:, 1] - v[:, 0]


def test_followers_open_as_their_leads(plate):
    model, _, scratch = plate
    followers, leads, weights = used(scratch)
    assert len(followers) >= 2
    np.testing.assert_allclose(weights[weights.any(axis=1)].sum(axis=1), 1.0, rtol=1e-14)
    assert np.abs(jump(scratch, followers) - weights @ jump(scratch, leads)).max() > 0.05
    follow_behind_tips(model, scratch, scratch.grid.momentum)
    led = weights @ jump(scratch, leads)
    full = scratch.grid.mass[followers].min(axis=1) > 0.0
    assert full.sum() >= 2
    np.testing.assert_allclose(jump(scratch, followers)[full], led[full], rtol=0.0, atol=1e-12)


def test_every_node_keeps_its_momentum(plate):
    model, _, scratch = plate
    followers, leads, _ = used(scratch)
    before = scratch.grid.momentum.copy()
    follow_behind_tips(model, scratch, scratch.grid.momentum)
    change = scratch.grid.momentum - before
    pairs = np.concatenate([followers, leads])
    np.testing.assert_allclose(change[pairs].sum(axis=1), 0.0, atol=1e-13)
    change[pairs.ravel()] = 0.0
    assert not change.any()


def test_followers_lie_ahead_and_leads_behind(plate):
    """Just behind the tip those follow, too, that hardly see the other side."""
    model, state, scratch = plate
    followers, leads, _ = used(scratch)
    tip, inner = state.paths.point[-1], state.paths.point[-2]
    out = (tip - inner) / np.hypot(*(tip - inner))
    ahead, behind = (
        (np.stack(np.divmod(rows.min(axis=1), model.strides[1])[::-1], axis=1) - tip) @ out
        + model.lattice.lower @ out
        for rows in (followers, leads)
    )
    far = scratch.grid.mass[followers].min(axis=1)
    assert np.all((ahead > 1e-9) | ((ahead > -1.0) & (far < 0.05)))
    assert np.all(behind <= 1e-9)
    assert not set(followers.min(axis=1)) & set(leads.min(axis=1))


@pytest.mark.parametrize("rise", [0.0, 1e-6, 0.01, 0.1, -1e-6, -0.1])
def test_nodes_of_either_side_lead_where_the_crack_crosses_their_row(rise):
    """The nodes of a row through the tip lie on one side behind it and on the other ahead of it."""
    crack = {"name": "c", "points": [[0, 6.0 - rise], [8.4, 6.0]], "start": "edge", "end": "tip"}
    model, state, scratch = build_deck(DECK, cracks=[crack])
    locate(model, state, scratch)
    sum_mass_and_momentum(model, state, scratch)
    followers, leads, weights = used(scratch)
    held = scratch.grid.mass[followers].min(axis=1) > 0.1  # they see both sides
    assert held.sum() >= 2
    assert np.all(weights[held].sum(axis=1) > 0.999)
    for pairs in (followers, leads):
        assert np.all(above(scratch, pairs[:, 0]))
        assert not np.any(above(scratch, pairs[:, 1]))


def above(scratch, row):
    """Return whether rows hold the upper side of the crack."""
    rows, nodes = scratch.rows, len(scratch.rows.first)
    own = rows.tip_side[np.minimum(row, nodes - 1)] > 0
    return np.where(row < nodes, own, rows.side[np.maximum(row - nodes, 0), 0] > 0)


def test_work_is_the_same_from_both_sides(plate):
    """Momenta become velocities symmetrically: what forces do is what strains take."""
    model, _, scratch = plate
    n, mass = scratch.row_count, scratch.grid.mass[: scratch.row_count, None]
    one, other = np.random.default_rng(2).normal(size=(2, n, 2)) * mass

    def velocity(momentum):
        field = momentum.copy()
        follow_behind_tips(model, scratch, field)
        return np.divide(field, mass, out=np.zeros_like(field), where=mass > 0.0)

    assert np.sum(one * velocity(other)) == pytest.approx(np.sum(other * velocity(one)), rel=1e-12)


def test_a_tip_that_runs_leads_nobody(plate):
    model, state, scratch = plate
    state.growth.running[:] = 1
    locate(model, state, scratch)
    assert not scratch.followers.count.any()
