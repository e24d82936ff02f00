"""What a deck says about prescribed motion on planes of the grid."""

from collections.abc import Iterator
from typing import Literal

from pydantic import Field

from cramp_cli.deck.events import HOLD, KEYS, REVERSE, EventSection
from cramp_cli.deck.where import AXES, Where
from cramp_cli.schema.curve import Constant, Curve
from cramp_cli.schema.section import Flag, Name, Section, Wrong, only_one
from cramp_cli.schema.units import Velocity


class VelocityOnPlane(Section):
    """The prescribed components of velocity; those left out are free."""

    x: Velocity | None = Field(None, description="velocity along x")
    y: Velocity | None = Field(None, description="velocity along y")

    @classmethod
    def wrong_keys(cls, keys: set[str]) -> Iterator[Wrong]:
        """It must say something."""
        if not keys & set(AXES):
            yield (), "give x or y or both"


class BoundarySection(Section):
    """What a plane of grid nodes does: one of `fix`, `velocity`, `symmetry` and `absorbing`."""

    name: Name | None = Field(None, description="its name, for messages and overrides")
    where: Where = Field(description="the plane; further ranges limit it")
    fix: tuple[Literal["x", "y"], ...] | None = Field(
        None, min_length=1, description="directions in which nothing moves"
    )
    velocity: VelocityOnPlane | None = Field(
        None, description="prescribed velocity; the plane goes with the face that it moves"
    )
    symmetry: Flag | None = Field(
        None, description="mirror plane: nothing moves through it, both sides slide along it"
    )
    absorbing: Flag | None = Field(
        None, description="faces of bodies on the plane let waves out, as if the solid went on"
    )
    in_time: Curve = Field(
        default_factory=Constant, description="what `velocity` is multiplied by, over time"
    )
    hold_when: EventSection | None = Field(None, description=HOLD)
    reverse_when: EventSection | None = Field(None, description=REVERSE)

    @classmethod
    def wrong_keys(cls, keys: set[str]) -> Iterator[Wrong]:
        """One kind of motion."""
        yield from only_one(keys, ("fix", "velocity", "symmetry", "absorbing"))
        yield from only_one(keys, KEYS, needed=False)
        for key in KEYS:
            if key in keys and "velocity" not in keys:
                yield (key,), "goes with velocity only"

    def wrong_values(self) -> Iterator[Wrong]:
        """Planes are where motion is prescribed."""
        planes = len(self.where.planes)
        for key in ("symmetry", "absorbing"):
            if getattr(self, key) is False:
                yield (key,), "must be true; leave it out otherwise"
        if (self.symmetry or self.absorbing) and planes != 1:
            yield ("where",), f"must be exactly one plane: one number for x or y (got {planes})"
        elif not planes:
            yield ("where",), "must be a plane: give one number for x or y"
        if self.velocity is None and not isinstance(self.in_time, Constant):
            yield ("in_time",), "goes with velocity only"
        if self.fix and len(set(self.fix)) < len(self.fix):
            yield ("fix",), "names a direction twice"

    @property
    def components(self) -> tuple[tuple[int, float], ...]:
        """Axis (0, 1) and velocity (m/s) of each prescribed component."""
        if self.absorbing:
            return ()
        if self.fix:
            return tuple((AXES.index(axis), 0.0) for axis in self.fix)
        if self.symmetry:
            return ((self.where.planes[0][0], 0.0),)
        given = ((axis, getattr(self.velocity, name)) for axis, name in enumerate(AXES))
        return tuple((axis, speed) for axis, speed in given if speed is not None)
