"""What a deck says about grid and bodies."""

from collections.abc import Iterator

from pydantic import Field

from cramp_cli.deck.events import HOLD, KEYS, REVERSE, EventSection
from cramp_cli.deck.shapes import AnyShape
from cramp_cli.schema.curve import Constant, Curve
from cramp_cli.schema.section import Count, Flag, Name, Section, Wrong, only_one
from cramp_cli.schema.units import AngularVelocity, Length, Point, Velocity, pair

FIT = 1e-6  # of a cell: how well a box must fit whole cells, and a plane a grid line


class GridSection(Section):
    """The background grid: square cells, lines at multiples of the cell unless a box is given."""

    cell: Length = Field(gt=0, description="width of a cell")
    lower: Point | None = Field(None, description="lower left corner; with `upper`, or neither")
    upper: Point | None = Field(None, description="upper right corner; with `lower`, or neither")
    margin: Count = Field(
        4, ge=2, le=1000, description="empty cells around all bodies when no box is given"
    )

    @classmethod
    def wrong_keys(cls, keys: set[str]) -> Iterator[Wrong]:
        """A box has two corners, and then no margin."""
        for key, other in (("lower", "upper"), ("upper", "lower")):
            if key in keys and other not in keys:
                yield (other,), f"is missing; it goes with {key}"
        if {"margin", "lower"} <= keys:
            yield ("margin",), "is for a grid without lower and upper"

    def wrong_values(self) -> Iterator[Wrong]:
        """The box holds whole cells."""
        if self.lower is None or self.upper is None:
            return
        for axis, (low, high) in enumerate(zip(self.lower, self.upper, strict=True)):
            count = (high - low) / self.cell
            fitting = low + max(round(count), 1) * self.cell
            if high <= low:
                yield ("upper", axis), f"must be above lower ({low:g} m) (got {high:g} m)"
            elif abs(count - round(count)) > FIT or round(count) < 1:
                message = f"must be a whole number of cells above lower (got {count:.7g} cells)"
                yield ("upper", axis), f"{message}; nearest that fits: {fitting:.9g} m"


class RigidSection(Section):
    """Motion of a rigid body: a wall, a pin, a wedge."""

    velocity: pair(Velocity) = Field((0.0, 0.0), description="its velocity")
    in_time: Curve = Field(
        default_factory=Constant, description="what `velocity` is multiplied by, over time"
    )
    hold_when: EventSection | None = Field(None, description=HOLD)
    reverse_when: EventSection | None = Field(None, description=REVERSE)

    @classmethod
    def wrong_keys(cls, keys: set[str]) -> Iterator[Wrong]:
        """One event."""
        yield from only_one(keys, KEYS, needed=False)


class BodySection(Section):
    """A region filled with particles of one material, a rigid body, or a hole in earlier bodies."""

    name: Name = Field(description="its name")
    material: Name | None = Field(
        None, description="name of its material; not if `hole` or `rigid`"
    )
    hole: Flag = Field(False, description="cut the shape out of earlier bodies and fill nothing")
    rigid: RigidSection | None = Field(
        None, description="its motion, if it is rigid: it touches others and nothing moves it"
    )
    shape: AnyShape = Field(
        description="the region, filled up to its border; where bodies overlap the later one counts"
    )
    each: Flag = Field(
        False,
        description="make a body of every piece of the shape, NAME_1, NAME_2 ...: they touch each "
        "other where there is contact between bodies",
    )
    particles_per_cell: Count = Field(
        2, ge=1, le=4, description="particles along each side of a cell"
    )
    velocity: pair(Velocity) = Field((0.0, 0.0), description="velocity at time 0")
    angular_velocity: AngularVelocity = Field(
        0.0, description="turning at time 0, counter-clockwise about the shape's centroid"
    )

    @classmethod
    def wrong_keys(cls, keys: set[str]) -> Iterator[Wrong]:
        """A body is made of something; a hole is not."""
        if not keys & {"hole", "rigid", "material"}:
            yield ("material",), "is missing"

    def wrong_values(self) -> Iterator[Wrong]:
        """A hole has no material and does not move; a rigid body has a motion of its own."""
        if self.each and self.hole:
            yield ("each",), "does not go with hole: true"
        if not self.hole and self.rigid is None:
            if self.material is None:
                yield ("material",), "is missing"
            return
        if self.hole and self.rigid is not None:
            yield ("rigid",), "does not go with hole: true"
        for key in ("material", "velocity", "angular_velocity", "particles_per_cell"):
            free = self.rigid is not None and key == "particles_per_cell"
            if not free and getattr(self, key) != type(self).model_fields[key].default:
                yield (key,), f"does not go with {'hole: true' if self.hole else 'rigid'}"
