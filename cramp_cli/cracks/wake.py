"""Strain that a passing tip leaves beside the faces, and no node feels, is taken out.

The two particles of a cell do not part at the same place of the tip; what one is strained more than
the other stays when the tip has gone, with alternating sign along the faces, so that no force at a
node undoes it. In the wake of a running tip the deformation gradient is brought to the linear
function of place that fits it best around a particle, on its side of the crack: what is linear
stays as it is, also at a free face (docs/theory/growth.md).
"""

from typing import NamedTuple

import numpy as np

from cramp_cli.cracks.cloud import started_around
from cramp_cli.cracks.sinks import note_taken
from cramp_cli.cracks.tip_nodes import FAR, along_crack
from cramp_cli.numerics.kernel import kernel
from cramp_cli.state.growth import running_tips
from cramp_cli.transfer.to_particles import strain_one

BEGIN, END = 2.0, 4.0  # cells behind a tip between which its wake is smoothed
BESIDE = 2.0  # cells from the crack up to which it is
AROUND = 1.1  # cells around a particle within which others tell what is smooth
RATE = 2.0  # how often roughness falls by a factor of e on the way of a cell
OFTEN = 0.1  # cells on the way of which a wake is smoothed once
TINY = 1e-9  # keeps the fit of a lonely particle, or of particles on a line, solvable


class Wake(NamedTuple):
    """Particles around a tip (n,), and those of them that lie in its wake."""

    chosen: np.ndarray  # (n,) their numbers
    origin: np.ndarray  # (n, dim) where they started (m)
    across: np.ndarray  # (n,) distance from the crack, to the left of it positive (m)
    block: np.ndarray  # (n,) number of their block
    inside: np.ndarray  # (m,) places among the chosen of those in the wake


def smooth_wakes(model, state, scratch) -> None:
    """Take the roughness of strain out of the wakes of tips that have run on a little."""
    growth, width = state.growth, model.lattice.width
    for tip in running_tips(growth):
        way = float(growth.length[tip] - growth.smoothed[tip]) / width
        if way >= OFTEN:
            growth.smoothed[tip] = growth.length[tip]
            wake = _wake_of(model, state, scratch, tip)
            if len(wake.inside):
                _smooth(model, state, tip, wake, 1.0 - np.exp(-RATE * way))


def _wake_of(model, state, scratch, tip) -> Wake:
    paths, width = state.paths, model.lattice.width
    first, end = (int(n) for n in paths.start[tip // 2 : tip // 2 + 2])
    at = end - 1 if tip % 2 else first
    reach = (END + BESIDE + AROUND) * width
    chosen = started_around(model, state, scratch, paths.origin[at], reach)
    origin = state.particles.origin[chosen]
    ahead, across = np.zeros(len(chosen)), np.zeros(len(chosen))
    _from_tip(ahead, across, paths.origin, first, end - 1, at, origin, FAR * width)
    inside = (-END * width < ahead) & (ahead < -BEGIN * width) & (abs(across) < BESIDE * width)
    block = np.searchsorted([b.hi for b in model.blocks], chosen, side="right")
    return Wake(chosen, origin, across, block, np.flatnonzero(inside))


def _smooth(model, state, tip, wake, share) -> None:
    """Take a share of the roughness, and note the energy that goes with it as flowed to the tip."""
    particles, mine = state.particles, wake.chosen[wake.inside]
    change = share * _roughness(wake, particles.F, model.lattice.width)
    before = particles.work[mine]
    _change_gradient(model, particles, mine, wake.block[wake.inside], change)
    taken = (before - particles.work[mine]) * particles.volume[mine]
    if state.paths.mirror[tip // 2, 0] >= 0:  # the other half is an image
        taken *= 2.0
    place = state.paths.origin[state.paths.start[tip // 2 + tip % 2] - tip % 2]
    away = np.hypot(*(wake.origin[wake.inside] - place).T)
    note_taken(state.growth, tip, away, taken, model.lattice.width)


def _roughness(wake, F, width) -> np.ndarray:
    """Return by what F (m, dim*dim) of the particles in a wake differs from linear functions.

    The best ones around each particle. Differences from its own F are fitted, so that `TINY` draws
    a fit to that, not to zero: a body at rest stays at rest.
    """
    away = (wake.origin[None] - wake.origin[wake.inside, None]) / width
    left = wake.across > 0.0
    near = np.sum(away**2, axis=2) < AROUND**2
    near &= left[None] == left[wake.inside, None]
    near &= wake.block[None] == wake.block[wake.inside, None]
    terms = np.concatenate([np.ones_like(away[:, :, :1]), away], axis=2)
    counted = near[:, :, None] * terms
    matrix = np.einsum("ijk,ijl->ikl", counted, terms) + TINY * np.eye(terms.shape[2])
    apart = F[wake.chosen][None] - F[wake.chosen[wake.inside], None]
    return np.linalg.solve(matrix, np.einsum("ijk,ijc->ikc", counted, apart))[:, 0]


def _change_gradient(model, particles, mine, block, change) -> None:
    """Strain particles (m,) so that F changes (m, dim*dim); their laws say what stress that is."""
    dim, L = len(model.strides), particles.L
    square = (len(mine), dim, dim)
    rate = change.reshape(square) @ np.linalg.inv(particles.F[mine].reshape(square)) / model.dt
    kept = L[mine]
    L[mine] = 0.0
    L[mine, : dim * dim] = rate.reshape(len(mine), dim * dim)
    for number, b in enumerate(model.blocks):
        if b.law is not None and (own := mine[block == number]).size:
            _strain(particles, own, b.law, model.geometry, model.strides, model.dt)
    L[mine] = kept


@kernel
def _from_tip(ahead, across, point, first, last, tip, place, far):
    """Set where places lie from a tip: ahead along the crack, and to the left of it (m)."""
    for i in range(len(place)):
        x, y = place[i, 0], place[i, 1]
        ahead[i], away, segment, _, _ = along_crack(point, first, last, tip, x, y, far)
        a, b = first + segment, first + segment + 1
        dx, dy = point[b, 0] - point[a, 0], point[b, 1] - point[a, 1]
        left = dx * (y - point[a, 1]) - dy * (x - point[a, 0]) > 0.0
        across[i] = away if left else -away


@kernel
def _strain(particles, chosen, law, geometry, strides, dt):
    for i in range(len(chosen)):
        strain_one(particles, chosen[i], law, geometry, strides, dt)
