"""From the grid to particles: free fall, damping, FMPM and XPIC (docs/theory/step.md)."""

from dataclasses import replace

import numpy as np
import pytest
from support import advance, build_deck, locate

from cramp_cli.boundary.conditions import meet_rows
from cramp_cli.grid_velocity import find_update_velocity
from cramp_cli.shapes.shape import offsets, place_of, weights
from cramp_cli.transfer.on_grid import find_acceleration
from cramp_cli.transfer.sums import sum_mass_and_momentum
from cramp_cli.transfer.update import Flip, Fmpm, Xpic, moved

STONE = """
cramp: 1
analysis: plane_strain
grid: {cell: 1}
materials: {stone: {law: elastic, density: 2, E: 100, nu: 0.3}}
bodies:
  - name: stone
    material: stone
    shape: {type: disk, center: [0.3, 0.2], radius: 2}
    velocity: [0.3, 1]
solver: {end_time: 1, dt: 0.01}
"""
GRAVITY = {"type": "gravity", "acceleration": [0.5, -2.0]}
UPDATES = pytest.mark.parametrize(
    "update", ["flip", "pic", "fmpm(2)", "fmpm(4)", "xpic(1)", "xpic(2)", "xpic(4)"]
)
V0, G = np.array([0.3, 1.0]), np.array([0.5, -2.0])


@UPDATES
@pytest.mark.parametrize("strain", ["usf", "usl-", "usavg+"])
def test_free_fall_is_exact(update, strain):
    """x = x0 + v0 t + g t^2/2 and v = v0 + g t: all updates are consistent to second order.

    40 steps of round-off of numbers below 3 at a CFL number of 0.1; a first order error would be
    g t dt/2 = 4e-3.
    """
    model, state, scratch = build_deck(
        STONE, loads=[GRAVITY], solver={"update": update, "strain": strain}
    )
    advance(model, state, scratch, 40)
    t, p = state.time, state.particles
    assert t == pytest.approx(0.4)
    np.testing.assert_allclose(p.velocity, np.tile(V0 + G * t, (len(p.mass), 1)), atol=1e-13)
    np.testing.assert_allclose(p.position, p.origin + V0 * t + 0.5 * G * t * t, atol=1e-13)
    np.testing.assert_allclose(p.acceleration, np.tile(G, (len(p.mass), 1)), atol=1e-12)
    assert np.abs(p.stress).max() < 1e-11


@UPDATES
@pytest.mark.parametrize(
    "damping", [{"particle": 3.0}, {"grid": 3.0}, {"grid": 1.0, "particle": 2.0}]
)
def test_damping_brakes_by_its_share_and_books_what_it_takes(update, damping):
    """v falls by the factor 1 - 3 dt in each step; x moves by the mean of both velocities."""
    model, state, scratch = build_deck(STONE, solver={"update": update, "damping": damping})
    p, m = state.particles, state.particles.mass
    before = 0.5 * m @ np.sum(p.velocity**2, axis=1)
    advance(model, state, scratch, 10)
    v = V0 * (1.0 - 3.0 * model.dt) ** np.arange(11)[:, None]
    way = 0.5 * model.dt * (v[1:] + v[:-1]).sum(axis=0)
    np.testing.assert_allclose(p.velocity, np.tile(v[-1], (len(m), 1)), rtol=1e-12)
    np.testing.assert_allclose(p.position, p.origin + way, atol=1e-14)
    taken = before - 0.5 * m @ np.sum(p.velocity**2, axis=1)
    assert state.books.damping[0] == pytest.approx(taken, rel=1e-12)


def test_formulas():
    """V = 1, u = 3, a = 10, dt = 0.1, damping 2 (grid) and 0.5 (particle).

    vm is the grid velocity at the start of the step for FLIP and XPIC: 3 - 10 * 0.1 = 2.
    """
    V, u, a = (1.0, 0.0), (3.0, 0.0), (10.0, 0.0)

    def x(update):
        return [pair[0] for pair in moved(update, V, u, a, 2.0, 0.5, 0.1)]

    flip = 1.0 + (10.0 - 2.0 * 2.0 - 0.5 * 1.0) * 0.1
    assert x(Flip(1)) == pytest.approx([flip, 2.0 + 0.5 * (flip - 1.0)], rel=1e-15)
    pic = 3.0 - (2.0 * 3.0 + 0.5 * 1.0) * 0.1
    assert x(Fmpm(1)) == pytest.approx([pic, 0.5 * (1.0 + pic)], rel=1e-15)
    assert x(Xpic(1)) == pytest.approx([pic, 2.0 + 0.5 * (pic - 1.0)], rel=1e-15)


@pytest.mark.parametrize("kind", [Fmpm, Xpic])
@pytest.mark.parametrize("order", [1, 2, 3, 6])
def test_orders_are_the_series_of_what_a_round_trip_loses(kind, order):
    """v(k) = sum_l (1 - S+ S)^l v_L with S+ = M^-1 S^T m (Nairn and Hammerquist 2021), as matrices.

    FMPM starts from v_L = p+/m; XPIC from p+/m - a dt, with a dt added in the end. Velocities and
    forces are random.
    """
    model, state, scratch = build_deck(STONE)
    chance = np.random.default_rng(5)
    p = state.particles
    p.velocity[:] = chance.normal(size=p.velocity.shape)
    locate(model, state, scratch)
    sum_mass_and_momentum(model, state, scratch)
    meet_rows(model.conditions, scratch, state, model.lattice.width)
    grid, S = scratch.grid, _dense(model, scratch)
    grid.force[:] = grid.mass[:, None] * chance.normal(size=grid.force.shape)
    find_acceleration(grid, len(grid.mass), model.strides)
    start = grid.momentum / np.where(grid.mass > 0.0, grid.mass, np.inf)[:, None]
    kick = model.dt * grid.acceleration if kind is Xpic else 0.0
    from_particles = (S * p.mass[:, None]).T / np.where(grid.mass > 0.0, grid.mass, np.inf)[:, None]
    term, total = start - kick, 0.0
    for _ in range(order):
        total, term = total + term, term - from_particles @ (S @ term)
    find_update_velocity(replace(model, update=kind(order)), state, scratch)
    np.testing.assert_allclose(grid.velocity, total + kick, atol=1e-13)


def _dense(model, scratch):
    """Return the weights as a matrix, particles times rows."""
    shape, stencil = model.blocks[0].shape, scratch.stencil
    steps = np.array(offsets(model.strides, shape))
    S = np.zeros((len(stencil.base), len(scratch.grid.mass)))
    for p, base in enumerate(stencil.base):
        S[p, base + steps] = weights(place_of(shape, model.strides, stencil, p), shape)
    return S
