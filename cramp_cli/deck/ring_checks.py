"""Mistakes of a deck in a body of revolution: x is the radius, y the axis."""

from collections.abc import Iterator
from typing import Any

from cramp_cli.deck.bodies import FIT
from cramp_cli.schema.section import Wrong


def ring_mistakes(deck: Any) -> Iterator[Wrong]:
    """Yield what an axisymmetric deck can not hold; deck: right in its sections by themselves."""
    if deck.analysis != "axisymmetric":
        return
    if deck.thickness != 1.0:
        yield ("thickness",), "must be left out: a ring goes all the way round"
    if deck.propagation is not None:
        yield ("propagation",), "is not made for analysis: axisymmetric; cracks can not grow there"
    if deck.contact.bodies is not None:
        yield (
            ("contact", "bodies"),
            "does not go with analysis: axisymmetric; bodies are glued",
        )
    for place, crack in enumerate(deck.cracks):
        if crack.traction is not None:
            yield ("cracks", place, "traction"), "is not made for analysis: axisymmetric"
    least = -FIT * deck.grid.cell
    for place, body in enumerate(deck.bodies):
        left = body.shape.bounds()[0][0]
        if not body.hole and left < least:
            yield ("bodies", place, "shape"), f"{_beyond_axis(left)}; cut it off there"
        if body.angular_velocity:
            message = "must be 0: a ring can not turn in the plane of its section"
            yield ("bodies", place, "angular_velocity"), message
    for place, crack in enumerate(deck.cracks):
        left = min(x for x, _ in crack.corners)
        if left < least:
            yield ("cracks", place), f"{_beyond_axis(left)}; end it there"
    for place, load in enumerate(deck.loads):
        if load.type == "gravity" and load.acceleration[0]:
            message = "must be 0 along x: away from the axis is another direction at every place"
            yield ("loads", place, "acceleration"), message


def _beyond_axis(x) -> str:
    return f"reaches beyond the axis, x = 0 (to x = {x:.6g} m)"
