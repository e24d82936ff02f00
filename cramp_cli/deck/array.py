"""Copies of a shape in rows and columns: bores, fibres, the cells of a honeycomb."""

from collections.abc import Iterator
from functools import cached_property
from typing import ClassVar, Literal

from pydantic import Field

from cramp_cli.deck.assembly import MOST_PIECES, Assembly
from cramp_cli.deck.shape import KIND, Shape
from cramp_cli.schema.section import Count, Wrong
from cramp_cli.schema.units import Length, pair


class Array(Assembly):
    """Copies of a shape in rows and columns; the first one is where the shape says."""

    places: ClassVar = ("of",)

    type: Literal["array"] = Field("array", description=KIND)
    of: "AnyShape" = Field(description="the shape at the lower left")  # noqa: F821 (shapes.py)
    count: pair(Count) = Field(description="copies along x and along y")
    spacing: pair(Length) = Field(description="way to the next column, to the next row")
    shift: Length = Field(0.0, description="how far every second row is moved along x")

    def wrong_values(self) -> Iterator[Wrong]:
        """There are copies, at different places."""
        for axis, count in enumerate(self.count):
            if not 1 <= count <= MOST_PIECES:
                yield ("count", axis), f"must be from 1 to {MOST_PIECES} (got {count})"
            if count > 1 and self.spacing[axis] <= 0.0:
                yield ("spacing", axis), f"must be above 0 (got {self.spacing[axis]:g} m)"
        copies, each = self.count[0] * self.count[1], self.of.count_pieces()
        if copies * each > MOST_PIECES:
            of = f" of {each} shapes, {copies * each} in all" if each > 1 else ""
            yield ("count",), f"makes {copies} copies{of}; at most {MOST_PIECES} are possible"

    def count_pieces(self) -> int:
        """Return how many simple shapes all copies are."""
        return self.count[0] * self.count[1] * self.of.count_pieces()

    def pieces(self) -> tuple[Shape, ...]:
        """Return the copies, row by row from below."""
        return self._copies

    @cached_property
    def _copies(self) -> tuple[Shape, ...]:
        (dx, dy), (columns, rows) = self.spacing, self.count
        return tuple(
            self.of.moved((column * dx + (row % 2) * self.shift, row * dy))
            for row in range(rows)
            for column in range(columns)
        )
