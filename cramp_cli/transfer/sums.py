"""The transfers of a step, block by block (a block = particles of one material and size)."""

import numpy as np

from cramp_cli.shapes.shape import locate
from cramp_cli.state.failure import NumericalFailure
from cramp_cli.state.health import CAUSES, describe
from cramp_cli.transfer import to_grid, to_particles


def locate_particles(model, state, scratch) -> None:
    """Find the nodes that every particle sees; NumericalFailure when one has left the grid."""
    lattice = model.lattice
    for b in model.blocks:
        grid = (lattice.lower, model.strides, lattice.nodes, lattice.width)
        gone = locate(scratch.stencil, state.particles.position, b.shape, *grid, b.lo, b.hi)
        if gone >= 0:
            raise _failure(model, state, gone)


def _failure(model, state, p: int) -> NumericalFailure:
    """Return what to say of a particle that has no nodes."""
    text = f"step {state.step}, t = {state.time:.6g} s: {describe(model, state, p)}"
    if not np.isfinite(state.particles.position[p]).all():
        return NumericalFailure(f"{text} has a position that is no number.\n{CAUSES}")
    return NumericalFailure(
        f"{text} leaves the grid.\nMake the grid larger (grid.lower, grid.upper or grid.margin), "
        "or look for what throws the body out."
    )


def sum_mass_and_momentum(model, state, scratch) -> None:
    """Sum mass and momentum of all particles in their rows."""
    grid, count = scratch.grid, scratch.row_count
    to_grid.clear(grid.mass, count)
    to_grid.clear(grid.momentum, count)
    for b in model.blocks:
        to_grid.sum_mass_and_momentum(
            grid, state.particles, scratch.stencil, b.shape, model.strides, b.lo, b.hi
        )


def sum_momentum_again(model, state, scratch) -> None:
    """Sum the momentum of the moved particles, with the weights and masses of the step's start."""
    to_grid.clear(scratch.grid.momentum, scratch.row_count)
    for b in model.blocks:
        to_grid.sum_momentum(
            scratch.grid, state.particles, scratch.stencil, b.shape, model.strides, b.lo, b.hi
        )


def sum_internal_force(model, state, scratch) -> None:
    """Sum the forces of the stresses."""
    to_grid.clear(scratch.grid.force, scratch.row_count)
    width = model.lattice.width
    for b in model.blocks:
        to_grid.sum_internal_force(
            scratch.grid,
            state.particles,
            scratch.stencil,
            b.shape,
            model.strides,
            width,
            b.lo,
            b.hi,
        )


def strain(model, state, scratch, share, *, fresh) -> None:
    """Strain all particles for a share of the step with the velocities of the grid."""
    for b in model.blocks:
        to_particles.update_stress(
            state.particles,
            scratch.grid,
            scratch.stencil,
            b.law,
            model.geometry,
            b.shape,
            model.strides,
            model.lattice.width,
            model.dt,
            share,
            fresh,
            b.lo,
            b.hi,
        )


def move(model, state, scratch) -> None:
    """Move all particles; book what damping takes and what forces on particles do."""
    particles, conditions = state.particles, model.conditions
    before = [particles.position[f.particles] for f in conditions.forces]
    weighed = _weighed(particles) if conditions.gravity else 0.0
    for b in model.blocks:
        state.books.damping[0] += to_particles.move_particles(
            particles,
            scratch.grid,
            scratch.stencil,
            model.update,
            b.shape,
            model.strides,
            model.damping,
            model.dt,
            b.lo,
            b.hi,
        )
    for f, x in zip(conditions.forces, before, strict=True):
        way = particles.position[f.particles] - x
        state.books.external[0] += f.curve.value(state.time) * float(np.sum(f.load * way))
    if conditions.gravity:
        g = conditions.body_force(state.time, len(model.strides))
        state.books.external[0] += float((_weighed(particles) - weighed) @ g)


def _weighed(particles) -> np.ndarray:
    """Return the sum of m x (kg m)."""
    return particles.mass @ particles.position
