"""Cracks in a step: the rows of particles near them, and their motion; arrays grow if need be."""

import numpy as np

from cramp_cli.cracks.advect import move_cracks
from cramp_cli.cracks.assign import assign_rows, list_particles_near_cracks
from cramp_cli.cracks.contact import GLUED, LAST, UPDATE, touch
from cramp_cli.cracks.contact_books import note_parting
from cramp_cli.cracks.followers import follow, list_followers
from cramp_cli.cracks.meetings import forget_groups, list_meeting_particles, mark_groups
from cramp_cli.cracks.openings import clear_openings, sum_openings
from cramp_cli.cracks.rows import forget_rows
from cramp_cli.cracks.sectors import pair_sectors
from cramp_cli.cracks.segments import list_segments, make_segments
from cramp_cli.cracks.tip_nodes import EXTENSION, cut_along_cracks, mark_tip_nodes
from cramp_cli.cracks.tip_shares import see_image, sum_sides
from cramp_cli.shapes.shape import support
from cramp_cli.state.grid import make_grid
from cramp_cli.state.model import TipNodes
from cramp_cli.state.stencil import make_lists


def list_cracks(model, state, scratch) -> None:
    """List the segments of all cracks by cell, and mark the cells near them."""
    if not state.paths.crack_count:
        return
    lattice = model.lattice
    growth = 1 if model.tip_nodes is None else 2
    zone = growth + support(model.blocks[0].shape)  # who is listed sees nodes that others see
    grid = (lattice.cells, lattice.width, lattice.lower, model.strides)
    while not list_segments(scratch.segments, state.paths, *grid, growth, zone, scratch.beyond):
        wanted = 2 * int(scratch.segments.used[2])
        scratch.segments = make_segments(lattice.node_count, len(scratch.segments.crack), wanted)


def find_rows(model, state, scratch) -> None:
    """Find the rows of all particles near cracks and meetings; all must have been located."""
    if model.between_bodies is not None:
        _find_meetings(model, state, scratch)
    elif not state.paths.crack_count:
        return
    while not _rows_fit(scratch, state, model):
        pass
    if model.tip_nodes is not None:
        lattice, cracks = model.lattice, (state.paths, state.growth.running, model.groups.of_crack)
        place = (lattice.width, lattice.lower, model.strides)
        list_followers(scratch.followers, scratch.rows, *cracks, *place)


def _find_meetings(model, state, scratch) -> None:
    """Mark the nodes that several contact groups see, and the particles there."""
    rows, stencil, of_body = scratch.rows, scratch.stencil, model.groups.of_body
    forget_groups(rows, of_body)
    for b in model.blocks:
        who = (state.particles.body, of_body, b.shape)
        mark_groups(rows, stencil, *who, model.strides, b.lo, b.hi)
    for b, bands, report in zip(model.blocks, state.bands, scratch.report, strict=True):
        list_meeting_particles(rows, stencil, bands, report, b.shape, model.strides)


