"""Boundary conditions and loads of a deck, as lists of nodes and particles."""

import numpy as np

from cramp_cli.boundary.absorbing import Absorber
from cramp_cli.boundary.beyond import Beyond
from cramp_cli.boundary.conditions import (
    Conditions,
    Gravity,
    MirrorPlane,
    ParticleForce,
    Traction,
)
from cramp_cli.boundary.grip import Hold, Travel
from cramp_cli.boundary.symmetry import Mirror
from cramp_cli.boundary.velocity import Held
from cramp_cli.build.faces import Surface, impedances, span
from cramp_cli.cracks.room import Obstacle
from cramp_cli.deck.deck import DeckError
from cramp_cli.deck.events import boundary_names
from cramp_cli.deck.where import AXES
from cramp_cli.materials.geometry import depth
from cramp_cli.shapes.shape import is_ring, reaches_beyond

ON_PLANE = 1e-6  # cells
TOUCHES_AXIS = 2.0  # cells from the axis within which a particle may see its nodes
REACH = 1.5  # cells beside a region in which a node may hold particles of it


def build_conditions(deck, events, *solid) -> tuple[Conditions, tuple]:
    """Return all conditions, and what spoils a J domain.

    events: EventList that grows by what the conditions wait for
    solid: lattice, geometry, particles, their half sizes (n, 2) in cells, blocks, paths
    """
    builder = _Builder(deck, events, *solid)
    for number, boundary in enumerate(deck.boundary):
        builder.add_boundary(number, boundary)
    for number, load in enumerate(deck.loads):
        {
            "force": builder.add_force,
            "traction": builder.add_traction,
            "gravity": builder.add_gravity,
        }[load.type](number, load)
    builder.add_axis()
    if builder.mistakes:
        raise DeckError(builder.mistakes)
    conditions = Conditions(
        names=tuple(builder.names),
        holds=tuple(builder.holds),
        mirrors=tuple(builder.mirrors),
        forces=tuple(builder.forces),
        tractions=tuple(builder.tractions),
        absorbers=tuple(builder.absorbers),
        gravity=tuple(builder.gravity),
    )
    return conditions, tuple(builder.obstacles)


