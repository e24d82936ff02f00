"""Contact between bodies in a step: find pairs, let them touch, move rigid bodies."""

from dataclasses import dataclass, field

import numpy as np

from cramp_cli.contact.adhesion import bonds_of, recall_bonds
from cramp_cli.contact.clouds import Clouds, clear_clouds, link_clouds, make_clouds
from cramp_cli.contact.normals import find_normals, list_windows
from cramp_cli.contact.pairs import Pairs, list_pairs, make_pairs
from cramp_cli.contact.touch import touch_increments, touch_pairs
from cramp_cli.cracks.contact import UPDATE


@dataclass
class Meeting:
    """Scratch paper of the contact between bodies."""

    clouds: Clouds
    pairs: Pairs
    half: np.ndarray  # (n, dim) how far particles reach, each by its number, at the start (m)
    flat: np.ndarray  # (nodes, dim) 1 along the normals of symmetry planes through a node
    rigid: np.ndarray  # (groups,) 1 for rigid bodies
    velocity: np.ndarray = field(default_factory=lambda: np.zeros(0))  # (groups, dim) of these


def find_pairs(model, state, scratch) -> None:
    """Find which rows of different bodies may touch; the rows must have been found."""
    if model.between_bodies is None:
        return
    between, meeting = model.between_bodies, _meeting(model, scratch)
    rows, stencil, clouds = scratch.rows, scratch.stencil, meeting.clouds
    meeting.velocity = between.rigid_velocities(state, len(model.strides))
    state.contact_forces[:] = 0.0
    clear_clouds(clouds, rows)
    for b in model.blocks:
        place = (b.shape, model.strides, b.lo, b.hi)
        link_clouds(clouds, rows, stencil, state.particles.volume, *place)
    found = list_pairs(meeting.pairs, rows, clouds, between.laws, meeting.rigid)
    if found > len(meeting.pairs.node):
        meeting.pairs = make_pairs(2 * int(found), *meeting.flat.shape)
        list_pairs(meeting.pairs, rows, clouds, between.laws, meeting.rigid)
    list_windows(meeting.pairs, model.strides)
    sizes = (meeting.half, between.surface)
    who = (meeting.pairs, clouds, stencil, state.particles, sizes)
    lattice = (model.lattice.lower, model.lattice.width)
    rigid = (meeting.rigid, between.outlines, between.rigid_ways(state.particles))
    how = (between.laws, between.normal, rigid, meeting.flat, lattice, model.strides)
    find_normals(*who, *how)
    if between.adhesive:
        recall_bonds(meeting.pairs, between.laws, state.bonds)


def _meeting(model, scratch) -> Meeting:
    """Return the scratch paper, anew where rows or lists have been made larger."""
    meeting, rows, entries = scratch.meeting, len(scratch.grid.mass), scratch.stencil.table.size
    if meeting is None:
        full = [np.tile(b.shape.half, (b.hi - b.lo, 1)) for b in model.blocks]
        reach = np.concatenate(full) if model.reach is None else model.reach
        meeting = scratch.meeting = Meeting(
            clouds=make_clouds(rows, scratch.stencil),
            pairs=make_pairs(64, model.lattice.node_count, len(model.strides)),
            half=reach * model.lattice.width,
            flat=_flat(model),
            rigid=model.between_bodies.rigid_groups(),
        )
    clouds = meeting.clouds
    if (len(clouds.head), len(clouds.link)) != (rows, entries):
        meeting.clouds = make_clouds(rows, scratch.stencil)
    return meeting


def _flat(model) -> np.ndarray:
    flat = np.zeros((model.lattice.node_count, len(model.strides)), dtype=np.int64)
    for plane in model.conditions.mirrors:
        flat[plane.mirror.on, plane.mirror.axis] = 1
    return flat


def touch_bodies(model, state, scratch, stage) -> None:
    """Let bodies touch in a pass of contact; book friction and the work of rigid ones."""
    if model.between_bodies is None:
        return
    meeting, share = scratch.meeting, scratch.share
    friction, external = touch_pairs(
        scratch.grid,
        meeting.pairs,
        meeting.clouds,
        model.between_bodies.laws,
        (meeting.rigid, meeting.velocity),
        share,
        state.contact_forces,
        model.strides,
        (model.dt, model.lattice.width),
        stage,
    )
    if stage == UPDATE:
        state.books.friction[0] += friction
        state.books.external[0] += external
        if model.between_bodies.adhesive:
            state.bonds = bonds_of(meeting.pairs, model.between_bodies.laws)


def share_increments(model, scratch, increment) -> None:
    """Let higher orders of the grid velocity (rows, dim) keep what contact made equal."""
    if model.between_bodies is not None:
        meeting = scratch.meeting
        touch_increments(increment, scratch.grid, meeting.pairs, meeting.rigid, model.strides)


def move_rigid_bodies(model, state) -> None:
    """Move the particles of rigid bodies with their prescribed velocity."""
    if model.between_bodies is None:
        return
    particles = state.particles
    for one in model.between_bodies.rigid:
        mine = particles.body == one.body
        velocity = one.signal.speed(state) * one.velocity
        particles.velocity[mine] = velocity
        particles.position[mine] += model.dt * velocity
