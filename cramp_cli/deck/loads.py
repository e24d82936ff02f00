"""What a deck says about forces, tractions and gravity."""

from collections.abc import Iterator
from typing import Literal

from pydantic import Field

from cramp_cli.deck.events import HOLD, KEYS, REVERSE, EventSection
from cramp_cli.deck.where import Where
from cramp_cli.schema.curve import Constant, Curve
from cramp_cli.schema.section import Name, Section, Wrong, one_of, only_one
from cramp_cli.schema.units import Acceleration, Force, Stress, pair

FACTOR = "what it is multiplied by, over time"


class ForceSection(Section):
    """A force on the particles of a body: shared among them, or the same on each."""

    type: Literal["force"] = Field("force", description="kind of load")
    name: Name | None = Field(None, description="its name, for messages and overrides")
    body: Name = Field(description="the body it acts on")
    where: Where = Field(
        description="the part of the body it acts on; a plane: particles whose box touches it"
    )
    total: pair(Force) | None = Field(
        None, description="their sum, shared as the volume in the region is"
    )
    each: pair(Force) | None = Field(None, description="force on each particle chosen")
    in_time: Curve = Field(default_factory=Constant, description=FACTOR)
    hold_when: EventSection | None = Field(None, description=HOLD)
    reverse_when: EventSection | None = Field(None, description=REVERSE)

    @classmethod
    def wrong_keys(cls, keys: set[str]) -> Iterator[Wrong]:
        """One way to say how much."""
        yield from only_one(keys, ("total", "each"))
        yield from only_one(keys, KEYS, needed=False)


class TractionSection(Section):
    """A stress on a face of a body."""

    type: Literal["traction"] = Field("traction", description="kind of load")
    name: Name | None = Field(None, description="its name, for messages and overrides")
    body: Name = Field(description="the body it acts on")
    where: Where = Field(description="the face: one plane; further ranges limit it")
    traction: pair(Stress) | None = Field(None, description="force per area of the face")
    pressure: Stress | None = Field(None, description="pressure; positive pushes on the face")
    in_time: Curve = Field(default_factory=Constant, description=FACTOR)
    hold_when: EventSection | None = Field(None, description=HOLD)
    reverse_when: EventSection | None = Field(None, description=REVERSE)

    @classmethod
    def wrong_keys(cls, keys: set[str]) -> Iterator[Wrong]:
        """One way to say how much."""
        yield from only_one(keys, ("traction", "pressure"))
        yield from only_one(keys, KEYS, needed=False)

    def wrong_values(self) -> Iterator[Wrong]:
        """A face is one plane."""
        planes = len(self.where.planes)
        if planes != 1:
            yield ("where",), f"must be exactly one plane: one number for x or y (got {planes})"


class GravitySection(Section):
    """An acceleration of all bodies."""

    type: Literal["gravity"] = Field("gravity", description="kind of load")
    name: Name | None = Field(None, description="its name, for messages and overrides")
    acceleration: pair(Acceleration) = Field(description="acceleration of free fall")
    in_time: Curve = Field(default_factory=Constant, description=FACTOR)
    hold_when: EventSection | None = Field(None, description=HOLD)
    reverse_when: EventSection | None = Field(None, description=REVERSE)

    @classmethod
    def wrong_keys(cls, keys: set[str]) -> Iterator[Wrong]:
        """One event."""
        yield from only_one(keys, KEYS, needed=False)


AnyLoad = one_of("type", ForceSection, TractionSection, GravitySection)
