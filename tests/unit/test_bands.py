"""Bands of particles: any number of threads, the same bits; particles keep their numbers."""

import hashlib

import numpy as np
import pytest
from support import advance, build_deck

from cramp_cli.numerics import team
from cramp_cli.scratch import make_scratch
from cramp_cli.state.bands import (
    HEIGHT,
    STRAY,
    band_starts,
    runs_between,
    share_out,
    sorted_by_cell,
)
from cramp_cli.state.lattice import Lattice
from cramp_cli.transfer import sums

# Two halves of two materials meet and turn, with a crack across both and loads on chosen particles;
# they cross bands, so they are sorted on the way.
DECK = """
cramp: 1
analysis: plane_strain
grid: {lower: [-12 mm, -12 mm], upper: [40 mm, 52 mm], cell: 1 mm}
materials:
  soft: {law: elastic, density: 1000, E: 1 GPa, nu: 0.3}
  stiff: {law: elastic, density: 2000, E: 3 GPa, nu: 0.2}
bodies:
  - name: low
    material: soft
    shape: {type: rectangle, lower: [0, 0], upper: [24 mm, 14 mm]}
    velocity: [0, 400]
  - name: high
    material: stiff
    shape: {type: rectangle, lower: [0, 14 mm], upper: [24 mm, 28 mm]}
    velocity: [0, 380]
    angular_velocity: 2000
cracks:
  - {name: slit, points: [[5 mm, 5 mm], [19 mm, 22 mm]], contact: {law: frictional, mu: 0.3}}
loads:
  - {type: force, body: high, where: {x: [0, 3 mm]}, total: [0, 100]}
  - {type: traction, body: low, where: {y: 0}, traction: [0, 1 MPa]}
solver: {end_time: 1}
"""


def test_bands_are_sorted_and_whole():
    lattice = Lattice((20, 45), 0.5, (1.0, -2.0))
    chance = np.random.default_rng(1)
    x = np.array(lattice.lower) + chance.random((500, 2)) * (10.0, 22.5)
    x = x[sorted_by_cell(lattice, x)]
    starts = band_starts(lattice, x)
    assert (starts[0], starts[-1], len(starts)) == (0, 500, 7)
    for band, (lo, hi) in enumerate(zip(starts[:-1], starts[1:], strict=True)):
        row = np.floor((x[lo:hi, 1] + 2.0) / 0.5)
        assert np.all((row >= HEIGHT * band) & (row < HEIGHT * (band + 1)))


def test_runs_hold_all_particles_of_some_rows():
    """Those in a band that may have strayed into the rows as well."""
    starts = np.array([[0, 10, 20, 30, 40], [40, 40, 50, 50, 60]])
    assert runs_between(starts, 0, 5) == [(0, 10), (40, 40)]
    assert runs_between(starts, HEIGHT - STRAY, HEIGHT + STRAY) == [(0, 20), (40, 50)]
    assert runs_between(starts, HEIGHT + STRAY, 2 * HEIGHT - STRAY) == [(10, 20), (40, 50)]
    assert runs_between(starts, -9, 99) == [(0, 40), (40, 60)]


@pytest.mark.parametrize("workers", [1, 2, 3])
def test_every_particle_has_one_thread(workers):
    bands = share_out(np.array([3, 5, 5, 9, 12, 20]), workers)
    for parts in ((p for group in bands.colours for p in group), bands.shares):
        seen = np.concatenate([np.arange(lo, hi) for part in parts for lo, hi, _ in part])
        np.testing.assert_array_equal(np.sort(seen), np.arange(3, 20))


def test_bands_of_a_colour_see_different_nodes():
    """A stray particle reaches three nodes beyond its cell's row, whatever its shape so far."""
    lowest, highest = -STRAY - 1, HEIGHT - 1 + STRAY + 2
    assert highest < 2 * HEIGHT + lowest


def bits(state):
    digest = hashlib.sha256()
    for array in (*state.particles, *state.paths, *state.books, state.bands, state.reactions):
        digest.update(np.ascontiguousarray(array).tobytes())
    return digest.hexdigest()


def test_threads_do_not_change_a_bit(monkeypatch):
    monkeypatch.setattr(team, "LEAST", 1)
    found, sorts = set(), []
    sort = sums.sort_particles
    monkeypatch.setattr(sums, "sort_particles", lambda *all: (sorts.append(1), sort(*all)))
    for threads in (1, 2, 4, 2):
        model, state, _ = build_deck(DECK)
        advance(model, state, make_scratch(model, state, threads), 120)
        found.add(bits(state))
    assert len(found) == 1
    assert len(sorts) >= 4
    assert not np.array_equal(state.particles.id, np.arange(len(state.particles.id)))


def test_sorting_does_not_change_what_happens():
    """A free flight is the same with particles in any order, loads stay on their particles."""
    runs = []
    for shuffled in (False, True):
        model, state, scratch = build_deck(DECK, solver={"end_time": 1})
        for _ in range(30):
            if shuffled:
                sums.sort_particles(model, state, scratch)
            advance(model, state, scratch, 1)
        order = np.argsort(state.particles.id)
        runs.append((state.particles.position[order], state.particles.stress[order]))
    np.testing.assert_allclose(runs[0][0], runs[1][0], atol=1e-12)
    np.testing.assert_allclose(runs[0][1], runs[1][1], atol=1e-6 * np.abs(runs[0][1]).max())