class _Builder:
    """Collects conditions and mistakes."""

    def __init__(self, deck, events, lattice, geometry, particles, half, blocks, paths):
        self.deck, self.events, self.lattice, self.geometry = deck, events, lattice, geometry
        self.particles, self.blocks, self.paths = particles, blocks, paths
        self.nodes = lattice.node_positions()
        self.tolerance = ON_PLANE * lattice.width
        self.names, self.holds, self.mirrors = [], [], []
        self.surface = Surface(deck, lattice, geometry, particles, blocks, half)
        self.forces, self.tractions, self.absorbers, self.gravity = [], [], [], []
        self.obstacles, self.mistakes = [], []

    def wrong(self, path, message):
        """Note a mistake at a place of the deck."""
        self.mistakes.append(self.deck.mistake(path, message))

    def add_boundary(self, number, boundary):
        """Add a fixed or moving plane, or a symmetry plane."""
        self.names.append(boundary_names(self.deck)[number])
        if boundary.symmetry:
            self._add_mirror(number, boundary)
        elif boundary.absorbing:
            self._add_absorbers(number, boundary)
        else:
            self._add_holds(number, boundary)

    def _add_holds(self, number, boundary):
        where, width = boundary.where, self.lattice.width
        lower = np.array([span(where, d, self.tolerance)[0] for d in range(2)])
        upper = np.array([span(where, d, self.tolerance)[1] for d in range(2)])
        planes = {axis for axis, _ in where.planes}
        wide = np.array([0.0 if d in planes else REACH * width for d in range(2)])
        near = np.all((self.nodes >= lower - wide) & (self.nodes <= upper + wide), axis=1)
        node = np.flatnonzero(near)
        inside = np.all((self.nodes[node] >= lower) & (self.nodes[node] <= upper), axis=1)
        if not inside.any():
            self.wrong(("boundary", number, "where"), "holds no grid node")
        free = np.array([d in planes for d in range(2)])
        region = (np.where(free, -np.inf, lower), np.where(free, np.inf, upper))
        signal = self.events.signal(boundary, f"boundary {self.names[number]}")
        travel = self._travel(boundary)
        for axis, speed in boundary.components:
            held = Held(node, inside.astype(np.int64), axis, *region)
            beyond = self._beyond(where, node[inside], axis)
            self.holds.append(Hold(held, float(speed), signal, number, beyond, travel))
        self._spoil(self.nodes[node[inside]], "a held boundary")

    def _travel(self, boundary) -> Travel | None:
        """Return how a plane moves along its normal, or None if it stays where it is."""
        planes, lattice = boundary.where.planes, self.lattice
        normal = planes[0][0]
        speed = dict(boundary.components).get(normal, 0.0)
        if len(planes) != 1 or speed == 0.0:
            return None
        line, outside = self._line(*planes[0]), -self._body_side(*planes[0])
        after = lattice.nodes[normal] - 1 - line
        return Travel(speed, lattice.width, lattice.strides[normal], line, after, outside)

    def _line(self, axis, at) -> int:
        """Return the number of the line of nodes on a plane."""
        return round((at - self.lattice.lower[axis]) / self.lattice.width)

    def _beyond(self, where, on, component) -> Beyond | None:
        """Return the nodes beyond a held plane that particles of the body see, or None.

        on: (n,) nodes of the plane; a plane through the body, or a held region, has none
        """
        if len(where.planes) != 1 or not reaches_beyond(self.blocks[0].shape):
            return None
        axis, at = where.planes[0]
        lattice, side = self.lattice, self._body_side(axis, at)
        line = self._line(axis, at)
        step = side * lattice.strides[axis]
        inner = side and 1 <= line < lattice.cells[axis]
        return Beyond(component, on - step, on + step) if inner else None

    def _add_mirror(self, number, boundary):
        axis, at = boundary.where.planes[0]
        lattice, side = self.lattice, self._body_side(axis, at)
        if not side:
            message = "must not pass through a body: the other half is the body's image"
            self.wrong(("boundary", number, "where"), message)
            return
        if not 1 <= self._line(axis, at) < lattice.cells[axis]:
            message = (
                "needs a row of cells on either side of a symmetry plane; make the grid larger"
            )
            self.wrong(("boundary", number, "where"), message)
            return
        other = 1 - axis
        low, high = span(boundary.where, other, self.tolerance)
        plane = np.flatnonzero(np.abs(self.nodes[:, axis] - at) <= self.tolerance)
        on = plane[(self.nodes[plane, other] >= low) & (self.nodes[plane, other] <= high)]
        step = side * lattice.strides[axis]
        crack = self._crack_on_plane(number, axis, at, side)
        mirror = Mirror(axis, on, self.nodes[on], on - step, on + step, crack)
        self.mirrors.append(MirrorPlane(mirror, number))
        self._not_moved(number, axis, on)
        self._spoil(self.nodes[on], "a symmetry plane", crack)
        self._spoil(self.nodes[np.setdiff1d(plane, on)], "the end of a symmetry plane")

    def _add_absorbers(self, number, boundary):
        """Put dashpots on all faces of bodies that lie on the plane."""
        path, (axis, at) = ("boundary", number, "where"), boundary.where.planes[0]
        candidates = self.surface.all_particles(boundary.where)
        faces = list(self.surface.faces_of(self.surface.solids, boundary.where))
        if not faces and not len(candidates):
            self.wrong(path, "no face of a particle lies there")
        elif not faces or not _one_sided(faces):
            self.wrong(path, "lies inside a body; give its face")
        for block, pieces in faces:
            along, across = impedances(block, self.geometry)
            if np.isnan(along):
                what = f"the waves of '{block.material}' have no speed of their own"
                self.wrong(path, f"{what}; give the face a rim of an isotropic elastic material")
            impedance = np.full(2, across)
            impedance[axis] = along
            corners = self.surface.corners(block, pieces, axis, at, impedance)
            self.absorbers.append(Absorber(corners, block.shape, number))
        self._spoil(self.particles.origin[candidates], "an absorbing boundary")

    def add_axis(self):
        """Make the axis of rings a symmetry plane; a body that stays away from it needs none."""
        width, first = self.lattice.width, -self.lattice.lower[0]
        on_axis = self.particles.position[:, 0].min() < TOUCHES_AXIS * width
        if not is_ring(self.blocks[0].shape) or not on_axis:
            return
        if abs(first / width - round(first / width)) > ON_PLANE or first < (1 - ON_PLANE) * width:
            message = "must have a line at x = 0, the axis, and a row of cells beyond it"
            self.wrong(("grid", "lower") if self.deck.grid.lower else ("grid",), message)
            return
        on = np.flatnonzero(np.abs(self.nodes[:, 0]) <= self.tolerance)
        mirror = Mirror(0, on, self.nodes[on], on - 1, on + 1, -1)
        self.mirrors.append(MirrorPlane(mirror, len(self.names)))
        self._spoil(self.nodes[on], "the axis")

    def _not_moved(self, number, axis, on):
        """Refuse a boundary on a symmetry plane that moves it along its normal."""
        for other, boundary in enumerate(self.deck.boundary):
            flat = boundary.where.planes == self.deck.boundary[number].where.planes
            if flat and any(d == axis and speed for d, speed in boundary.components):
                shared = boundary.where.contains(self.nodes[on], self.tolerance)
                if shared.any():
                    message = "moves a symmetry plane along its normal; that has no meaning"
                    self.wrong(("boundary", other, "velocity", AXES[axis]), message)

    def _body_side(self, axis, at) -> int:
        """Return +1 or -1 for the side of a plane on which all particles lie, 0 if both."""
        sides = np.sign(self.particles.position[:, axis] - at)
        return int(sides[0]) if np.all(sides == sides[0]) else 0

    def _crack_on_plane(self, number, axis, at, side) -> int:
        """Return the crack that lies on a symmetry plane, or -1, and tell the crack."""
        found = -1
        for c in range(self.paths.crack_count):
            line = self.paths.point[self.paths.crack(c)]
            if np.all(np.abs(line[:, axis] - at) <= self.tolerance):
                if found >= 0:
                    self.wrong(
                        ("boundary", number, "where"), "only one crack may lie on a symmetry plane"
                    )
                found = c
                self._no_contact(c)
                self._no_traction(c)
                along = line[-1, 1 - axis] - line[0, 1 - axis]
                left = np.sign(along) * (1 if axis == 1 else -1)  # above the crack is +axis
                self.paths.mirror[c] = axis, int(side * left)
        return found

    def _no_contact(self, crack):
        """A crack on a symmetry plane has one side only: nothing there could press on it."""
        section = self.deck.cracks[crack]
        law = self.deck.contact_of(section).law
        if law != "ignore":
            path = ("cracks", crack, "contact") if section.contact else ("cracks", crack)
            message = f"'{law}' does not act on a symmetry plane: give contact: {{law: ignore}}"
            self.wrong(path, message)

    def _no_traction(self, crack):
        """The gap of a crack on a symmetry plane, of which one face is an image, is not known."""
        message = "a crack on a symmetry plane can have none: model both halves"
        section, growth = self.deck.cracks[crack], self.deck.propagation
        if section.traction is not None:
            self.wrong(("cracks", crack, "traction"), message)
        grows = growth is not None and section.name in (growth.cracks or (section.name,))
        if grows and growth.traction is not None:
            self.wrong(("propagation", "traction"), message)

    def add_force(self, number, load):
        """Add forces on the particles of a body."""
        chosen, share = self._chosen(load)
        if not len(chosen):
            self.wrong(("loads", number, "where"), f"holds no particle of body {load.body}")
            return
        each = np.array(load.total) / len(chosen) if load.total is not None else np.array(load.each)
        signal = self._signal_of(number, load)
        for block in self.blocks:
            mine = (chosen >= block.lo) & (chosen < block.hi)
            if mine.any():
                force = share[mine, None] * each
                self.forces.append(ParticleForce(chosen[mine], force, block.shape, signal, number))
        self._spoil(self.particles.origin[chosen], "a loaded particle")

    def _chosen(self, load) -> tuple[np.ndarray, np.ndarray]:
        """Return the particles that a force acts on, and what each takes by the mean of all.

        A total is shared as the volume in the region is; `each` acts on all alike.
        """
        if load.total is None:
            chosen = self.surface.particles_of(self._body_of(load), load.where)
            return chosen, np.ones(len(chosen))
        chosen, share = self.surface.shares_of(self._body_of(load), load.where)
        share = share * self.surface.share[chosen]
        if is_ring(self.blocks[0].shape):
            share = share * depth(self.geometry, self.particles.origin[chosen, 0])
        return chosen, share / share.mean() if len(chosen) else share

    def add_traction(self, number, load):
        """Add tractions on the faces of a body that lie on a plane."""
        axis, at = load.where.planes[0]
        candidates = self.surface.particles_of(self._body_of(load), load.where)
        faces = list(self.surface.faces_of([self._body_of(load)], load.where))
        if not faces and not len(candidates):
            message = f"no face of a particle of body {load.body} lies there"
            self.wrong(("loads", number, "where"), message)
        elif not faces or not _one_sided(faces):
            message = f"lies inside body {load.body}; give its face"
            self.wrong(("loads", number, "where"), message)
            return
        signal = self._signal_of(number, load)
        for block, pieces in faces:
            stress = np.array(load.traction) if load.traction is not None else np.zeros(2)
            if load.pressure is not None:
                stress[axis] = -pieces.sign[0] * load.pressure
            corners = self.surface.corners(block, pieces, axis, at, stress)
            self.tractions.append(Traction(corners, block.shape, signal, number))
        self._spoil(self.particles.origin[candidates], "a loaded face")

    def add_gravity(self, number, load):
        """Add an acceleration of everything."""
        signal = self._signal_of(number, load)
        self.gravity.append(Gravity(tuple(float(a) for a in load.acceleration), signal))

    def _signal_of(self, number, load):
        return self.events.signal(load, f"load {load.name or number + 1}")

    def _body_of(self, load) -> int:
        """Return the number of the body that a load acts on."""
        return next(n for n, b in enumerate(self.deck.bodies) if b.name == load.body)

    def _spoil(self, places, what, crack=-1):
        """Note places that no J domain may hold, but that of `crack`."""
        low = self.particles.origin.min(axis=0) - self.lattice.width
        high = self.particles.origin.max(axis=0) + self.lattice.width
        near = np.all((places >= low) & (places <= high), axis=1)
        self.obstacles.append(Obstacle(places[near], what, crack))


def _one_sided(faces) -> bool:
    """Return whether all faces look to the same side."""
    return len({sign for _, pieces in faces for sign in pieces.sign.tolist()}) == 1
