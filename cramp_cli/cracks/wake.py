"""What a passing tip leaves in the particles beside its faces, and no node feels, is taken out.

The two particles of a cell do not part at the same place of the tip; what one is strained more than
the other stays when the tip has gone, with alternating sign along the faces, so that no force at a
node undoes it. In the wake of a running tip the deformation gradient is brought to the linear
function of place that fits it best around a particle, on its side of the crack.
"""

import numpy as np

from cramp_cli.cracks.cloud import started_around
from cramp_cli.cracks.sinks import note_taken
from cramp_cli.cracks.tip_nodes import FAR, along_crack
from cramp_cli.numerics.kernel import kernel
from cramp_cli.state.growth import running_tips
from cramp_cli.transfer.to_particles import strain_one

BEGIN, END = 2, 4
BESIDE = 2.0  # cells from the crack within which it is
AROUND = 1.1
RATE = 2.0
OFTEN = 0.1  # cells on the way of which a wake is smoothed once


def smooth_wakes(model, state, scratch) -> None:
    """Take the roughness of strain out of the wakes of tips that have run on a little."""
    growth, width = state.growth, model.lattice.width
    for tip in running_tips(growth):
        way = float(growth.length[tip] - growth.smoothed[tip]) / width
        if way >= OFTEN:
            growth.smoothed[tip] = growth.length[tip]
            _smooth(model, state, scratch, tip, way)


def _smooth(model, state, scratch, tip, way) -> None:
    paths, width, particles = state.paths, model.lattice.width, state.particles
    growth = state.growth
    first, last = int(paths.start[tip // 2]), int(paths.start[tip // 2 + 1]) - 1
    at = last if tip % 2 else first
    reach = (END + AROUND) * width + BESIDE * width
    chosen = started_around(model, state, scratch, paths.origin[at], reach)
    X, F = particles.origin[chosen], particles.F[chosen]
    ahead, across = np.zeros(len(chosen)), np.zeros(len(chosen))
    _from_tip(ahead, across, paths.origin, first, last, at, X, FAR * width)
    zone = (ahead < -BEGIN * width) & (ahead > -END * width) & (np.abs(across) < BESIDE * width)
    rough = np.flatnonzero(zone)
    if not len(rough):
        return
    block = np.searchsorted([b.hi for b in model.blocks], chosen, side="right")
    away = X[None, :] - X[rough][:, None]
    near = np.sum(away**2, axis=2) < (AROUND * width) ** 2
    near &= (across[None, :] > 0.0) == (across[rough][:, None] > 0.0)
    near &= block[None, :] == block[rough][:, None]
    A = np.concatenate([np.ones_like(away[:, :, :1]), away / width], axis=2)
    W = near[:, :, None] * A
    M = np.einsum("ijk,ijl->ikl", W, A) + 1e-9 * np.eye(A.shape[2])
    fit = np.linalg.solve(M, np.einsum("ijk,jc->ikc", W, F))[:, 0]
    change = (fit - F[rough]) * (1.0 - np.exp(-RATE * way))
    dim = X.shape[1]
    Fr = F[rough].reshape(-1, dim, dim)
    dU = np.einsum("nij,njk->nik", change.reshape(-1, dim, dim), np.linalg.inv(Fr))
    dU = dU.reshape(len(rough), -1)
    L, before = particles.L, particles.work[chosen[rough]]
    for number, b in enumerate(model.blocks):
        mine = np.flatnonzero(block[rough] == number)
        if len(mine) and b.law is not None:
            p = chosen[rough[mine]]
            rate = L[p].copy()
            L[p] = 0.0
            L[p, : dim * dim] = dU[mine] / model.dt
            _strain_chosen(particles, p, b.law, model.geometry, model.strides, model.dt)
            L[p] = rate
    taken = (before - particles.work[chosen[rough]]) * particles.volume[chosen[rough]]
    if state.paths.mirror[tip // 2, 0] >= 0:
        taken *= 2.0
    away = np.hypot(*(X[rough] - paths.origin[at]).T)
    note_taken(growth, tip, away, taken, width)


@kernel
def _from_tip(ahead, across, point, first, last, tip, place, far):
    """Set where places lie from a tip: ahead along the crack, and left of it (m)."""
    for i in range(len(place)):
        x, y = place[i, 0], place[i, 1]
        ahead[i], away, segment, _, _ = along_crack(point, first, last, tip, x, y, far)
        k = first + segment
        dx, dy = point[k + 1, 0] - point[k, 0], point[k + 1, 1] - point[k, 1]
        side = dx * (y - point[k, 1]) - dy * (x - point[k, 0])
        across[i] = away if side > 0.0 else -away


@kernel
def _strain_chosen(particles, chosen, law, geometry, strides, dt):
    for i in range(len(chosen)):
        strain_one(particles, chosen[i], law, geometry, strides, dt)
