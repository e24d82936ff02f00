"""The particles around a place of the undeformed body, found without looking at all others.

Integrals around a tip are taken in the undeformed body, where particles never move: their cells of
the start are listed once.
"""

from itertools import product
from typing import NamedTuple

import numpy as np

from cramp_cli.state.particles import DELETED, Particles


class Origins(NamedTuple):
    """Numbers of the particles, by the cells in which they started."""

    first: np.ndarray  # (nodes + 1,) first entry of a cell, by its lowest node
    number: np.ndarray  # (n,)


class Cloud(NamedTuple):
    """Copies of the particles around a place."""

    particles: Particles
    parts: tuple  # (block, first, last + 1) of each material


def list_origins(lattice, particles) -> Origins:
    """Return the particles by the cells in which they started."""
    cell = np.floor((particles.origin - lattice.lower) / lattice.width).astype(np.int64)
    node = cell @ np.array(lattice.strides)
    by_cell = np.argsort(node, kind="stable")
    first = np.searchsorted(node[by_cell], np.arange(lattice.node_count + 1))
    return Origins(first, particles.id[by_cell])


def started_around(model, state, scratch, place, radius: float) -> np.ndarray:
    """Return the particles that started within `radius` of a place (m), and a few more, ascending.

    place: (dim,) in the undeformed body
    """
    lattice, origins, (_, *strides) = model.lattice, scratch.origins, model.strides
    corners = (np.asarray(place) + [[-radius], [radius]] - lattice.lower) / lattice.width
    cells = np.clip(np.floor(corners).astype(int), 0, np.array(lattice.cells) - 1)
    (west, east), *others = cells.T.tolist()
    planes = [
        range(s * low, s * (high + 1), s) for s, (low, high) in zip(strides, others, strict=True)
    ]
    lines = [sum(line) for line in product(*planes)]
    runs = [slice(origins.first[n + west], origins.first[n + east + 1]) for n in lines]
    chosen = np.sort(scratch.index[np.concatenate([origins.number[run] for run in runs])])
    return chosen[chosen != DELETED]


def cloud_around(model, state, scratch, place, radius: float, group: int = 0) -> Cloud:
    """Return copies of the particles that started within `radius` of a place (m), and a few more.

    place: (dim,) in the undeformed body; group: of bodies in contact, others are not seen
    """
    chosen = started_around(model, state, scratch, place, radius)
    if model.between_bodies is not None:
        chosen = chosen[model.groups.of_body[state.particles.body[chosen]] == group]
    edges = [np.searchsorted(chosen, (b.lo, b.hi)).tolist() for b in model.blocks]
    parts = tuple((b, lo, hi) for b, (lo, hi) in zip(model.blocks, edges, strict=True) if lo < hi)
    return Cloud(chosen_from(state.particles, chosen), parts)


def chosen_from(particles, chosen) -> Particles:
    """Return copies of some particles, by their places."""
    return Particles(*(array.take(chosen, axis=0) for array in particles))
