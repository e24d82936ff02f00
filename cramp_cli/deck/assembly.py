"""Shapes made of pieces: what they hold, their bounds and outline are those of the pieces."""

from typing import ClassVar, Literal

from pydantic import Field

from cramp_cli.deck.shape import KIND, Shape


class Assembly(Shape):
    """All that lies in at least one of its pieces."""

    def contains(self, points):
        """Return which points lie in one of the pieces."""
        inside, *others = (piece.contains(points) for piece in self.pieces())
        for more in others:
            inside |= more
        return inside

    def bounds(self):
        """Return the corners of the box around all (m)."""
        lowers, uppers = zip(*(piece.bounds() for piece in self.pieces()), strict=True)
        return (
            tuple(map(min, zip(*lowers, strict=True))),
            tuple(map(max, zip(*uppers, strict=True))),
        )

    def outline(self):
        """Return the union of the outlines."""
        from shapely import union_all

        return union_all([piece.outline() for piece in self.pieces()])


class Union(Assembly):
    """All that lies in at least one of several shapes."""

    places: ClassVar = ("of",)

    type: Literal["union"] = Field("union", description=KIND)
    of: tuple["AnyShape", ...] = Field(  # noqa: F821 (it is made in shapes.py)
        min_length=1, description="the shapes to join"
    )

    def pieces(self):
        """Return the shapes."""
        return self.of
