"""Cracks in a step: the rows of particles near them, and their motion. Arrays grow when they must."""

import numpy as np

from cramp_cli.cracks.advect import move_cracks
from cramp_cli.cracks.contact import sum_displacement
from cramp_cli.cracks.crossing import list_segments, make_segments
from cramp_cli.cracks.rows import (
    assign_rows,
    clear_shared,
    find_particles_near_cracks,
    forget_rows,
)
from cramp_cli.shapes.shape import offsets, support
from cramp_cli.state.grid import make_grid
from cramp_cli.state.model import Scratch
from cramp_cli.state.stencil import make_stencil


def make_scratch(model, state) -> Scratch:
    """Return scratch arrays large enough for the cracks as they are."""
    lattice, n = model.lattice, len(state.particles.mass)
    dim = len(lattice.cells)
    segment_count = max(len(state.paths.point) - state.paths.crack_count, 1)
    per_particle = len(offsets(model.strides, model.blocks[0].shape))
    listed = min(n, 40 * segment_count + 64)
    grid, rows = make_grid(lattice.node_count, dim, 16 * segment_count + 64)
    return Scratch(
        grid=grid,
        rows=rows,
        stencil=make_stencil(n, dim, per_particle, listed),
        segments=make_segments(lattice.node_count, segment_count, 24 * segment_count + 64),
    )


def find_rows(model, state, scratch) -> None:
    """Find the rows of all particles near cracks."""
    if not state.paths.crack_count:
        return
    lattice, strides, shape = model.lattice, model.strides, model.blocks[0].shape
    while not _rows_fit(scratch, state, lattice, strides, shape):
        pass


def _rows_fit(scratch, state, lattice, strides, shape) -> bool:
    """Try once; make room for what did not fit and return False."""
    stencil, rows, segments, dim = scratch.stencil, scratch.rows, scratch.segments, len(strides)
    fits = list_segments(
        segments,
        state.paths,
        lattice.cells,
        lattice.width,
        lattice.lower,
        strides,
        2 * support(shape),
    )
    if not fits:
        wanted = 2 * int(segments.used[2])
        scratch.segments = make_segments(lattice.node_count, len(segments.crack), wanted)
        return False
    listed = find_particles_near_cracks(stencil, segments, strides, len(stencil.table))
    if listed > len(stencil.table):
        table = np.zeros((listed + listed // 4, stencil.table.shape[1]), dtype=np.int64)
        scratch.stencil = stencil._replace(table=table)
        return False
    forget_rows(rows)
    position = state.particles.position
    assign_rows(
        stencil,
        rows,
        segments,
        position,
        shape,
        strides,
        lattice.nodes,
        lattice.width,
        lattice.lower,
    )
    if rows.count[0] > len(rows.node):
        extra = 2 * int(rows.count[0])
        scratch.grid, scratch.rows = make_grid(lattice.node_count, dim, extra)
        return False
    return True


def find_openings(model, state, scratch) -> None:
    """Extrapolate displacements and places to nodes with several rows."""
    if not scratch.rows.count[1]:
        return
    clear_shared(scratch.rows)
    for block in model.blocks:
        sum_displacement(
            scratch.rows,
            state.particles,
            scratch.stencil,
            block.shape,
            model.strides,
            block.lo,
            block.hi,
        )


def move_paths(model, state, scratch) -> None:
    """Move all cracks with the solid."""
    if state.paths.crack_count:
        lattice = model.lattice
        move_cracks(
            state.paths,
            scratch.grid,
            scratch.rows,
            scratch.segments,
            lattice.cells,
            lattice.width,
            lattice.lower,
            model.strides,
            model.dt,
        )
