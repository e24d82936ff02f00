"""When the loads of a deck have come, and whether a run of it can come to rest."""

from collections.abc import Iterator
from math import isinf
from typing import Any

from pydantic import BaseModel

from cramp_cli.deck.run import AUTO
from cramp_cli.schema.curve import KINDS
from cramp_cli.schema.section import Wrong

CALMED = 1.0  # damping rate times end time; below it a run is not meant to come to rest
CURVES = tuple(KINDS.values())
Path = tuple[str | int, ...]


def is_damped(solver: Any) -> bool:
    """Return whether something in the solver takes motion away."""
    damping = solver.damping
    return damping == AUTO or damping.grid > 0.0 or damping.particle > 0.0


def may_rest(solver: Any) -> bool:
    """Return whether a run can come to rest: by its end damping must have had time to act."""
    damping = solver.damping
    if damping == AUTO or solver.stop_when == "at_rest":
        return True
    return (damping.grid + damping.particle) * solver.end_time >= CALMED


def last_change(deck: Any) -> float:
    """Return the time (s) from which on no load and no prescribed motion changes; inf if never."""
    return max((curve.last_change for _, curve in curves(deck)), default=0.0)


def rest_mistakes(deck: Any) -> Iterator[Wrong]:
    """Yield what keeps a run from coming to rest that shall end there."""
    if deck.solver.stop_when != "at_rest":
        return
    if not is_damped(deck.solver):
        yield ("solver", "stop_when"), "nothing comes to rest without damping; add damping: auto"
    for path, curve in curves(deck):
        if isinf(curve.last_change):
            yield (*path, "cycles"), "is missing: a load that never ends lets nothing come to rest"


def curves(part: Any, path: Path = ()) -> Iterator[tuple[Path, Any]]:
    """Yield the curves over time below a part of a deck, each with its path of keys."""
    if isinstance(part, CURVES):
        yield path, part
    elif isinstance(part, BaseModel):
        for name in type(part).model_fields:
            yield from curves(getattr(part, name), (*path, name))
    elif isinstance(part, tuple | dict):
        items = part.items() if isinstance(part, dict) else enumerate(part)
        for key, value in items:
            yield from curves(value, (*path, key))
