"""A run: what stays (Model), what a checkpoint holds (State), and scratch paper (Scratch)."""

from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from cramp_cli.state.grid import Grid, Rows
from cramp_cli.state.groups import Groups
from cramp_cli.state.growth import Growth
from cramp_cli.state.lattice import Lattice
from cramp_cli.state.particles import Particles
from cramp_cli.state.paths import Paths
from cramp_cli.state.rest import Rest
from cramp_cli.state.stencil import Stencil


class Block(NamedTuple):
    """Particles lo..hi of one material and one size, or of a rigid body."""

    lo: int
    hi: int
    law: Any  # record of the constitutive law; None: rigid, moved by contact/bodies.py
    shape: Any  # record of the shape function with the half size of these particles
    material: str  # name in the deck
    density: float  # kg/m^3


class Scheme(NamedTuple):
    """When strains are updated: shares of the step before the forces and after the motion."""

    before: float  # USF 1, USAVG 1/2, USL 0
    after: float  # USF 0, USAVG 1/2, USL 1
    again: bool  # extrapolate the moved particles a second time ("plus")


SCHEMES = {
    "usf": Scheme(1.0, 0.0, again=False),
    "usl-": Scheme(0.0, 1.0, again=False),
    "usl+": Scheme(0.0, 1.0, again=True),
    "usavg-": Scheme(0.5, 0.5, again=False),
    "usavg+": Scheme(0.5, 0.5, again=True),
}


class TipNodes(NamedTuple):
    """How particles beside a tip pass from whole to cut (cracks/tip_nodes.py)."""

    front: float  # where ahead of the tip the front of a particle begins to be cut (cells)
    ramp: float  # cells of the crack over which it rises


class Books(NamedTuple):
    """Energies that have passed the border of the solid so far; arrays of one number (J)."""

    external: np.ndarray  # work of loads and moving boundaries
    damping: np.ndarray  # taken by damping
    friction: np.ndarray  # work of friction on crack faces
    impact: np.ndarray  # lost where crack faces meet
    fracture: np.ndarray  # spent on new crack surface
    absorbed: np.ndarray  # taken by absorbing boundaries


@dataclass(frozen=True)
class Model:
    """What a deck says, in numbers; nothing here changes during a run."""

    lattice: Lattice
    geometry: Any  # plane strain, plane stress
    blocks: tuple  # of Block
    update: Any  # FLIP, FMPM, XPIC
    scheme: Scheme
    damping: tuple  # grid, particle (1/s); those of the start if it is found while running
    dt: float  # s
    end_time: float  # s
    crack_names: tuple
    contact: Any  # ContactLaws
    conditions: Any  # boundary conditions and loads
    groups: Groups  # which bodies share their rows
    between_bodies: Any = None  # BodyContact; None: all bodies are glued
    half: np.ndarray | None = None  # (n, dim) half size of each particle by number, in cells;
    # None: all of a block are full and as large as its shape says
    reach: np.ndarray | None = None  # (n, dim) how far each reaches towards another body, in cells
    fracture: Any = None  # how J and K are evaluated
    cohesion: Any = None  # traction laws of crack faces; None: there are none
    events: tuple = ()  # what loads and boundaries wait for: boundary/events.py
    propagation: Any = None  # when, where to and how fast cracks grow; None: they do not
    leaving: str = "error"  # what particles that leave the grid are: transfer/leaving.py
    calm_tips: bool = False  # filter particles around running tips: FLIP does not by itself
    tip_nodes: TipNodes | None = None  # None: cut at once, by the line test alone (the paper)
    rest: Rest = Rest()  # when a run to a static answer is at rest
    nodes: tuple = field(init=False)
    strides: tuple = field(init=False)

    def __post_init__(self) -> None:
        """Keep the nodes along the axes and the strides at hand: many kernels want them."""
        object.__setattr__(self, "nodes", self.lattice.nodes)
        object.__setattr__(self, "strides", self.lattice.strides)


@dataclass
class State:
    """Exactly what a checkpoint holds."""

    time: float
    step: int
    particles: Particles
    paths: Paths
    books: Books
    reactions: np.ndarray  # (named boundaries, dim) of the last step (N)
    contact_forces: np.ndarray  # (contact groups, dim) on their bodies in the last step (N)
    bands: np.ndarray  # (blocks, bands + 1) first particle of each band; those deleted come last
    growth: Growth
    bonds: np.ndarray  # (n, 4) of bodies that stick to each other: contact/adhesion.py
    events: np.ndarray  # (events,) when each has happened (s), infinite before
    drag: np.ndarray  # (2,) damping of grid and particles, where it is found while running (1/s)


@dataclass
class Scratch:
    """Arrays of a step that nobody needs after it."""

    grid: Grid
    rows: Rows
    stencil: Stencil
    segments: Any
    team: Any  # the threads
    beyond: np.ndarray  # (cracks,) how far tips are carried on (m)
    report: np.ndarray  # (blocks, bands, 4) what locating the particles found
    reports: list  # that of each block
    per_band: np.ndarray  # (bands,) sums over the particles of a band
    seen: tuple  # room for what the surfaces of a crack point see, above and below
    followers: Any  # nodes ahead of tips that open as those behind do
    at_tips: np.ndarray  # (tips, 2) of the particle nearest to each: distance, half size (cells)
    shared: list = field(default_factory=list)  # for each block: its particles, shared out
    half: np.ndarray | None = None  # that of the model
    index: np.ndarray | None = None  # (n,) where the particle of each number is
    origins: Any = None  # numbers of the particles by the cells in which they started
    held: list | None = None  # where each prescribed velocity acts: boundary/grip.py
    contested: list | None = None  # pairs of them that want the same rows otherwise
    remarks: list = field(default_factory=list)  # what a user should be told of this step
    free: list | None = None  # nodes of each symmetry plane that lie on its crack
    meeting: Any = None  # contact between bodies
    drawn: Any = None  # tractions on the faces of cracks in this step, gaps at its start
    parted: Any = ()  # crack points that have lost all traction in this step
    dashpots: Any = None  # of absorbing boundaries
    share: np.ndarray | None = None  # (nodes,) of the sums of a node that are the body's own

    @property
    def row_count(self) -> int:
        """Rows in use: nodes and extra rows."""
        return len(self.rows.first) + int(self.rows.count[0])


def no_energy() -> Books:
    """Return books in which nothing is written."""
    return Books(*(np.zeros(1) for _ in Books._fields))
