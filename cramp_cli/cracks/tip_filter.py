"""What no node sees is taken from the particles around a running tip, and booked once.

FLIP keeps velocities that no node sees, and a tip makes them: they are filtered around it. The
other updates filter everywhere; what they take there has flowed into the tip, and J counts it
(docs/theory/growth.md).
"""

from typing import NamedTuple

import numpy as np

from cramp_cli.cracks.cloud import started_around
from cramp_cli.cracks.fields import follow_behind_tips
from cramp_cli.cracks.sinks import note_taken
from cramp_cli.numerics.kernel import kernel
from cramp_cli.shapes.shape import offsets, place_of, weights
from cramp_cli.state.growth import running_tips
from cramp_cli.transfer.rows import row_and_weight, rows_seen
from cramp_cli.transfer.sums import damping_now

CORE, SKIN = 3.0, 1.0  # cells around a tip that are its own, and in which that fades
SEEN = 3.0  # cells beyond that whose particles share nodes with those filtered


def calm_running_tips(model, state, scratch, reflect) -> None:
    """Take from the particles around running tips the velocities that nodes do not see.

    Only FLIP keeps such velocities at all; the other updates filter them everywhere.
    With P what a round trip to the grid makes of velocities, (1 - P) W (1 - P) v is taken, W the
    weight of a place: the filter of second order of Hammerquist and Nairn (2017), near a tip only.
    Momentum stays to round-off, energy can only fall.

    reflect: gives sums in rows to the images behind symmetry planes (boundary/conditions.py)
    """
    width = model.lattice.width
    for tip in running_tips(state.growth) if model.calm_tips else ():
        place = _place_of(state.paths, tip)
        chosen = started_around(model, state, scratch, place, (CORE + SKIN + SEEN) * width)
        rough = state.particles.velocity[chosen]
        rough -= _round_trip(model, state, scratch, reflect, chosen, rough)
        away = np.hypot(*(state.particles.origin[chosen] - place).T)
        rough *= _own_share(away, width)[:, None]
        V, m = state.particles.velocity[chosen], state.particles.mass[chosen]
        new = V - rough + _round_trip(model, state, scratch, reflect, chosen, rough)
        state.particles.velocity[chosen] = new
        state.particles.acceleration[chosen] += (new - V) / model.dt
        taken = 0.5 * m * np.sum((V - new) * (V + new), axis=1)
        note_taken(state.growth, tip, away, _whole(model, state, tip) * taken, width)


class NearTips(NamedTuple):
    """Particles around running tips, before they move."""

    chosen: np.ndarray  # (m,) their numbers
    weight: np.ndarray  # (m,) 1 beside a tip, 0 where its own ends
    velocity: np.ndarray  # (m, dim) m/s
    tips: tuple  # (tip, numbers among the chosen, distances (m), weights) of each tip


def note_near_tips(model, state, scratch) -> NearTips | None:
    """Return the particles whose update filters what flows into a running tip; None if none does.

    FLIP filters nothing; what `calm_running_tips` takes in its place is booked nowhere.
    """
    tips = running_tips(state.growth)
    if model.calm_tips or not tips:
        return None
    weight, width = np.zeros(len(state.particles.mass)), model.lattice.width
    owners = []
    for tip in tips:
        place = _place_of(state.paths, tip)
        chosen = started_around(model, state, scratch, place, (CORE + SKIN) * width)
        away = np.hypot(*(state.particles.origin[chosen] - place).T)
        own = _own_share(away, width)
        weight[chosen] = np.maximum(weight[chosen], own)
        owners.append((tip, chosen[own > 0.0], away[own > 0.0], own[own > 0.0]))
    chosen = np.flatnonzero(weight)
    owners = [(tip, np.searchsorted(chosen, c), away, own) for tip, c, away, own in owners]
    return NearTips(chosen, weight[chosen], state.particles.velocity[chosen], tuple(owners))


def leave_to_tips(model, state, near) -> None:
    """Take off the books of damping what the update has filtered beside running tips.

    The flow J into the domain of a tip holds it: booked as damping too, it would count twice.
    """
    if near is None:
        return
    particles, (grid, particle), dt = state.particles, damping_now(model, state), model.dt
    V, new = near.velocity, particles.velocity[near.chosen]
    filtered = (new + particle * dt * V) / (1.0 - grid * dt)  # without the damping of the deck
    free = V + dt * particles.acceleration[near.chosen]
    taken = 0.5 * particles.mass[near.chosen] * np.sum((free - filtered) * (V + filtered), axis=1)
    state.books.damping[0] -= float(near.weight @ taken)
    particles.acceleration[near.chosen] += near.weight[:, None] * (filtered - free) / dt
    for tip, mine, away, own in near.tips:
        energy = _whole(model, state, tip) * own * taken[mine]
        note_taken(state.growth, tip, away, energy, model.lattice.width)


def _whole(model, state, tip) -> float:
    """Return 2 for a crack on a symmetry plane, whose other half is an image, else 1."""
    return 2.0 if state.paths.mirror[tip // 2, 0] >= 0 else 1.0


def _place_of(paths, tip) -> np.ndarray:
    """Return where a tip was in the undeformed body (m); tip: 2 * crack + end."""
    return paths.origin[paths.start[tip // 2 + tip % 2] - tip % 2]


def _own_share(away, width) -> np.ndarray:
    """Return how far particles belong to a tip: 1 within CORE cells, 0 beyond CORE + SKIN."""
    return np.clip(CORE + SKIN - away / width, 0.0, SKIN) / SKIN


def _round_trip(model, state, scratch, reflect, chosen, field) -> np.ndarray:
    """Return what the grid makes of a field (m, dim) of chosen particles (m,).

    The mass of the rows is that of all particles: what lies further away counts as at rest.
    """
    stencil, mass, out = scratch.stencil, scratch.grid.mass, np.empty_like(field)
    sums = np.zeros((scratch.row_count, len(model.strides)))
    parts = [(b, *np.searchsorted(chosen, (b.lo, b.hi))) for b in model.blocks]
    for b, lo, hi in parts:
        own = state.particles.mass[chosen[lo:hi]]
        _to_rows(sums, stencil, own, chosen[lo:hi], field[lo:hi], b.shape, model.strides)
    reflect(model.conditions, scratch, sums)
    follow_behind_tips(model, scratch, sums)
    for b, lo, hi in parts:
        _from_rows(out[lo:hi], sums, mass, stencil, chosen[lo:hi], b.shape, model.strides)
    return out


@kernel
def _to_rows(sums, stencil, mass, chosen, field, shape, strides):
    """Add the momentum of chosen particles, of that mass (m,), to their rows."""
    dim, steps = len(strides), offsets(strides, shape)
    for i in range(len(chosen)):
        p = chosen[i]
        S = weights(place_of(shape, strides, stencil, p), shape)
        for e in range(rows_seen(stencil, p, steps)):
            row, w = row_and_weight(stencil, p, e, steps, S)
            for d in range(dim):
                sums[row, d] += w * mass[i] * field[i, d]


@kernel
def _from_rows(out, sums, mass, stencil, chosen, shape, strides):
    """Set the field of chosen particles from the momenta and masses of their rows."""
    dim, steps = len(strides), offsets(strides, shape)
    for i in range(len(chosen)):
        p = chosen[i]
        S = weights(place_of(shape, strides, stencil, p), shape)
        out[i, :] = 0.0
        for e in range(rows_seen(stencil, p, steps)):
            row, w = row_and_weight(stencil, p, e, steps, S)
            if mass[row] > 0.0:
                for d in range(dim):
                    out[i, d] += w * sums[row, d] / mass[row]
