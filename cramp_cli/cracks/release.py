"""What a running tip releases is taken out of the solid where it is released.

A node that parts lets its forces go within a few steps, and in the discrete body nothing takes the
energy: it would stay in the run as waves as short as a cell. So tractions resist the motion of the
faces just behind a running tip until the next cells have opened (nodal force release of finite
elements: Malluck and King 1980; here in proportion to the momentum that parts the faces), and a
filter takes from the particles around it what the nodes do not see (docs/theory/growth.md).
"""

import numpy as np

from cramp_cli.cracks.cloud import started_around
from cramp_cli.cracks.rows import find_row
from cramp_cli.cracks.tip_nodes import FAR, along_crack
from cramp_cli.numerics.kernel import kernel
from cramp_cli.shapes.shape import offsets, place_of, weights
from cramp_cli.state.growth import running_tips

HELD, FREE = 2.0, 3.0  # cells behind a tip up to where faces are resisted in full, and at all
RESISTED = 0.6  # share of the momentum that parts two faces, taken in a step
CORE, SKIN = 3.0, 1.0  # cells around a tip that are filtered, and in which the filter fades
SEEN = 3.0  # cells beyond that whose particles share nodes with those filtered


def resist_opening(model, state, scratch) -> None:
    """Let closing tractions act on the faces that running tips have just made."""
    lattice, grid = model.lattice, scratch.grid
    place = (lattice.width, lattice.lower, model.strides)
    for tip in running_tips(state.growth):
        free = min(FREE, float(state.growth.length[tip]) / lattice.width)
        group = int(model.groups.of_crack[tip // 2])
        _resist(grid, scratch.rows, state.paths, tip, group, free, *place, model.dt)


@kernel
def _resist(grid, rows, paths, tip, group, free, width, lower, strides, dt):
    """Let both sides of the nodes within `free` cells behind a tip lose relative momentum.

    group: contact group of the bodies that the crack cuts; others may share its nodes
    """
    crack = tip // 2
    first, last = paths.start[crack], paths.start[crack + 1] - 1
    at = first if tip % 2 == 0 else last
    mass = grid.mass
    for i in range(rows.count[4]):
        node = rows.tipped[i]
        if rows.tip[node] != tip:
            continue
        own = find_row(rows, node, group, -1, 0, -1, 0)
        across = find_row(rows, node, group, crack, -rows.tip_side[node], -1, 0)
        if min(own, across) < 0 or mass[own] <= 0.0 or mass[across] <= 0.0:
            continue
        x = lower[0] + node % strides[1] * width
        y = lower[1] + node // strides[1] * width
        ahead = along_crack(paths.point, first, last, at, x, y, FAR * width)[0]
        share = RESISTED * min(max((free + ahead / width) / (FREE - HELD), 0.0), 1.0)
        if share > 0.0:
            _bring_together(grid, own, across, share, len(strides), dt)


@kernel
def _bring_together(grid, a, b, share, dim, dt):
    """Take a share of the momentum that rows a and b have relative to each other."""
    mass, momentum, force = grid.mass, grid.momentum, grid.force
    for d in range(dim):
        parting = (mass[a] * momentum[b, d] - mass[b] * momentum[a, d]) / (mass[a] + mass[b])
        momentum[a, d] += share * parting
        momentum[b, d] -= share * parting
        force[a, d] += share * parting / dt
        force[b, d] -= share * parting / dt


def calm_running_tips(model, state, scratch) -> None:
    """Take from the particles around running tips the velocities that nodes do not see.

    Only FLIP keeps such velocities at all; the other updates filter them everywhere.
    With P what a round trip to the grid makes of velocities, (1 - P) W (1 - P) v is taken, W the
    weight of a place: the filter of second order of Hammerquist and Nairn (2017), near a tip only.
    Momentum stays to round-off, energy can only fall.
    """
    width = model.lattice.width
    for tip in running_tips(state.growth) if model.calm_tips else ():
        end = state.paths.start[tip // 2 + tip % 2] - tip % 2
        place = state.paths.origin[end]
        chosen = started_around(model, state, scratch, place, (CORE + SKIN + SEEN) * width)
        away = np.hypot(*(state.particles.origin[chosen] - place).T) / width
        weight = np.clip(CORE + SKIN - away, 0.0, SKIN) / SKIN
        rough = state.particles.velocity[chosen]
        rough -= _round_trip(model, state, scratch, chosen, rough)
        rough *= weight[:, None]
        state.particles.velocity[chosen] -= rough
        state.particles.velocity[chosen] += _round_trip(model, state, scratch, chosen, rough)


def _round_trip(model, state, scratch, chosen, field) -> np.ndarray:
    """Return what the grid makes of a field (m, dim) of chosen particles (m,)."""
    mass, stencil = state.particles.mass, scratch.stencil
    sums, out = np.zeros((scratch.row_count, len(model.strides) + 1)), np.empty_like(field)
    for b in model.blocks:
        lo, hi = np.searchsorted(chosen, (b.lo, b.hi))
        some = chosen[lo:hi]
        _to_rows(sums, stencil, mass, some, field[lo:hi], b.shape, model.strides)
    for b in model.blocks:
        lo, hi = np.searchsorted(chosen, (b.lo, b.hi))
        some = chosen[lo:hi]
        _from_rows(out[lo:hi], sums, stencil, some, b.shape, model.strides)
    return out


@kernel
def _to_rows(sums, stencil, mass, chosen, field, shape, strides):
    """Add momentum and, in the last column, mass of chosen particles to their rows."""
    dim, steps = len(strides), offsets(strides, shape)
    for i in range(len(chosen)):
        p = chosen[i]
        line, S = stencil.near[p], weights(place_of(shape, strides, stencil, p), shape)
        for e in range(len(steps) if line < 0 else stencil.entries[line]):
            row, w = _entry(stencil, line, e, stencil.base[p], steps, S)
            for d in range(dim):
                sums[row, d] += w * mass[p] * field[i, d]
            sums[row, dim] += w * mass[p]


@kernel
def _from_rows(out, sums, stencil, chosen, shape, strides):
    """Set the field of chosen particles from the sums in their rows."""
    dim, steps = len(strides), offsets(strides, shape)
    for i in range(len(chosen)):
        p = chosen[i]
        line, S = stencil.near[p], weights(place_of(shape, strides, stencil, p), shape)
        out[i, :] = 0.0
        for e in range(len(steps) if line < 0 else stencil.entries[line]):
            row, w = _entry(stencil, line, e, stencil.base[p], steps, S)
            if sums[row, dim] > 0.0:
                for d in range(dim):
                    out[i, d] += w * sums[row, d] / sums[row, dim]


@kernel
def _entry(stencil, line, e, base, steps, S):
    """Return row and weight of an entry of a particle, listed or not."""
    if line < 0:
        return base + steps[e], S[e]
    return stencil.table[line, e], stencil.share[line, e] * S[stencil.which[line, e]]
