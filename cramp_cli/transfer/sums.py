"""The transfers of a step, block by block (a block = particles of one material and size)."""

import numpy as np

from cramp_cli.state.bands import band_axis, band_starts, share_out, sorted_by_cell
from cramp_cli.state.particles import DELETED, is_deleted
from cramp_cli.transfer import to_grid, to_particles
from cramp_cli.transfer.leaving import let_leave
from cramp_cli.transfer.particle_force import load_times_place


def locate_particles(model, state, scratch) -> None:
    """Find the nodes that every particle sees; `let_leave` those that have left the grid.

    The cracks must have been listed (cracks/fields.py): a particle near one is marked.
    """
    gone, strayed = _locate(model, state, scratch)
    if gone >= 0:
        let_leave(model, state, scratch, gone)
    if strayed or gone >= 0:
        sort_particles(model, state, scratch)
        _locate(model, state, scratch)


def _locate(model, state, scratch) -> tuple[int, bool]:
    """Return a particle that has left the grid or -1, and whether one has strayed from its band."""
    lattice, segments = model.lattice, scratch.segments
    grid = (lattice.lower, model.strides, model.nodes, lattice.width)
    cracks = (segments.head, segments.zone, band_axis(lattice.cells))
    for number, b in enumerate(model.blocks):
        x, F = state.particles.position, state.particles.F
        args = (scratch.stencil, x, F, b.shape, *grid, *cracks, scratch.reports[number])
        scratch.team.run(to_particles.locate, args, scratch.shared[number].shares)
    return to_particles.gone_and_strayed(scratch.report)


def sort_particles(model, state, scratch) -> None:
    """Sort the particles of every block by cell, and share them out anew."""
    particles, lattice = state.particles, model.lattice
    for number, b in enumerate(model.blocks):
        order = sorted_by_cell(lattice, particles.position[b.lo : b.hi])
        deleted = is_deleted(particles)[b.lo : b.hi][order]
        order = np.concatenate([order[~deleted], order[deleted]])
        for array in particles:
            array[b.lo : b.hi] = array[b.lo : b.hi][order]
        end = b.hi - np.count_nonzero(deleted)
        state.bands[number] = b.lo + band_starts(lattice, particles.position[b.lo : end])
    share_particles(state, scratch)


def share_particles(state, scratch) -> None:
    """Share the particles out to the threads as the bands of the state say."""
    scratch.shared = [share_out(starts, scratch.team.size) for starts in state.bands]
    scratch.index = np.argsort(state.particles.id)
    if scratch.half is not None:
        scratch.stencil.half[:] = scratch.half[state.particles.id]
    scratch.index[state.particles.id[is_deleted(state.particles)]] = DELETED


def _scatter(scratch, kernel, number, *args) -> None:
    """Run a kernel that sums on the grid, all even bands of a block first."""
    for parts in scratch.shared[number].colours:
        scratch.team.run(kernel, args, parts)


def _solids(model):
    """Yield number and block of all particles that are not of a rigid body."""
    return ((number, b) for number, b in enumerate(model.blocks) if b.law is not None)


def sum_mass_and_momentum(model, state, scratch) -> None:
    """Sum mass and momentum of all particles in their rows."""
    to_grid.clear_sums(scratch.grid, scratch.row_count)
    particles = (scratch.grid, state.particles, scratch.stencil)
    for number, b in _solids(model):
        _scatter(scratch, to_grid.sum_mass_and_momentum, number, *particles, b.shape, model.strides)


def sum_internal_force(model, state, scratch) -> None:
    """Sum the forces of the stresses."""
    particles = (scratch.grid, state.particles, scratch.stencil)
    for number, b in _solids(model):
        place = (b.shape, model.strides, model.lattice.width)
        _scatter(scratch, to_grid.sum_internal_force, number, *particles, *place)


def strain(model, state, scratch, share) -> None:
    """Strain all particles for a share of the step with the velocities of the grid."""
    particles = (state.particles, scratch.grid, scratch.stencil)
    rest = (model.strides, model.lattice.width, share * model.dt)
    for number, b in _solids(model):
        args = (*particles, b.law, model.geometry, b.shape, *rest)
        scratch.team.run(to_particles.update_stress, args, scratch.shared[number].shares)


def move(model, state, scratch) -> None:
    """Move all particles; book what damping takes and what forces on particles do.

    With a second extrapolation the new momenta are in `grid.saved` afterwards.
    """
    particles, conditions, again = state.particles, model.conditions, model.scheme.again
    before = _loads_times_places(model, scratch, particles)
    weighed = _weighed(particles) if conditions.gravity else 0.0
    if again:
        to_grid.clear(scratch.grid.saved, scratch.row_count)
    for number, b in _solids(model):
        args = (particles, scratch.grid, scratch.stencil, model.update, b.shape, model.strides)
        rest = (damping_now(model, state), model.dt, again, scratch.per_band)
        _scatter(scratch, to_particles.move_particles, number, *args, *rest)
        state.books.damping[0] += float(scratch.per_band.sum())
    after = _loads_times_places(model, scratch, particles)
    for f, a, b in zip(conditions.forces, before, after, strict=True):
        state.books.external[0] += f.signal.load(state) * (b - a)
    if conditions.gravity:
        g = conditions.body_force(state, len(model.strides))
        state.books.external[0] += float((_weighed(particles) - weighed) @ g)


def damping_now(model, state) -> tuple[float, float]:
    """Return the drag on the velocities of grid and particles in a step (1/s)."""
    return tuple(state.drag.tolist()) if model.rest.auto else model.damping


def smooth(model, state, scratch, target, field) -> None:
    """Add to `target` what a round trip to the particles makes of `field`; both (rows, dim)."""
    particles = (state.particles, scratch.stencil)
    for number, b in _solids(model):
        _scatter(scratch, to_grid.smooth, number, target, field, *particles, b.shape, model.strides)


def _loads_times_places(model, scratch, particles) -> list:
    """Return the sum of load times place of each force on particles."""
    x, strides = particles.position, model.strides
    forces = model.conditions.forces
    return [load_times_place(x, f.particles, f.load, scratch.index, strides) for f in forces]


def _weighed(particles) -> np.ndarray:
    """Return the sum of m x (kg m)."""
    return particles.mass @ particles.position
