"""Boundary conditions and loads of a model, applied in the order of the deck."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from cramp_cli.boundary.beyond import follow_force, follow_increment, follow_momentum
from cramp_cli.boundary.grip import Grip, follow_faces
from cramp_cli.boundary.symmetry import (
    Mirror,
    double_on,
    find_open_nodes,
    reflect,
    reflect_even,
    reflect_on,
    stop_normal,
    sum_outside,
)
from cramp_cli.boundary.traction import Faces, add_traction, traction_power
from cramp_cli.boundary.velocity import hold_again, hold_force, hold_momentum, hold_zero
from cramp_cli.state.signal import Signal
from cramp_cli.transfer.on_grid import add_gravity
from cramp_cli.transfer.particle_force import sum_particle_force


@dataclass(frozen=True)
class MirrorPlane:
    """A symmetry plane and the boundary that books its reaction."""

    mirror: Mirror
    boundary: int


@dataclass(frozen=True)
class ParticleForce:
    """Forces on particles of one block: load times signal."""

    particles: np.ndarray  # (n,) their numbers
    load: np.ndarray  # (n, dim) N
    shape: Any
    signal: Signal
    number: int = -1  # of the load in the deck


@dataclass(frozen=True)
class Traction:
    """Tractions on particle faces of one block: load times signal."""

    faces: Faces
    shape: Any
    signal: Signal
    number: int = -1  # of the load in the deck


@dataclass(frozen=True)
class Gravity:
    """A body force per mass: acceleration times signal."""

    acceleration: tuple  # m/s^2
    signal: Signal


@dataclass(frozen=True)
class Conditions:
    """All boundary conditions and loads."""

    names: tuple  # of boundaries, for reactions
    holds: tuple = ()
    mirrors: tuple = ()
    forces: tuple = ()
    tractions: tuple = ()
    absorbers: tuple = ()
    gravity: tuple = ()

    @property
    def boundary_count(self) -> int:
        """Boundaries that book reactions; the axis of rings comes after those with a name."""
        return max([len(self.names), *(plane.boundary + 1 for plane in self.mirrors)])

    def body_force(self, state, dim: int) -> tuple:
        """Return the sum of all gravities (m/s^2)."""
        total = np.zeros(dim)
        for g in self.gravity:
            total += g.signal.load(state) * np.array(g.acceleration)
        return tuple(total.tolist())


def meet_rows(conditions, scratch, state, width) -> None:
    """Find which rows every condition acts on in this step."""
    if scratch.held is None:
        scratch.held = [Grip(hold) for hold in conditions.holds]
        scratch.free = [np.zeros(len(p.mirror.on), dtype=np.bool_) for p in conditions.mirrors]
        scratch.share = np.ones(len(scratch.rows.first))
    scratch.contested = follow_faces(scratch.held, scratch.contested, state)
    for grip in scratch.held:
        grip.find_rows(scratch.rows, scratch.grid.mass)
    for earlier, later in scratch.contested:
        earlier.give_way(later)
    for plane, free in zip(conditions.mirrors, scratch.free, strict=True):
        m, segments = plane.mirror, scratch.segments
        if m.crack >= 0:
            count = segments.used[0]
            find_open_nodes(
                free,
                scratch.rows,
                m.on,
                m.axis,
                m.crack,
                m.place,
                segments.ends,
                segments.down,
                segments.crack,
                count,
                width,
            )
    _share_nodes(conditions, scratch)


def _share_nodes(conditions, scratch) -> None:
    """Tell which part of the sums of a node is the body's own: the rest is its image's."""
    share = scratch.share
    if conditions.mirrors:
        share[:] = 1.0
    for plane, free in zip(conditions.mirrors, scratch.free, strict=True):
        share[plane.mirror.on] *= np.where(free, 1.0, 0.5)
        share[plane.mirror.outside] = 0.0


def reflect_mass_and_momentum(conditions, scratch, state) -> None:
    """Give the sums on both sides of every symmetry plane to each other.

    Behind a held plane that particles reach beyond, the motion goes on oddly from here on.
    """
    grid, rows = scratch.grid, scratch.rows
    for plane, free in zip(conditions.mirrors, scratch.free, strict=True):
        m = plane.mirror
        reflect_even(m, free, rows, grid.mass.reshape(-1, 1))
        if scratch.meeting is not None:  # the area of a joint is that of body and image
            reflect_even(m, free, rows, scratch.meeting.clouds.volume.reshape(-1, 1))
        _reflect(m, free, rows, grid.momentum, add=True)
    for grip in scratch.held:
        if grip.beyond is not None:
            _hold_momentum(grip, scratch, state)


def reflect_sum(conditions, scratch, field) -> None:
    """Give a sum of vectors on both sides of every symmetry plane to each other."""
    for plane, free in zip(conditions.mirrors, scratch.free, strict=True):
        _reflect(plane.mirror, free, scratch.rows, field, add=True)


def repeat_images(conditions, scratch, *fields) -> None:
    """Make the rows outside every symmetry plane images of those inside again."""
    for plane, free in zip(conditions.mirrors, scratch.free, strict=True):
        for field in fields:
            _reflect(plane.mirror, free, scratch.rows, field, add=False)


def reflect_forces(conditions, scratch, state) -> None:
    """Reflect the forces and book the reaction of every symmetry plane.

    What the nodes outside carry pulls on the body and, reflected, on its image: it counts twice.
    """
    force = scratch.grid.force
    for plane, free in zip(conditions.mirrors, scratch.free, strict=True):
        m = plane.mirror
        outside = sum_outside(force, scratch.rows, m.axis, m.crack, m.outside, m.inside, m.on)
        taken = _reflect(m, free, scratch.rows, force, add=True)
        state.reactions[plane.boundary, m.axis] -= taken + 2.0 * outside


def _reflect(m: Mirror, free, rows, field, *, add: bool) -> float:
    reflect(field, rows, m.axis, m.crack, m.outside, m.inside, add)
    reflect_on(field, rows, m.axis, m.crack, m.on, free, add)
    taken = stop_normal(field, rows, m.axis, m.crack, m.on, free)
    if add:
        double_on(field, rows, m.crack, m.on, free)
    return taken


def hold_momenta(conditions, scratch, state) -> None:
    """Impose the prescribed velocities on the momenta."""
    for grip in scratch.held:
        _hold_momentum(grip, scratch, state)


def _hold_momentum(grip, scratch, state) -> None:
    grid, speed = scratch.grid, grip.speed(state)
    hold_momentum(grid.momentum, grid.mass, grip.rows, grip.count, grip.held.axis, speed)
    if grip.beyond is not None:
        follow_momentum(grid.momentum, scratch.rows, grid.mass, grip.beyond, speed)


def hold_forces(conditions, scratch, state, dt) -> None:
    """Impose the prescribed velocities on the forces; book reactions and work."""
    for grip in scratch.held:
        axis, speed = grip.held.axis, grip.speed(state)
        where = (scratch.grid, scratch.rows, scratch.share)
        reaction, work = hold_force(*where, grip.rows, grip.count, axis, speed, dt)
        if grip.beyond is not None:
            more = follow_force(*where, grip.beyond, speed, dt)
            reaction, work = reaction + more, work + more * speed * dt
        state.reactions[grip.hold.boundary, axis] += reaction
        state.books.external[0] += work


def hold_after_contact(conditions, scratch, state, dt) -> None:
    """Impose the velocities once more, on momenta and forces that contact has changed."""
    for grip in scratch.held:
        axis, speed = grip.held.axis, grip.speed(state)
        where = (scratch.grid, scratch.rows, scratch.share, grip.rows, grip.count)
        reaction = hold_again(*where, axis, speed, dt)
        state.reactions[grip.hold.boundary, axis] += reaction
        state.books.external[0] += reaction * speed * dt


def book_tractions(model, scratch, state) -> None:
    """Book the work of tractions over half a step, with the momenta at its start or end.

    With the same velocities as the two strain updates the books close as well as the scheme
    conserves energy.
    """
    for t in model.conditions.tractions:
        places = (scratch.index, t.faces, t.shape, model.strides)
        power = traction_power(scratch.grid, scratch.stencil, *places)
        state.books.external[0] += t.signal.load(state) * power * (0.5 * model.dt)


def hold_increment(conditions, scratch, field) -> None:
    """Keep held components out of higher orders of the grid velocity."""
    for grip in scratch.held:
        hold_zero(field, grip.rows, grip.count, grip.held.axis)
        if grip.beyond is not None:
            follow_increment(field, scratch.rows, scratch.grid.mass, grip.beyond)


def add_loads(model, scratch, state) -> None:
    """Add all loads to the forces of the grid."""
    conditions, strides, grid = model.conditions, model.strides, scratch.grid
    for f in conditions.forces:
        factor = f.signal.load(state)
        loaded = (f.particles, f.load, scratch.index)
        sum_particle_force(grid, *loaded, scratch.stencil, f.shape, strides, factor)
    for t in conditions.tractions:
        places = (scratch.index, t.faces, t.shape, strides)
        add_traction(grid.force, scratch.stencil, *places, t.signal.load(state))
    if conditions.gravity:
        _add_weight(model, scratch, state)


def _add_weight(model, scratch, state) -> None:
    """Add the weight of all bodies.

    Rows beside a symmetry plane hold the mass of the image as well, and forces are reflected yet:
    there each particle gives the weight of its own.
    """
    conditions, strides, grid = model.conditions, model.strides, scratch.grid
    gravity = conditions.body_force(state, len(strides))
    if not conditions.mirrors:
        add_gravity(grid, scratch.row_count, gravity)
        return
    for b in (b for b in model.blocks if b.law is not None):
        own = slice(b.lo, b.hi)
        weight = state.particles.mass[own, None] * np.array(gravity)
        loaded = (state.particles.id[own], weight, scratch.index)
        sum_particle_force(grid, *loaded, scratch.stencil, b.shape, strides, 1.0)
