"""Where something acts: a box, or a plane when a coordinate is a single number."""

from collections.abc import Iterator
from typing import Annotated, Any

from pydantic import BeforeValidator, Field, PlainSerializer, WithJsonSchema

from cramp_cli.schema.section import Section, Wrong
from cramp_cli.schema.units import Length

AXES = ("x", "y")


def _as_range(value: Any) -> Any:
    return value if isinstance(value, list | tuple) else [value, value]


def _shortest(span: tuple[float, float]) -> float | list[float]:
    return span[0] if span[0] == span[1] else list(span)


_NUMBER = {"anyOf": [{"type": "number"}, {"type": "string"}]}
Span = Annotated[
    tuple[Length, ...],
    Field(min_length=2, max_length=2),
    BeforeValidator(_as_range),
    PlainSerializer(_shortest),
    WithJsonSchema(
        {
            "title": "length (SI: m) or [low, high]",
            "anyOf": [*_NUMBER["anyOf"], {"type": "array", "items": _NUMBER, "maxItems": 2}],
        }
    ),
]


class Where(Section):
    """A box; a coordinate that is one number makes it a plane, one that is left out is free."""

    x: Span | None = Field(None, description="one x (plane) or [lowest, highest]")
    y: Span | None = Field(None, description="one y (plane) or [lowest, highest]")

    @classmethod
    def wrong_keys(cls, keys: set[str]) -> Iterator[Wrong]:
        """It must say something."""
        if not keys & set(AXES):
            yield (), "give x or y or both"

    def wrong_values(self) -> Iterator[Wrong]:
        """Ranges go upwards."""
        for axis in AXES:
            span = getattr(self, axis)
            if span and span[1] < span[0]:
                yield (axis, 1), f"must not be below {span[0]:g} m (got {span[1]:g} m)"

    def span(self, axis: int) -> tuple[float, float] | None:
        """Return lowest and highest coordinate (m) along an axis (0, 1), None when it is free."""
        return (self.x, self.y)[axis]

    @property
    def planes(self) -> tuple[tuple[int, float], ...]:
        """Axis (0, 1) and coordinate (m) of each plane."""
        spans = ((axis, self.span(axis)) for axis in range(len(AXES)))
        return tuple((axis, span[0]) for axis, span in spans if span and span[0] == span[1])

    def contains(self, points, tolerance: float):
        """Return which (n, 2) points (m) lie in it, as (n,) booleans, `tolerance` (m) included."""
        inside = points[:, 0] == points[:, 0]
        for axis in range(len(AXES)):
            span = self.span(axis)
            if span:
                inside &= points[:, axis] >= span[0] - tolerance
                inside &= points[:, axis] <= span[1] + tolerance
        return inside
