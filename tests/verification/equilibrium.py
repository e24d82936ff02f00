"""The plate at rest in one solve: what the rows of a model hold in static equilibrium.

A run with damping ends there after thousands of steps. The grid's own rows, shares and followers
are taken from the model; only the equations of motion are replaced by K u = f. Small strains,
uniform GIMP, plane strain, one elastic law, cracks without contact.
"""

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import spsolve
from support import build_deck, locate

from cramp_cli.transfer.sums import sum_mass_and_momentum

E, NU = 200e9, 0.3  # Pa
LAME, SHEAR = E * NU / ((1.0 + NU) * (1.0 - 2.0 * NU)), 0.5 * E / (1.0 + NU)
# stress xx, xy, yx, yy of the displacement gradient u_x,x u_x,y u_y,x u_y,y
HOOKE = np.array([
    [LAME + 2.0 * SHEAR, 0.0, 0.0, LAME],
    [0.0, SHEAR, SHEAR, 0.0],
    [0.0, SHEAR, SHEAR, 0.0],
    [LAME, 0.0, 0.0, LAME + 2.0 * SHEAR],
])  # fmt: skip
GAUSS = np.polynomial.legendre.leggauss(4)


def plate(half_sizes, line, ends, cell=1e-3):
    """Return model, state and scratch of a rectangle about the origin with one crack.

    half_sizes: whole numbers of cells; line: points (cells); ends: words of the deck
    """
    size = np.array(half_sizes) * cell
    shape = {"type": "rectangle", "lower": (-size).tolist(), "upper": size.tolist()}
    points = (np.asarray(line) * cell).tolist()
    crack = {"name": "c", "points": points, "start": ends[0], "end": ends[1]}
    deck = {
        "cramp": 1,
        "analysis": "plane_strain",
        "grid": {
            "cell": cell,
            "lower": (-size - 2.0 * cell).tolist(),
            "upper": (size + 2.0 * cell).tolist(),
        },
        "materials": {"steel": {"law": "elastic", "density": 7800.0, "E": E, "nu": NU}},
        "bodies": [{"name": "plate", "material": "steel", "shape": shape}],
        "cracks": [crack | {"contact": {"law": "ignore"}}],
        "fracture": {"methods": ["domain"]},
        "solver": {"end_time": 1.0},
    }
    model, state, scratch = build_deck(deck)
    locate(model, state, scratch)
    sum_mass_and_momentum(model, state, scratch)
    return model, state, scratch


def load_border(model, state, scratch, stress):
    """Return the forces (rows, 2) of the tractions of a stress field on the sides of the rectangle.

    stress: of places (n, 2) on the surface of particles at (n, 2), in m, gives (n, 2, 2) Pa
    """
    force = np.zeros((scratch.row_count, 2))
    place, half = state.particles.origin, model.lattice.width * model.blocks[0].shape.half[0]
    for axis in range(2):
        for sign in (-1.0, 1.0):
            border = np.max(sign * place[:, axis]) + half
            at = np.flatnonzero(np.abs(sign * place[:, axis] + half - border) < 1e-3 * half)
            for xi, weight in zip(*GAUSS, strict=True):
                x = place[at].copy()
                x[:, axis] = sign * border
                x[:, 1 - axis] += xi * half
                pull = sign * weight * half * stress(x, place[at])[:, :, axis]
                _pull(force, model, scratch, at, x, axis, pull)
    return force


def _pull(force, model, scratch, at, x, axis, pull):
    """Give forces (n, 2) at places x on the lines of nodes across `axis` to rows of particles."""
    lattice, strides, along = model.lattice, model.strides, 1 - axis
    cells = (x - lattice.lower) / lattice.width
    across, first = np.rint(cells[:, axis]).astype(int), np.floor(cells[:, along]).astype(int)
    for step in range(2):
        node = across * strides[axis] + (first + step) * strides[along]
        share = 1.0 - np.abs(cells[:, along] - first - step)
        for p, n, f in zip(at.tolist(), node.tolist(), share[:, None] * pull, strict=True):
            for row, part in _rows_of(scratch, strides, p, n):
                force[row] += part * f


def _rows_of(scratch, strides, p, node):
    """Return the rows of particle p at a node, with their shares."""
    stencil, line = scratch.stencil, scratch.stencil.near[p]
    if line < 0:
        return [(node, 1.0)]
    dy, dx = divmod(node - int(stencil.base[p]), strides[1])
    entries = range(stencil.entries[line])
    mine = [e for e in entries if stencil.which[line, e] == dx + 3 * dy]
    return [(stencil.table[line, e], stencil.share[line, e]) for e in mine]


