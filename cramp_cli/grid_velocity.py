"""The velocity of the grid that particles take: p/m, or the higher orders of FMPM and XPIC.

The order k removes the smoothing of k - 1 round trips between grid and particles (Hammerquist and
Nairn 2017; Nairn and Hammerquist 2021). Prescribed velocities and contact are met by the first
order; the others do not touch them.
"""

import numpy as np

from cramp_cli.boundary.conditions import hold_increment, reflect_sum
from cramp_cli.contact.bodies import share_increments
from cramp_cli.cracks.contact import touch_increment
from cramp_cli.cracks.fields import follow_behind_tips
from cramp_cli.transfer.on_grid import divide_by_mass, find_velocity
from cramp_cli.transfer.sums import smooth
from cramp_cli.transfer.update import Fmpm, Xpic


def find_strain_velocity(model, state, scratch) -> None:
    """Set the grid velocity of a strain update: p/m, of order k with FMPM."""
    find_velocity(scratch.grid, scratch.row_count, model.strides)
    if isinstance(model.update, Fmpm):
        _add_orders(model, state, scratch, scratch.grid.velocity[: scratch.row_count].copy())


def find_update_velocity(model, state, scratch) -> None:
    """Set the grid velocity of the particle update."""
    grid, count = scratch.grid, scratch.row_count
    find_velocity(grid, count, model.strides)
    if isinstance(model.update, Fmpm):
        _add_orders(model, state, scratch, grid.velocity[:count].copy())
    if isinstance(model.update, Xpic):
        before = grid.velocity[:count] - model.dt * grid.acceleration[:count]
        _add_orders(model, state, scratch, before)


def _add_orders(model, state, scratch, increment) -> None:
    """Add the orders 2 to k, starting from the first one in `increment` (rows, dim)."""
    grid = scratch.grid
    for _ in range(1, model.update.order):
        smoothed = np.zeros_like(increment)
        smooth(model, state, scratch, smoothed, increment)
        reflect_sum(model.conditions, scratch, smoothed)
        follow_behind_tips(model, scratch, smoothed)
        divide_by_mass(smoothed, grid.mass, len(smoothed), model.strides)
        increment -= smoothed
        hold_increment(model.conditions, scratch, increment)
        share_increments(model, scratch, increment)
        touch_increment(increment, grid, scratch.rows, model.contact, model.strides)
        grid.velocity[: len(increment)] += increment
