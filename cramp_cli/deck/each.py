"""Bodies of which every piece of the shape is a body of its own: the grains of a packed bed."""

from collections.abc import Iterator
from typing import Any

from cramp_cli.deck.bodies import BodySection
from cramp_cli.schema.section import Wrong


def each_apart(deck: Any) -> tuple[Any, tuple[int, ...]]:
    """Return the deck with a body for every piece, and for each body its number in the deck."""
    bodies = [(number, one) for number, body in enumerate(deck.bodies) for one in _apart(body)]
    numbers, apart = zip(*bodies, strict=True)
    return deck.model_copy(update={"bodies": apart}), numbers


def _apart(body: BodySection) -> list[BodySection]:
    if not body.each:
        return [body]
    pieces = enumerate(body.shape.pieces(), 1)
    return [
        body.model_copy(update={"name": f"{body.name}_{number}", "shape": piece, "each": False})
        for number, piece in pieces
    ]


def as_written(wrong: Wrong, numbers: tuple[int, ...]) -> Wrong:
    """Return a mistake in a body with the number that this body has in the deck."""
    path, message = wrong
    if len(path) > 1 and path[0] == "bodies":
        path = ("bodies", numbers[path[1]], *path[2:])
    return path, message


def each_mistakes(deck: Any) -> Iterator[Wrong]:
    """Yield names that several bodies would have, and loads on a body that is many."""
    whole = {body.name for body in deck.bodies if not body.each}
    many = {body.name: _apart(body) for body in deck.bodies if body.each}
    for place, body in enumerate(deck.bodies):
        taken = whole & {piece.name for piece in many.get(body.name, ())}
        if taken:
            message = f"'{min(taken)}' is taken, and a piece would have it; take another name"
            yield ("bodies", place, "name"), message
    for place, load in enumerate(deck.loads):
        pieces = many.get(getattr(load, "body", None))
        if pieces:
            message = f"'{load.body}' is {len(pieces)} bodies (each: true); load a body of its own"
            yield ("loads", place, "body"), message
