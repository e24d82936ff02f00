"""What a shape answers, and those given by a formula.

Every shape tells which points it contains, its bounds, its centroid and its outline. Points on the
border: a rectangle (and a polygon) owns its left and lower border but not the right and upper one,
so neighbours share no point and lose none; disk and ellipse leave their border to what is around.
"""

from abc import abstractmethod
from collections.abc import Iterator
from math import cos, hypot, radians, sin
from typing import ClassVar, Literal, Self

from pydantic import Field

from cramp_cli.schema.section import Section, Wrong
from cramp_cli.schema.units import Angle, Length, Point, pair

NUDGE = 1e-9  # of a shape's size: how far points are moved to the upper right, off the border
ARC_PIECES = 64  # straight pieces of a quarter circle in an outline
KIND = "kind of shape"


class Shape(Section):
    """A region of the plane."""

    places: ClassVar[tuple[str, ...]] = ()  # keys that hold points, which move with the shape

    @abstractmethod
    def contains(self, points):
        """Return which of the (n, 2) points (m) lie inside, as (n,) booleans."""

    @abstractmethod
    def bounds(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Return the lower and the upper corner (m) of the box around the shape."""

    @abstractmethod
    def outline(self):
        """Return the region as a shapely geometry; curves are 64 pieces to a quarter turn."""

    def centroid(self) -> tuple[float, float]:
        """Return the centre of the area (m)."""
        centre = self.outline().centroid
        return centre.x, centre.y

    def pieces(self) -> tuple["Shape", ...]:
        """Return the shapes of which it is made, each one able to be a body of its own."""
        return (self,)

    def count_pieces(self) -> int:
        """Return of how many simple shapes it is made, told without making them."""
        return 1

    def moved(self, way: tuple[float, float]) -> Self:
        """Return the same shape elsewhere, by `way` (m)."""
        fields = {name: getattr(self, name) for name in type(self).model_fields}
        there = {name: shifted(fields[name], way) for name in self.places}
        return type(self).model_construct(**fields | there)  # a copy would keep what is cached

    def nudged(self, points):
        """Return points moved a little to the upper right, off the border."""
        (x0, y0), (x1, y1) = self.bounds()
        return points + NUDGE * max(x1 - x0, y1 - y0)


class Rectangle(Shape):
    """An upright rectangle between two corners."""

    places: ClassVar = ("lower", "upper")

    type: Literal["rectangle"] = Field("rectangle", description=KIND)
    lower: Point = Field(description="lower left corner")
    upper: Point = Field(description="upper right corner")

    def wrong_values(self) -> Iterator[Wrong]:
        """The corners must span an area."""
        for axis, (low, high) in enumerate(zip(self.lower, self.upper, strict=True)):
            if high <= low:
                yield ("upper", axis), f"must be above lower ({low:g} m) (got {high:g} m)"

    def contains(self, points):
        """Return which points lie inside; the left and lower border belong to it."""
        return ((points := self.nudged(points)) > self.lower).all(1) & (points < self.upper).all(1)

    def bounds(self):
        """Return the two corners (m)."""
        return self.lower, self.upper

    def outline(self):
        """Return the rectangle."""
        from shapely import box

        return box(*self.lower, *self.upper)

    def centroid(self):
        """Return the middle (m)."""
        return tuple(0.5 * (a + b) for a, b in zip(self.lower, self.upper, strict=True))


class Ellipse(Shape):
    """An ellipse, turned by an angle counter-clockwise."""

    places: ClassVar = ("center",)

    type: Literal["ellipse"] = Field("ellipse", description=KIND)
    center: Point = Field(description="its centre")
    radii: pair(Length) = Field(description="half axes along x and y before turning, above 0")
    angle: Angle = Field(0.0, description="turn counter-clockwise about the centre")

    def wrong_values(self) -> Iterator[Wrong]:
        """Both radii must be positive."""
        for axis, radius in enumerate(self.radii):
            if radius <= 0.0:
                yield ("radii", axis), f"must be above 0 (got {radius:g} m)"

    def contains(self, points):
        """Return which points lie inside; the border does not belong to it."""
        c, s = cos(radians(self.angle)), sin(radians(self.angle))
        x, y = points[:, 0] - self.center[0], points[:, 1] - self.center[1]
        a, b = self.radii
        return ((c * x + s * y) / a) ** 2 + ((c * y - s * x) / b) ** 2 < 1.0

    def bounds(self):
        """Return the corners of the box around it (m)."""
        c, s = cos(radians(self.angle)), sin(radians(self.angle))
        a, b = self.radii
        return _box(self.center, hypot(a * c, b * s), hypot(a * s, b * c))

    def outline(self):
        """Return it as a polygon."""
        from shapely import affinity

        around = affinity.scale(_circle((0.0, 0.0), 1.0), *self.radii, origin=(0.0, 0.0))
        turned = affinity.rotate(around, self.angle, origin=(0.0, 0.0))
        return affinity.translate(turned, *self.center)

    def centroid(self):
        """Return the centre (m)."""
        return self.center


class Disk(Shape):
    """A full circle."""

    places: ClassVar = ("center",)

    type: Literal["disk"] = Field("disk", description=KIND)
    center: Point = Field(description="its centre")
    radius: Length = Field(gt=0, description="its radius")

    def contains(self, points):
        """Return which points lie inside; the border does not belong to it."""
        return _squared_distance(points, self.center) < self.radius**2

    def bounds(self):
        """Return the corners of the box around it (m)."""
        return _box(self.center, self.radius, self.radius)

    def outline(self):
        """Return it as a polygon."""
        return _circle(self.center, self.radius)

    def centroid(self):
        """Return the centre (m)."""
        return self.center


class Annulus(Shape):
    """The ring between two circles."""

    places: ClassVar = ("center",)

    type: Literal["annulus"] = Field("annulus", description=KIND)
    center: Point = Field(description="its centre")
    inner: Length = Field(gt=0, description="inner radius")
    outer: Length = Field(gt=0, description="outer radius")

    def wrong_values(self) -> Iterator[Wrong]:
        """The inner radius must be the smaller one."""
        if self.outer <= self.inner:
            yield ("outer",), f"must be above inner ({self.inner:g} m) (got {self.outer:g} m)"

    def contains(self, points):
        """Return which points lie inside; the inner border belongs to it, the outer does not."""
        squared = _squared_distance(points, self.center)
        return (squared >= self.inner**2) & (squared < self.outer**2)

    def bounds(self):
        """Return the corners of the box around it (m)."""
        return _box(self.center, self.outer, self.outer)

    def outline(self):
        """Return it as a polygon with a hole."""
        return _circle(self.center, self.outer) - _circle(self.center, self.inner)

    def centroid(self):
        """Return the centre (m)."""
        return self.center


def shifted(place, way: tuple[float, float]):
    """Return a point, a shape, or a list of either, moved by `way` (m)."""
    if isinstance(place, Shape):
        return place.moved(way)
    if isinstance(place[0], float):
        return place[0] + way[0], place[1] + way[1]
    return tuple(shifted(one, way) for one in place)


def _squared_distance(points, center):
    x, y = points[:, 0] - center[0], points[:, 1] - center[1]
    return x * x + y * y


def _box(center, half_x, half_y):
    x, y = center
    return (x - half_x, y - half_y), (x + half_x, y + half_y)


def _circle(center, radius):
    from shapely import Point as Spot

    return Spot(*center).buffer(radius, quad_segs=ARC_PIECES)
