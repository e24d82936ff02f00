"""Disks at random places, none over another: grains, pores, fibres."""

from collections.abc import Iterator
from functools import cached_property
from math import pi
from random import Random
from typing import ClassVar, Literal

from pydantic import Field

from cramp_cli.deck.assembly import Assembly, Union
from cramp_cli.deck.scatter import scatter
from cramp_cli.deck.shape import KIND, Disk, Shape
from cramp_cli.schema.section import Count, Wrong, only_one
from cramp_cli.schema.units import Length, Number

MOST = 20_000  # disks
JAMMED, ALIKE = 0.55, 0.9  # equal disks jam at 0.547 (scatter.py), those nearly alike hardly later


class Pack(Assembly):
    """Disks at random places in a region, none over another; the same at every reading."""

    places: ClassVar = ("inside",)

    type: Literal["pack"] = Field("pack", description=KIND)
    inside: "AnyShape" = Field(description="the region that holds them whole")  # noqa: F821
    radius: Length = Field(gt=0, description="radius of the disks; the largest with `smallest`")
    smallest: Length | None = Field(
        None, gt=0, description="smallest radius; from it to `radius` all are as likely"
    )
    count: Count | None = Field(None, ge=1, le=MOST, description="number of disks; or `fraction`")
    fraction: Number | None = Field(
        None, gt=0, lt=1, description="share of the region that they fill; or `count`"
    )
    gap: Length = Field(0.0, ge=0, description="distance at least between disks, and to the border")
    seed: Count = Field(0, ge=0, description="another seed gives other places")

    @classmethod
    def wrong_keys(cls, keys: set[str]) -> Iterator[Wrong]:
        """Their number is told in one way."""
        yield from only_one(keys, ("count", "fraction"))

    def wrong_values(self) -> Iterator[Wrong]:
        """All disks find a place."""
        key = "count" if self.fraction is None else "fraction"
        if self.smallest is not None and self.smallest > self.radius:
            most = f"must be at most radius ({self.radius:g} m)"
            yield ("smallest",), f"{most} (got {self.smallest:g} m)"
            return
        if not self.radii:
            yield ("fraction",), f"is less than one disk fills (got {self.fraction:g})"
        elif len(self.radii) > MOST:
            yield ("fraction",), f"makes more than {MOST} disks; take larger ones"
        elif self._is_hopeless():
            yield (key,), self._excess(getattr(self, key))
        elif len(self.disks) < len(self.radii):
            yield (key,), self._lack(getattr(self, key))

    def _is_hopeless(self) -> bool:
        """Return whether disks nearly alike would fill more than random throws ever can."""
        return min(self.radii) > ALIKE * max(self.radii) and self._share() > JAMMED

    def _excess(self, wanted: float) -> str:
        """Return what to say of more disks than random throws find room for."""
        disks = "1 disk" if len(self.radii) == 1 else f"{len(self.radii)} disks"
        return (
            f"can not be reached: {disks} of this size would fill {self._share():.3f} of the "
            f"region (got {wanted:g}); disks thrown at random jam near 0.5"
        )

    def _share(self) -> float:
        return sum(pi * radius**2 for radius in self.radii) / self.inside.outline().area

    def _lack(self, wanted: float) -> str:
        """Return what to say of disks that found no room."""
        share = sum(disk.outline().area for disk in self.pieces()) / self.inside.outline().area
        return (
            f"can not be reached: {len(self.disks)} of {len(self.radii)} disks found room, a "
            f"fraction of {share:.3f} (got {wanted:g}); disks thrown at random jam near 0.5: take "
            "fewer, smaller ones or another seed"
        )

    def count_pieces(self):
        """Return the number of disks, without throwing them."""
        return len(self.radii)

    def pieces(self) -> tuple[Shape, ...]:
        """Return the disks."""
        return tuple(Disk(center=(x, y), radius=radius) for x, y, radius in self.disks)

    def moved(self, way):
        """Return the same disks elsewhere: thrown there, they might round to other places."""
        return Union(of=self.pieces()).moved(way)

    @cached_property
    def disks(self) -> list[tuple[float, float, float]]:
        """Centre and radius (m) of those disks that find a place."""
        return scatter(self.inside.outline(), self.radii, self.gap, Random(self.seed))

    @cached_property
    def radii(self) -> list[float]:
        """Radii of the disks (m), largest first: so they find room more easily."""
        random, found = Random(f"radii {self.seed}"), []
        low = self.radius if self.smallest is None else self.smallest
        if self.count is not None:
            found = [low + (self.radius - low) * random.random() for _ in range(self.count)]
            return sorted(found, reverse=True)
        left = self.fraction * self.inside.outline().area
        while len(found) <= MOST:
            radius = low + (self.radius - low) * random.random()
            left -= pi * radius**2
            if left < -0.5 * pi * radius**2:  # without it they are nearer to the fraction
                break
            found.append(radius)
        return sorted(found, reverse=True)
