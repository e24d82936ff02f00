"""From a deck to a model and the state at time zero: the only place that knows both."""

from math import hypot, sqrt

import numpy as np

from cramp_cli.build.cohesion import build_cohesion, stiffness_rate
from cramp_cli.build.conditions import build_conditions
from cramp_cli.build.contact import build_body_contact, build_crack_laws, build_groups
from cramp_cli.build.covered import crack_line
from cramp_cli.build.events import EventList
from cramp_cli.build.growth import build_propagation
from cramp_cli.build.junctions import join
from cramp_cli.build.laws import law_of
from cramp_cli.build.rest import damping_of, rest_of
from cramp_cli.build.seeds import Seeds, are_sized, seed_bodies
from cramp_cli.contact.adhesion import no_bonds
from cramp_cli.cracks.tips import Fracture
from cramp_cli.deck.deck import Deck, DeckError
from cramp_cli.materials.geometry import Axisymmetric, PlaneStrain, PlaneStress, depth
from cramp_cli.materials.law import confined_modulus, memory
from cramp_cli.shapes.bspline2 import QuadraticSpline
from cramp_cli.shapes.bspline3 import CubicSpline
from cramp_cli.shapes.cpdi import ConvectedDomain
from cramp_cli.shapes.linear import Linear
from cramp_cli.shapes.ring import Ring
from cramp_cli.shapes.shape import is_ring
from cramp_cli.shapes.sized import Sized
from cramp_cli.shapes.ugimp import UniformGimp
from cramp_cli.state.bands import band_starts, sorted_by_cell
from cramp_cli.state.growth import make_growth
from cramp_cli.state.lattice import Lattice
from cramp_cli.state.model import SCHEMES, Block, Model, State, TipNodes, no_energy
from cramp_cli.state.particles import Particles, particles_at
from cramp_cli.state.paths import EDGE, PLAIN, TIP, Paths, make_paths
from cramp_cli.transfer.update import Flip, Fmpm, Xpic

PLANES = {"plane_strain": PlaneStrain, "plane_stress": PlaneStress}
SHAPES = {
    "linear": Linear,
    "ugimp": UniformGimp,
    "bspline2": QuadraticSpline,
    "bspline3": CubicSpline,
    "cpdi": ConvectedDomain,
}
RAMP = 0.8  # cells of a crack over which a smooth tip fades
# Cells ahead of a smooth tip at which the first particles feel it. With both numbers K of an edge
# crack of ten cells, a/W = 0.5, is right within 0.1 % on average over a cell, and changes least.
FRONT = 0.42
ENDS = {"plain": PLAIN, "junction": PLAIN, "edge": EDGE, "tip": TIP}
RIGID = ""  # stands for the material of rigid bodies
MOST_STEPS = 1e12  # years of computing, long before time stops to move by round-off


def build(deck: Deck) -> tuple[Model, State]:
    """Return the model that a deck describes and its state at time zero.

    Raises DeckError for what can not be: a body without particles, a load on nothing.
    """
    lattice = build_lattice(deck)
    seeds = seed_bodies(deck, lattice)
    geometry, settings = build_geometry(deck), deck.fracture
    blocks, particles, half, reach = _fill(deck, lattice, geometry, seeds)
    paths = _paths(deck, lattice)
    solid = (lattice, geometry, particles, half, blocks, paths)
    events = EventList(deck)
    conditions, obstacles = build_conditions(deck, events, *solid)
    between = build_body_contact(deck, events, particles, lattice.width)
    model = Model(
        lattice=lattice,
        geometry=geometry,
        blocks=blocks,
        update=_update(deck.solver),
        calm_tips=deck.solver.update_name == "flip",
        scheme=SCHEMES[deck.solver.strain],
        damping=damping_of(deck.solver),
        rest=rest_of(deck),
        dt=time_step(deck),
        end_time=deck.solver.end_time,
        crack_names=tuple(crack.name for crack in deck.cracks),
        contact=build_crack_laws(deck),
        conditions=conditions,
        groups=build_groups(deck),
        between_bodies=between,
        half=half if are_sized(seeds) else None,
        reach=reach if are_sized(seeds) else None,
        leaving=deck.solver.leaving,
        tip_nodes=TipNodes(FRONT, RAMP) if deck.solver.tips == "smooth" else None,
        fracture=Fracture(
            methods=settings.methods,
            radii=settings.radius or (),
            cells=settings.contour.cells,
            terms=settings.contour.terms,
            obstacles=obstacles,
            means=settings.means,
        ),
        cohesion=build_cohesion(deck, paths),
        events=tuple(events.events),
        propagation=build_propagation(deck, blocks, geometry),
    )
    reactions = np.zeros((conditions.boundary_count, len(lattice.cells)))
    bands = [b.lo + band_starts(lattice, particles.position[b.lo : b.hi]) for b in blocks]
    return model, State(
        time=0.0,
        step=0,
        particles=particles,
        paths=paths,
        books=no_energy(),
        reactions=reactions,
        contact_forces=np.zeros((len(between.names) if between else 0, len(lattice.cells))),
        bands=np.array(bands),
        growth=make_growth(paths),
        bonds=no_bonds(),
        events=np.full(len(events.events), np.inf),
        drag=np.array(model.damping),
    )


