"""An absorbing boundary: plane waves that meet it squarely leave the solid (silent boundary).

Lysmer and Kuhlemeyer (1969), J. Eng. Mech. Div. ASCE 95, 859-877: dashpots on the face pull with

    t_n = -rho c_d v_n,    t_t = -rho c_s v_t,

what the solid beyond the face would do to a plane wave that runs straight at it. The wave speeds
are those of the unstrained material; the area of the face is that of the start.

Sums of impedance times area, C (N s/m), stand in the rows like forces. The velocity is that of the
middle of the step, as the stress is, v = (p + theta dt f)/(m + theta dt C) with theta = 1/2; for
rows with little mass theta is larger, 1 - m/(dt C), so that none is turned round by its dashpots.
"""

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from cramp_cli.boundary.symmetry import reflect_even
from cramp_cli.boundary.traction import Faces, add_traction
from cramp_cli.boundary.velocity import own_share
from cramp_cli.numerics.kernel import kernel


@dataclass(frozen=True)
class Absorber:
    """Dashpots on particle faces of one block, and the boundary that books their reaction."""

    faces: Faces  # their `force` is the impedance times the area, N s/m
    shape: Any
    boundary: int


class Dashpots(NamedTuple):
    """Dashpots of a step in the rows; component by component."""

    each: tuple  # of (rows, dim) of every absorbing boundary and block, N s/m
    total: np.ndarray  # (rows, dim) their sum, N s/m
    velocity: np.ndarray  # (rows, dim) against which they pull, m/s


def make_dashpots(before: Dashpots | None, like: np.ndarray, count: int) -> Dashpots:
    """Return room for `count` dashpots in rows like those of `like`, all zero."""
    if before is None or before.total.shape != like.shape:
        empty = tuple(np.zeros_like(like) for _ in range(count))
        return Dashpots(empty, np.zeros_like(like), np.zeros_like(like))
    for field in (*before.each, before.total):
        field[:] = 0.0
    return before


@kernel
def drag(grid, dashpots, count, strides, dt):
    """Add -C v to the forces, v the velocity that rows have within the step."""
    mass, momentum, force = grid.mass, grid.momentum, grid.force
    total, velocity = dashpots.total, dashpots.velocity
    for row in range(count):
        for d in range(len(strides)):
            C = total[row, d]
            if C > 0.0 and mass[row] > 0.0:
                later = max(0.5, 1.0 - mass[row] / (dt * C)) * dt
                v = (momentum[row, d] + later * force[row, d]) / (mass[row] + later * C)
                velocity[row, d] = v
                force[row, d] -= C * v
            else:
                velocity[row, d] = 0.0


@kernel
def add_drag(reaction, impedance, velocity, rows, share, count):
    """Add what dashpots pull at the bodies (N); share: (nodes,) as in velocity.py."""
    for row in range(count):
        own = own_share(rows, share, row)
        for d in range(len(reaction)):
            reaction[d] -= own * impedance[row, d] * velocity[row, d]


@kernel
def drag_power(grid, dashpots, rows, share, count, strides):
    """Return the power that the dashpots take with the momenta of the grid (W)."""
    mass, momentum = grid.mass, grid.momentum
    total, velocity, power = dashpots.total, dashpots.velocity, 0.0
    for row in range(count):
        for d in range(len(strides)):
            if total[row, d] > 0.0 and mass[row] > 0.0:
                pull = own_share(rows, share, row) * total[row, d] * velocity[row, d]
                power += pull * momentum[row, d] / mass[row]
    return power


def absorb_waves(model, scratch, state) -> None:
    """Let the dashpots of absorbing boundaries act against the motion that the forces give."""
    conditions, grid, rows = model.conditions, scratch.grid, scratch.rows
    if not conditions.absorbers:
        return
    dashpots, count = _dashpots(model, scratch), scratch.row_count
    drag(grid, dashpots, count, model.strides, model.dt)
    for absorber, impedance in zip(conditions.absorbers, dashpots.each, strict=True):
        reaction = state.reactions[absorber.boundary]
        add_drag(reaction, impedance, dashpots.velocity, rows, scratch.share, count)
    book_absorbed(model, scratch, state)


def _dashpots(model, scratch) -> Dashpots:
    """Return the dashpots of this step by rows."""
    conditions, rows = model.conditions, scratch.rows
    dashpots = make_dashpots(scratch.dashpots, scratch.grid.force, len(conditions.absorbers))
    for one, impedance in zip(conditions.absorbers, dashpots.each, strict=True):
        places = (scratch.index, one.faces, one.shape, model.strides)
        add_traction(impedance, scratch.stencil, *places, 1.0)
        for plane, free in zip(conditions.mirrors, scratch.free, strict=True):
            reflect_even(plane.mirror, free, rows, impedance)
        dashpots.total[:] += impedance
    scratch.dashpots = dashpots
    return dashpots


def book_absorbed(model, scratch, state) -> None:
    """Book what dashpots take over half a step, as `book_tractions` does what tractions do."""
    if model.conditions.absorbers:
        where = (scratch.rows, scratch.share, scratch.row_count, model.strides)
        power = drag_power(scratch.grid, scratch.dashpots, *where)
        state.books.absorbed[0] += 0.5 * model.dt * power
