"""How bodies touch: a law for each pair of contact groups, and the way normals are found."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from cramp_cli.contact.outline import Outlines
from cramp_cli.contact.surface import Surface
from cramp_cli.cracks.contact import ADHESIVE
from cramp_cli.state.signal import Signal

AVERAGE, LARGER, LOGISTIC = 0, 1, 2
NORMALS = {"average": AVERAGE, "larger": LARGER, "logistic": LOGISTIC}


class BodyLaws(NamedTuple):
    """Law of every pair of contact groups; symmetric."""

    kind: np.ndarray  # (groups, groups) IGNORE, FRICTIONAL ... (cracks/contact.py)
    mu: np.ndarray  # (groups, groups) coefficient of sliding friction
    mu_static: np.ndarray  # (groups, groups) coefficient of static friction, not below mu
    strength: np.ndarray  # (groups, groups) of adhesion against pulling (Pa)
    shear_strength: np.ndarray  # (groups, groups) of adhesion against shearing (Pa)


@dataclass(frozen=True)
class RigidBody:
    """A body with prescribed motion: velocity times signal."""

    group: int
    body: int  # number in the deck
    velocity: np.ndarray  # (dim,) m/s
    signal: Signal


@dataclass(frozen=True)
class BodyContact:
    """Contact between the bodies of a model."""

    names: tuple  # of the contact groups, for their forces
    laws: BodyLaws
    normal: int  # AVERAGE, LARGER or LOGISTIC
    outlines: Outlines  # of rigid bodies, of which the normals beside them are
    surface: Surface  # of elastic bodies, where rigid ones meet them
    rigid: tuple = ()  # of RigidBody

    @property
    def adhesive(self) -> bool:
        """Whether any two bodies stick to each other: then the state keeps their bonds."""
        return bool((self.laws.kind == ADHESIVE).any())

    def rigid_groups(self) -> np.ndarray:
        """Return for each contact group whether it is a rigid body, as 0 or 1."""
        flags = np.zeros(len(self.names), dtype=np.int64)
        flags[[one.group for one in self.rigid]] = 1
        return flags

    def rigid_ways(self, particles) -> np.ndarray:
        """Return which way rigid bodies have gone (groups, dim), m; zero for other groups."""
        ways = np.zeros((len(self.names), particles.position.shape[1]))
        for one in self.rigid:
            p = np.argmax(particles.body == one.body)
            ways[one.group] = particles.position[p] - particles.origin[p]
        return ways

    def rigid_velocities(self, state, dim: int) -> np.ndarray:
        """Return the prescribed velocity of every contact group (m/s), zero where there is none."""
        velocity = np.zeros((len(self.names), dim))
        for one in self.rigid:
            velocity[one.group] = one.signal.speed(state) * one.velocity
        return velocity