def rest(model, state, scratch, force):
    """Bring the particles to rest under forces (rows, 2) in equilibrium; return u of the rows."""
    weight, dx, dy = _operators(model, state, scratch)
    ties = _ties(scratch)
    gradient = sp.bmat([[dx, None], [dy, None], [None, dx], [None, dy]]) @ sp.block_diag([ties] * 2)
    hooke = sp.kron(sp.csr_matrix(HOOKE), sp.diags(state.particles.volume))
    stiffness = (gradient.T @ hooke @ gradient).tocsc()
    loads = np.concatenate([ties.T @ force[:, 0], ties.T @ force[:, 1]])
    free = np.setdiff1d(np.arange(len(loads)), _held(scratch, ties, model.strides[1]))
    q = np.zeros(len(loads))
    q[free] = spsolve(stiffness[free][:, free], loads[free], permc_spec="MMD_AT_PLUS_A")
    _strain(state.particles, (gradient @ q).reshape(4, -1).T)
    u = np.stack([ties @ half for half in np.split(q, 2)], axis=1)
    state.particles.position[:] = state.particles.origin + weight @ u
    return u


def _strain(particles, gradient):
    """Give the particles a displacement gradient (n, 4) and its stress."""
    stress = gradient @ HOOKE
    particles.F[:] = np.array([1.0, 0.0, 0.0, 1.0]) + gradient
    particles.stress[:, :2] = stress[:, [0, 3]]
    particles.stress[:, 2] = LAME * (gradient[:, 0] + gradient[:, 3])
    particles.stress[:, 3] = stress[:, 1]
    particles.work[:] = 0.5 * np.sum(gradient * stress, axis=1)


def _held(scratch, ties, along):
    """Return three unknowns that, at rest, hold the plate without a force."""
    heavy = np.flatnonzero(scratch.grid.mass[: len(scratch.rows.first)] > 0.0)
    lowest = heavy[heavy // along == heavy[0] // along]
    column = [int(ties[row].indices[0]) for row in (lowest[0], lowest[-1])]
    return [column[0], ties.shape[1] + column[0], ties.shape[1] + column[1]]


def _operators(model, state, scratch):
    """Return S and its derivatives (1/m) as matrices (particles, rows), from shares and bends."""
    stencil, n, strides = scratch.stencil, len(state.particles.mass), model.strides
    half = model.blocks[0].shape.half[0]
    (sx, gx), (sy, gy) = (_gimp(stencil.local[:, d], half) for d in range(2))
    tables = [
        (b[:, :, None] * a[:, None, :]).reshape(n, 9) for a, b in ((sx, sy), (gx, sy), (sx, gy))
    ]
    steps = np.add.outer(np.arange(3) * strides[1], np.arange(3) * strides[0]).ravel()
    far = np.flatnonzero(stencil.near < 0)
    p, row = np.repeat(far, 9), (stencil.base[far][:, None] + steps).ravel()
    values = [table[far].ravel() for table in tables]
    lines = np.repeat(np.arange(stencil.count[0]), stencil.entries[: stencil.count[0]])
    entry = np.concatenate([np.arange(k) for k in stencil.entries[: stencil.count[0]]])
    near, which = stencil.listed[lines], stencil.which[lines, entry]
    share, bend = stencil.share[lines, entry], stencil.bend[lines, entry]
    S, Gx, Gy = (table[near, which] for table in tables)
    listed = [share * S, share * Gx + bend[:, 0] * S, share * Gy + bend[:, 1] * S]
    at = np.concatenate([p, near]), np.concatenate([row, stencil.table[lines, entry]])
    scale = (1.0, 1.0 / model.lattice.width, 1.0 / model.lattice.width)
    return [
        sp.csr_matrix((k * np.concatenate([a, b]), at), shape=(n, scratch.row_count))
        for k, a, b in zip(scale, values, listed, strict=True)
    ]


def _gimp(r, half):
    """Return values and slopes (per cell) at three nodes (Bardenhagen and Kober 2004)."""
    within, beyond = np.minimum(1.0 + half - r, 2.0 * half), np.maximum(0.0, r - 1.0 + half)
    first, last = within / (2.0 * half), beyond / (2.0 * half)
    S = 0.5 * within * first + (1.0 + half - r - within), 0.5 * beyond * last
    values = np.stack([S[0], 1.0 - S[0] - S[1], S[1]], axis=1)
    return values, np.stack([-first, first - last, last], axis=1)


def _ties(scratch):
    """Return the matrix (rows, unknowns) that gives the rows their motion, followers their jump."""
    mass, followers = scratch.grid.mass[: scratch.row_count], scratch.followers
    ties, led = sp.identity(len(mass), format="lil"), []
    for f in range(followers.count[0]):
        a, b = followers.follower[f].tolist()  # the mean of both stays where that of a was
        if min(mass[a], mass[b]) <= 0.0:
            continue
        ties[b, b], ties[b, a] = 0.0, 1.0
        led.append(b)
        for lead, weight in zip(followers.lead[f], followers.weight[f], strict=True):
            if weight > 0.0:
                _follow(ties, (a, b), followers.row[lead].tolist(), weight, mass)
    kept = np.setdiff1d(np.flatnonzero(mass > 0.0), led)
    return ties.tocsr()[:, kept]


def _follow(ties, pair, lead, weight, mass):
    """Let a pair of rows part by a share of the jump of a lead."""
    (a, b), (c, d) = pair, lead
    up, down = mass[b] / (mass[a] + mass[b]), mass[a] / (mass[a] + mass[b])
    ties[a, d] -= weight * up
    ties[a, c] += weight * up
    ties[b, d] += weight * down
    ties[b, c] -= weight * down