def build_geometry(deck: Deck):
    """Return what the direction across the plane does."""
    if deck.analysis == "axisymmetric":
        return Axisymmetric()
    return PLANES[deck.analysis](deck.thickness)


def build_shape(deck: Deck, lattice: Lattice, half, *, sized: bool):
    """Return the shape function of particles with half sizes `half` (cells).

    sized: some particles are smaller or larger than that
    """
    shape = SHAPES[deck.solver.shape](half)
    if sized and isinstance(shape, UniformGimp | ConvectedDomain):
        shape = Sized(shape, half)
    if deck.analysis != "axisymmetric":
        return shape
    return Ring(shape, half, round(-lattice.lower[0] / lattice.width), lattice.nodes[0])


def build_lattice(deck: Deck) -> Lattice:
    """Return the background grid."""
    box = deck.lattice_box()
    return Lattice(tuple(box.cells), deck.grid.cell, tuple(float(x) for x in box.lower))


def time_step(deck: Deck) -> float:
    """Return the time step (s): that of the fastest wave and the stiffest faces, or the deck's."""
    used = {body.material for body in deck.bodies if body.material}
    fastest = max(wave_speed(deck.materials[name]) for name in used)
    step = deck.solver.cfl / hypot(fastest / deck.grid.cell, sqrt(stiffness_rate(deck)))
    step = min(step, deck.solver.dt or step)
    if deck.solver.end_time / step > MOST_STEPS:
        key = "cfl" if deck.solver.dt is None else "dt"
        message = f"needs {deck.solver.end_time / step:.3g} time steps; no run comes to their end"
        raise DeckError([deck.mistake(("solver", key), message)])
    return step


def wave_speed(material) -> float:
    """Return the dilational wave speed (m/s), that of the solid also in plane stress."""
    return float(np.sqrt(confined_modulus(law_of(material)) / material.density))


def _fill(
    deck: Deck, lattice: Lattice, geometry, seeds
) -> tuple[tuple, Particles, np.ndarray, np.ndarray]:
    """Return blocks of one material and particle size, and their particles sorted by cell.

    returns: and half size and reach of all particles (n, 2), as in Seeds
    """
    kinds = sorted({(b.material or RIGID, b.particles_per_cell) for b in deck.bodies if not b.hole})
    blocks, parts, start = [], [], 0
    for material, per_cell in kinds:
        bodies = [
            n
            for n, b in enumerate(deck.bodies)
            if not b.hole and (b.material or RIGID, b.particles_per_cell) == (material, per_cell)
        ]
        mine = Seeds(*map(np.concatenate, zip(*(seeds[n] for n in bodies), strict=True)))
        owner = np.concatenate([np.full(len(seeds[n].share), n) for n in bodies])
        by_place = np.lexsort(mine.position.T)
        order = by_place[sorted_by_cell(lattice, mine.position[by_place])]
        points, share, half, reach = (column[order] for column in mine)
        law, density = None, 0.0  # of a rigid body
        if material != RIGID:
            law, density = law_of(deck.materials[material]), deck.materials[material].density
        shape = build_shape(deck, lattice, (0.5 / per_cell,) * 2, sized=are_sized(seeds))
        blocks.append(Block(start, start + len(points), law, shape, material, density))
        volume = (lattice.width / per_cell) ** 2 * depth(geometry, points[:, 0]) * share
        parts.append((points, owner[order], density * volume, volume, half, reach))
        start += len(points)
    *columns, half, reach = (np.concatenate(column) for column in zip(*parts, strict=True))
    rings, columns_of_laws = is_ring(blocks[0].shape), max(memory(b.law) for b in blocks if b.law)
    particles = particles_at(*columns, memory=columns_of_laws, rings=rings)
    for number, body in enumerate(deck.bodies):
        _set_moving(particles, number, body)
    return tuple(blocks), particles, half, reach


def _set_moving(particles: Particles, number: int, body) -> None:
    """Give the particles of a body their initial velocity."""
    mine = particles.body == number
    if body.hole or body.rigid or not mine.any():
        return
    centre = particles.mass[mine] @ particles.position[mine] / particles.mass[mine].sum()
    arm = particles.position[mine] - centre
    spin = body.angular_velocity * np.stack([-arm[:, 1], arm[:, 0]], axis=1)
    particles.velocity[mine] = np.asarray(body.velocity) + spin


def _update(solver):
    kinds = {"flip": Flip, "pic": Fmpm, "fmpm": Fmpm, "xpic": Xpic}
    return kinds[solver.update_name](max(solver.update_order, 1))


def _paths(deck: Deck, lattice: Lattice) -> Paths:
    lines = [crack_line(deck, crack) for crack in deck.cracks]
    lines, joint = join(lines, deck.cracks, build_groups(deck).of_crack, lattice.width)
    return make_paths(
        lines,
        ends=[(ENDS[crack.start], ENDS[crack.end]) for crack in deck.cracks],
        fixed=[crack.motion == "fixed" for crack in deck.cracks],
        mirror=[(-1, 0)] * len(lines),
        dim=len(lattice.cells),
        joint=joint,
    )
