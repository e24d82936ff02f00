"""The sections of a deck that are right by themselves, also when others are not."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from cramp_cli.deck.bodies import BodySection, GridSection
from cramp_cli.deck.boundary import BoundarySection
from cramp_cli.deck.cracks import CrackSection
from cramp_cli.deck.lattice import Box, lattice_box


@dataclass
class Parts:
    """What checks between sections need; entries of lists with their index in the deck."""

    grid: GridSection | None
    bodies: list[tuple[int, BodySection]] = field(default_factory=list)
    cracks: list[tuple[int, CrackSection]] = field(default_factory=list)
    boundary: list[tuple[int, BoundarySection]] = field(default_factory=list)
    all_bodies: bool = True  # False when a body had mistakes and is left out

    @property
    def solids(self) -> list[tuple[int, BodySection]]:
        """The bodies that are no holes."""
        return [(place, body) for place, body in self.bodies if not body.hole]

    def box(self) -> Box | None:
        """Return the grid's box if it can be known."""
        if self.grid is None or not self.solids:
            return None
        if self.grid.lower is None and not self.all_bodies:
            return None
        return lattice_box(self.grid, [body.shape.bounds() for _, body in self.solids])


def parts_of(deck: Any) -> Parts:
    """Return the parts of a deck without mistakes."""
    lists = (list(enumerate(part)) for part in (deck.bodies, deck.cracks, deck.boundary))
    return Parts(deck.grid, *lists)


def salvage(data: dict, folder: Path) -> Parts:
    """Return the parts of a deck that has mistakes somewhere."""
    bodies, cracks, boundary = (
        _entries(kind, data.get(key), folder)
        for kind, key in (
            (BodySection, "bodies"),
            (CrackSection, "cracks"),
            (BoundarySection, "boundary"),
        )
    )
    given = data.get("bodies")
    complete = isinstance(given, list) and len(given) == len(bodies)
    grid = _attempt(GridSection, data.get("grid"), folder)
    return Parts(grid, bodies, cracks, boundary, complete)


def _entries(kind: type, entries: Any, folder: Path) -> list:
    entries = entries if isinstance(entries, list) else []
    tried = [(place, _attempt(kind, entry, folder)) for place, entry in enumerate(entries)]
    return [(place, section) for place, section in tried if section is not None]


def _attempt(kind: type, data: Any, folder: Path) -> Any:
    try:
        return kind.model_validate(data, context={"folder": folder})
    except ValidationError:
        return None