def _rows_fit(scratch, state, model) -> bool:
    """Try once; make room for what did not fit and return False."""
    lattice, strides, stencil, rows = model.lattice, model.strides, scratch.stencil, scratch.rows
    listed = list_particles_near_cracks(stencil, state.bands, scratch.report, len(stencil.entries))
    if listed > len(stencil.entries):
        per_particle = stencil.which.shape[1] // 2
        scratch.stencil = stencil._replace(
            **make_lists(per_particle, len(strides), listed + listed // 4)
        )
        return False
    forget_rows(rows)
    if model.tip_nodes is not None:
        _look_around_tips(model, state, scratch)
    _assign_rows(model, state, scratch)
    if rows.count[0] > len(rows.node):
        scratch.grid, larger = make_grid(lattice.node_count, len(strides), 2 * int(rows.count[0]))
        scratch.rows = larger._replace(lowest=rows.lowest, highest=rows.highest)
        return False
    pair_sectors(rows, scratch.segments, lattice.width, lattice.lower, strides)
    return True


def _assign_rows(model, state, scratch) -> None:
    """List the rows of all particles that have been listed."""
    lattice, stencil, line = model.lattice, scratch.stencil, 0
    who = (stencil, scratch.rows, scratch.segments, state.paths, state.particles, model.groups)
    place = (model.strides, model.nodes, lattice.width, lattice.lower)
    tips = model.tip_nodes or TipNodes(0.0, 1.0)  # of sharp tips, which no node asks for
    for block, part in _parts_of_list(model, stencil):
        line = assign_rows(*who, part, line, block.shape, place, tips)
    stencil.count[0] = line


def _parts_of_list(model, stencil) -> list:
    """Return every block with the first of its listed particles and the one after its last."""
    listed = stencil.listed[: stencil.count[0]]
    return [(b, tuple(np.searchsorted(listed, (b.lo, b.hi)).tolist())) for b in model.blocks]


def _look_around_tips(model, state, scratch) -> None:
    """Find the nodes beside every tip, and what they see on both sides of its crack."""
    lattice, rows = model.lattice, scratch.rows
    grid = (lattice.cells, lattice.width, lattice.lower, model.strides)
    mark_tip_nodes(rows, state.paths, scratch.segments, scratch.beyond > 0.0, *grid)
    scratch.at_tips[:] = np.inf, 0.0
    who = (scratch.stencil, state.paths, state.particles, model.groups)
    place = (model.strides, lattice.width)
    for block, part in _parts_of_list(model, scratch.stencil):
        sum_sides(rows, scratch.at_tips, *who, part, block.shape, place, model.tip_nodes)
    for m in (plane.mirror for plane in model.conditions.mirrors):
        if m.crack >= 0:
            see_image(rows, m.crack, m.on, m.outside, m.inside)


def smooth_cracks(model) -> np.ndarray:
    """Return for each crack whether its tips are smooth; a glued crack is no crack."""
    return (model.tip_nodes is not None) & (model.contact.kind != GLUED)


def beyond_tips(model) -> np.ndarray:
    """Return how far the tips of each crack are carried on (cracks,), m."""
    return EXTENSION * model.lattice.width * smooth_cracks(model)


def follow_behind_tips(model, scratch, field) -> None:
    """Let the nodes ahead of smooth tips open as those behind do; field: momentum or force."""
    if scratch.followers.count[0]:
        follow(field, scratch.grid.mass, scratch.followers, model.strides)


def find_openings(model, state, scratch) -> None:
    """Sum what openings are made of in the rows of nodes with several rows."""
    if not scratch.rows.count[1]:
        return
    clear_openings(scratch.rows)
    who = (scratch.rows, state.particles, scratch.stencil)
    for b in model.blocks:
        sum_openings(*who, b.shape, model.strides, b.lo, b.hi)


def note_faces(model, scratch, field, what) -> None:
    """Keep how fast the sides of cracks part, or are pushed, before `follow_behind_tips`."""
    if scratch.rows.count[1]:
        note_parting(scratch.grid, scratch.rows, model.strides, field, what)


def touch_faces(model, state, scratch, stage) -> None:
    """Let the faces of cracks touch in a pass of contact; book what it takes."""
    if not scratch.rows.count[1]:
        return
    book_at = LAST if model.scheme.again else UPDATE
    how = (model.contact, scratch.share, model.strides, model.dt, stage, book_at)
    friction, impact = touch(scratch.grid, scratch.rows, *how)
    state.books.friction[0] += friction
    state.books.impact[0] += impact


def cut_of_points(model, paths, at_tips) -> np.ndarray:
    """Return the share of the crack at each point (points,): below 1 beside smooth tips.

    at_tips: of Scratch
    """
    cut = np.ones(len(paths.point))
    if model.tip_nodes is not None:
        smooth = smooth_cracks(model)
        cut_along_cracks(cut, paths, smooth, at_tips, model.lattice.width, *model.tip_nodes)
    return cut


def move_paths(model, state, scratch) -> None:
    """Move all cracks with the solid."""
    paths = state.paths
    cut, where = cut_of_points(model, paths, scratch.at_tips), what_surfaces_see(model, scratch)
    move_cracks(scratch.seen[0], paths, cut, scratch.grid, *where, model.dt)


def what_surfaces_see(model, scratch) -> tuple:
    """Return `solid` and `place` of `look_from` (view.py)."""
    lattice, solid = model.lattice, (scratch.rows, scratch.segments, model.groups.of_crack)
    return solid, (lattice.cells, lattice.width, lattice.lower, model.strides)
