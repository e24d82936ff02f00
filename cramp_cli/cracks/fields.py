"""Cracks in a step: the rows of particles near them, and their motion; arrays grow if need be."""

import numpy as np

from cramp_cli.cracks.advect import move_cracks
from cramp_cli.cracks.contact import GLUED, sum_displacement
from cramp_cli.cracks.crossing import list_segments, make_segments
from cramp_cli.cracks.rows import (
    assign_rows,
    clear_shared,
    find_particles_near_cracks,
    forget_rows,
)
from cramp_cli.cracks.tip_nodes import EXTENSION, cut_along_cracks, mark_tip_nodes
from cramp_cli.shapes.shape import offsets, support
from cramp_cli.state.grid import make_grid
from cramp_cli.state.model import Scratch
from cramp_cli.state.stencil import make_lists, make_stencil


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
    while not _rows_fit(scratch, state, model):
        pass


def _rows_fit(scratch, state, model) -> bool:
    """Try once; make room for what did not fit and return False."""
    lattice, strides, shape = model.lattice, model.strides, model.blocks[0].shape
    stencil, rows, segments, tips = scratch.stencil, scratch.rows, scratch.segments, model.tip_nodes
    grid = (lattice.cells, lattice.width, lattice.lower, strides)
    blended = tips is not None
    growth = 2 if blended else 1
    smooth = smooth_cracks(model)
    beyond = EXTENSION * lattice.width * smooth
    zone = 2 * support(shape) + growth - 1
    if not list_segments(segments, state.paths, *grid, growth, zone, beyond):
        wanted = 2 * int(segments.used[2])
        scratch.segments = make_segments(lattice.node_count, len(segments.crack), wanted)
        return False
    listed = find_particles_near_cracks(stencil, segments, strides, len(stencil.entries))
    if listed > len(stencil.entries):
        per_particle = stencil.which.shape[1] // 2
        scratch.stencil = stencil._replace(
            **make_lists(per_particle, len(strides), listed + listed // 4)
        )
        return False
    forget_rows(rows)
    if blended:
        mark_tip_nodes(rows, state.paths, segments, smooth, *grid)
    place = (strides, lattice.nodes, lattice.width, lattice.lower)
    ramp = (tips.centre, tips.ramp) if blended else (0.0, 1.0)
    position, paths = state.particles.position, state.paths
    assign_rows(stencil, rows, segments, paths, position, shape, *place, *ramp)
    if rows.count[0] > len(rows.node):
        scratch.grid, scratch.rows = make_grid(
            lattice.node_count, len(strides), 2 * int(rows.count[0])
        )
        return False
    return True


def smooth_cracks(model):
    """Return for each crack whether its tips are smooth; a glued crack is no crack."""
    return (model.tip_nodes is not None) & (model.contact.kind != GLUED)


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
        lattice, paths, tips = model.lattice, state.paths, model.tip_nodes
        cut = np.ones(len(paths.point))
        if tips is not None:
            cut = cut_along_cracks(paths, smooth_cracks(model), lattice.width, *tips)
        move_cracks(
            paths,
            cut,
            scratch.grid,
            scratch.rows,
            scratch.segments,
            lattice.cells,
            lattice.width,
            lattice.lower,
            model.strides,
            model.dt,
        )
