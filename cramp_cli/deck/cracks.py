"""What a deck says about cracks."""

from collections.abc import Iterator
from functools import cached_property
from math import ceil, cos, hypot, radians, sin
from pathlib import Path
from typing import Literal

from pydantic import Field

from cramp_cli.deck.cohesive import AnyTraction
from cramp_cli.deck.contact import AnyContact
from cramp_cli.deck.points import UNIT, read_into, unit_without_file
from cramp_cli.schema.section import Name, Section, Wrong, only_one
from cramp_cli.schema.units import Angle, Length, Point, pair

End = Literal["auto", "tip", "edge", "junction", "plain"]
WHAT = "auto: by where it lies; tip, edge of the body, junction with a crack, or plain end inside"
FINE = 512  # pieces of an arc when its length is measured and its outline is drawn


class Arc(Section):
    """A piece of a circle or of an upright ellipse."""

    center: Point = Field(description="centre of the circle")
    radius: Length | None = Field(None, gt=0, description="radius of a circle")
    radii: pair(Length) | None = Field(None, description="half axes of an ellipse along x and y")
    first: Angle = Field(alias="from", description="angle of the start; 0 is the +x direction")
    last: Angle = Field(alias="to", description="angle of the end; above `from` counter-clockwise")

    @classmethod
    def wrong_keys(cls, keys: set[str]) -> Iterator[Wrong]:
        """A circle or an ellipse."""
        yield from only_one(keys, ("radius", "radii"))

    def wrong_values(self) -> Iterator[Wrong]:
        """It has a length and does not cover itself."""
        for axis, radius in enumerate(self.radii or ()):
            if radius <= 0.0:
                yield ("radii", axis), f"must be above 0 (got {radius:g} m)"
        if not 0.0 < abs(self.last - self.first) <= 360.0:
            turn = abs(self.last - self.first)
            yield ("to",), f"must be more than 0 and at most 360 degrees from `from` (got {turn:g})"

    def at(self, share: float) -> tuple[float, float]:
        """Return the point (m) at a share (0 to 1) of the way in angle."""
        a, b = self.radii or (self.radius, self.radius)
        angle = radians(self.first + share * (self.last - self.first))
        return self.center[0] + a * cos(angle), self.center[1] + b * sin(angle)


class CrackSection(Section):
    """A crack: a line from its start to its end."""

    name: Name = Field(description="its name")
    points: tuple[Point, ...] | None = Field(None, description="its points from start to end")
    arc: Arc | None = Field(None, description="an arc instead of points")
    file: str | None = Field(None, description="csv file with one `x,y` row for each point")
    unit: Length | None = Field(None, gt=0, description=UNIT)
    start: End = Field("auto", description=f"what its start is; {WHAT}")
    end: End = Field("auto", description=f"what its end is; {WHAT}")
    segment: Length | None = Field(
        None, gt=0, description="longest piece of the line; half a cell if not given"
    )
    contact: AnyContact | None = Field(
        None, description="contact of its faces; that of `contact` if not given"
    )
    traction: AnyTraction | None = Field(
        None, description="traction law between its faces; none if not given"
    )
    traction_along: pair(Length) | None = Field(
        None, description="part with the law: from and to, along the line from its start"
    )
    motion: Literal["free", "fixed"] = Field(
        "free", description="whether the line moves with the solid"
    )
    plane: Literal["average"] = Field(
        "average", description="how the line follows its two sides: midway between them"
    )

    @classmethod
    def prepare(cls, data: dict, folder: Path | None) -> dict:
        """Take the points out of the file."""
        return read_into(data, folder)

    @classmethod
    def wrong_keys(cls, keys: set[str]) -> Iterator[Wrong]:
        """The line is given in one way."""
        yield from only_one(keys, ("points", "arc", "file"))
        yield from unit_without_file(keys)

    def wrong_values(self) -> Iterator[Wrong]:
        """It must have a length."""
        if self.points is not None and len(set(self.points)) < 2:
            count = len(set(self.points))
            yield ("points",), f"must have at least 2 different points (got {count})"
        elif self.arc is not None and len(self.corners) < 2:
            yield ("arc",), "is too small beside its coordinates"
        else:
            yield from self._wrong_traction()

    def _wrong_traction(self) -> Iterator[Wrong]:
        """Openings are known where faces move; the part lies on the crack."""
        law, part = self.traction, self.traction_along
        if law is not None and law.law != "pressure" and self.motion == "fixed":
            message = f"traction: {{law: {law.law}}} needs the opening of faces that move"
            yield ("motion",), f"must be free: {message} (got 'fixed')"
        if part is None:
            return
        if law is None:
            yield ("traction_along",), "goes with traction only"
        if not 0.0 <= part[0] < part[1] or part[0] >= self.length:
            limits = f"0 <= from < to, from below the length of the crack, {self.length:g} m"
            got = f"got {part[0]:g} m, {part[1]:g} m"
            yield ("traction_along",), f"must be {limits} ({got})"

    @cached_property
    def corners(self) -> tuple[tuple[float, float], ...]:
        """The line from start to end (m); an arc as 512 pieces; no point twice in a row."""
        points = self.points
        if self.arc is not None:
            points = [self.arc.at(step / FINE) for step in range(FINE + 1)]
        kept = [points[0]]
        kept += [
            after for before, after in zip(points, points[1:], strict=False) if after != before
        ]
        return tuple(kept)

    @property
    def length(self) -> float:
        """Length of the line (m)."""
        return sum(map(_distance, self.corners, self.corners[1:]))

    def path(self, longest: float):
        """Return points (n, 2) in m from start to end, at most `longest` (m) apart.

        Corners are kept, and points of an arc lie on the arc, equally spaced along it.
        """
        import numpy as np

        corners = np.array(self.corners)
        if self.arc is not None:
            return self._arc_path(np, corners, longest)
        pieces = []
        for before, after in zip(corners, corners[1:], strict=False):
            count = max(1, ceil(_distance(before, after) / longest - 1e-9))
            shares = np.arange(count)[:, None] / count
            pieces.append(before + shares * (after - before))
        return np.vstack([*pieces, corners[-1:]])

    def _arc_path(self, np, corners, longest: float):
        steps = np.hypot(*np.diff(corners, axis=0).T)
        travelled = np.concatenate([[0.0], np.cumsum(steps)])
        count = max(2, ceil(travelled[-1] / longest - 1e-9))
        shares = np.interp(
            np.linspace(0.0, travelled[-1], count + 1), travelled, np.linspace(0.0, 1.0, FINE + 1)
        )
        return np.array([self.arc.at(share) for share in shares])


def _distance(a, b) -> float:
    return hypot(b[0] - a[0], b[1] - a[1])
