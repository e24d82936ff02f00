"""Regions of the plane: polygons, and shapes made of other shapes."""

import re
from collections.abc import Iterator
from functools import cached_property
from pathlib import Path
from typing import ClassVar, Literal

from pydantic import Field

from cramp_cli.deck.array import Array
from cramp_cli.deck.assembly import Union, union_of
from cramp_cli.deck.image import Image
from cramp_cli.deck.mesh import Mesh
from cramp_cli.deck.pack import Pack
from cramp_cli.deck.points import UNIT, read_into, unit_without_file
from cramp_cli.deck.shape import KIND, Annulus, Disk, Ellipse, Rectangle, Shape
from cramp_cli.schema.section import Wrong, one_of, only_one
from cramp_cli.schema.units import Length, Point


class Polygon(Shape):
    """A polygon through its corners, closed by itself."""

    places: ClassVar = ("points",)

    type: Literal["polygon"] = Field("polygon", description=KIND)
    points: tuple[Point, ...] | None = Field(None, min_length=3, description="its corners in order")
    file: str | None = Field(None, description="csv file with one `x,y` row for each corner")
    unit: Length | None = Field(None, gt=0, description=UNIT)

    @classmethod
    def prepare(cls, data: dict, folder: Path | None) -> dict:
        """Take the points out of the file."""
        return read_into(data, folder)

    @classmethod
    def wrong_keys(cls, keys: set[str]) -> Iterator[Wrong]:
        """Corners come from one place."""
        yield from only_one(keys, ("points", "file"))
        yield from unit_without_file(keys)

    def wrong_values(self) -> Iterator[Wrong]:
        """It must not cross itself."""
        outline = self.outline()
        if not outline.is_valid:
            yield ("points",), f"is no simple polygon: its border meets itself{_place(outline)}"
        elif outline.area <= 0.0:
            yield ("points",), "is no simple polygon: it has no area"

    def contains(self, points):
        """Return which points lie inside; the left and lower border belong to it."""
        from shapely import contains_xy, prepare

        outline = self.outline()
        prepare(outline)
        points = self.nudged(points)
        return contains_xy(outline, points[:, 0], points[:, 1])

    def bounds(self):
        """Return the corners of the box around it (m)."""
        return tuple(map(min, zip(*self.points, strict=True))), tuple(
            map(max, zip(*self.points, strict=True))
        )

    def outline(self):
        """Return the polygon."""
        from shapely import Polygon as Region

        return Region(self.points)


class Difference(Shape):
    """A shape without what lies in others."""

    places: ClassVar = ("of", "minus")

    type: Literal["difference"] = Field("difference", description=KIND)
    of: "AnyShape" = Field(description="the shape to cut")
    minus: tuple["AnyShape", ...] = Field(min_length=1, description="the shapes to cut away")

    def wrong_values(self) -> Iterator[Wrong]:
        """Something must be left."""
        from shapely.errors import ShapelyError

        try:
            if self.outline().is_empty:
                yield ("minus",), "cuts everything away"
        except ShapelyError as problem:
            yield ("minus",), f"cannot be cut away: {problem}"

    def contains(self, points):
        """Return which points lie in the shape and in none of those cut away."""
        inside = self.of.contains(points)
        for shape in self.minus:
            inside &= ~shape.contains(points)
        return inside

    def count_pieces(self):
        """Return how many simple shapes it and those cut away are made of."""
        return sum(shape.count_pieces() for shape in (self.of, *self.minus))

    def bounds(self):
        """Return the corners of the box around what is left (m)."""
        x0, y0, x1, y1 = self.outline().bounds
        return (x0, y0), (x1, y1)

    def outline(self):
        """Return the outline of what is left."""
        return self._outline

    @cached_property
    def _outline(self):
        return self.of.outline() - union_of([shape.outline() for shape in self.minus])


def _place(outline) -> str:
    """Return where shapely finds the border at odds with itself, as far as it tells."""
    from shapely import is_valid_reason

    found = re.search(r"\[(\S+) (\S+)\]", is_valid_reason(outline))
    return f" at ({found[1]}, {found[2]}) m" if found else ""


AnyShape = one_of(
    "type",
    Rectangle,
    Disk,
    Ellipse,
    Polygon,
    Annulus,
    Union,
    Difference,
    Array,
    Pack,
    Image,
    Mesh,
)
for _shape in (Union, Difference, Array, Pack):
    _shape.model_rebuild()
