"""Shapes made of pieces: what they hold, their bounds and outline are those of the pieces."""

from functools import cached_property
from typing import ClassVar, Literal

from pydantic import Field

from cramp_cli.deck.shape import KIND, Shape

MOST_PIECES = 100_000  # of all shapes of a deck, counted before any of them is made
EDGE = 1e-6  # of a piece's width: how far points beside it are still asked


class Assembly(Shape):
    """All that lies in at least one of its pieces."""

    def contains(self, points):
        """Return which points lie in one of the pieces."""
        import numpy as np

        order = np.argsort(points[:, 0], kind="stable")
        sorted_x, inside = points[order, 0], np.zeros(len(points), bool)
        for piece in self.pieces():
            (low, _), (high, _) = piece.bounds()
            ends = low - EDGE * (high - low), high + EDGE * (high - low)
            near = order[slice(*np.searchsorted(sorted_x, ends))]
            inside[near] |= piece.contains(points[near])
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
        return self._outline

    @cached_property
    def _outline(self):
        return union_of([piece.outline() for piece in self.pieces()])

    def count_pieces(self):
        """Return how many simple shapes it is made of."""
        return sum(piece.count_pieces() for piece in self.pieces())


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


def union_of(regions: list):
    """Return the union of shapely geometries, overlaid only where they touch each other.

    Overlay costs far more than finding out that most of ten thousand disks touch no other.
    """
    from shapely import STRtree, multipolygons, union_all

    if len(regions) == 1:
        return regions[0]
    first, second = STRtree(regions).query(regions, predicate="intersects")
    members: dict[int, list] = {}
    for one, leader in enumerate(_leaders(len(regions), first.tolist(), second.tolist())):
        members.setdefault(leader, []).append(regions[one])
    if len(members) == 1:
        return union_all(regions)
    unions = [union_all(some) if len(some) > 1 else some[0] for some in members.values()]
    return multipolygons([part for one in unions for part in getattr(one, "geoms", [one])])


def _leaders(count: int, first: list[int], second: list[int]) -> list[int]:
    """Return for each of `count` things the same one for all that pairs connect it with."""
    leader = list(range(count))

    def root(one: int) -> int:
        while leader[one] != one:
            leader[one] = one = leader[leader[one]]
        return one

    for a, b in zip(first, second, strict=True):
        leader[root(a)] = root(b)
    return list(map(root, range(count)))
