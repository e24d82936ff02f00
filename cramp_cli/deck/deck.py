"""A whole deck: its sections, and every mistake of it in one answer."""

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, Field, PrivateAttr, ValidationError

from cramp_cli.deck.bodies import BodySection, GridSection
from cramp_cli.deck.boundary import BoundarySection
from cramp_cli.deck.checks import geometry_mistakes, name_mistakes, too_many_mistakes
from cramp_cli.deck.contact import AnyContact, ContactSection
from cramp_cli.deck.contact_groups import contact_mistakes
from cramp_cli.deck.crack_checks import crack_warnings
from cramp_cli.deck.cracks import CrackSection
from cramp_cli.deck.each import as_written, each_apart, each_mistakes
from cramp_cli.deck.ends import choose_ends, end_mistakes
from cramp_cli.deck.events import event_mistakes
from cramp_cli.deck.files import digests
from cramp_cli.deck.growth_checks import growth_mistakes
from cramp_cli.deck.lattice import Box
from cramp_cli.deck.line_checks import ligament_warnings
from cramp_cli.deck.loads import AnyLoad
from cramp_cli.deck.materials import AnyMaterial
from cramp_cli.deck.overrides import apply_overrides
from cramp_cli.deck.parts import parts_of, salvage
from cramp_cli.deck.plausible import plausible_warnings
from cramp_cli.deck.propagation import InterfaceSection, PropagationSection
from cramp_cli.deck.rest import rest_mistakes
from cramp_cli.deck.ring_checks import ring_mistakes
from cramp_cli.deck.run import FractureSection, OutputSection, SolverSection
from cramp_cli.deck.solids import Isotropic
from cramp_cli.deck.thin import thin_warnings
from cramp_cli.deck.write import to_yaml
from cramp_cli.schema.explain import explain
from cramp_cli.schema.loader import read_source
from cramp_cli.schema.mistake import DeckError, Mistake, Source
from cramp_cli.schema.section import Count, Name, Section, Wrong
from cramp_cli.schema.units import Length, complaint

__all__ = ["Deck", "DeckError", "Mistake", "read_deck", "to_yaml"]

FORMAT = 1
NEARLY_INCOMPRESSIBLE = 0.48  # Poisson's ratio; J of a tip is doubtful then (cracks/doubts.py)


def _format(version: int) -> int:
    if version != FORMAT:
        raise complaint(f"this program reads deck format {FORMAT}", version)
    return version


class Deck(Section):
    """What is simulated, how, and what is written. Plain numbers are in SI."""

    cramp: Annotated[Count, AfterValidator(_format)] = Field(description="format of the deck: 1")
    title: str = Field("", max_length=1000, description="one line about it")
    analysis: Literal["plane_strain", "plane_stress", "axisymmetric"] = Field(
        description="state of the direction across the plane; axisymmetric: x is the radius, y the "
        "axis, and forces and energies are those of whole rings"
    )
    thickness: Length = Field(1.0, gt=0, description="thickness across the plane")
    grid: GridSection = Field(description="background grid")
    materials: dict[Name, AnyMaterial] = Field(min_length=1, description="materials by name")
    bodies: tuple[BodySection, ...] = Field(min_length=1, description="bodies and holes, in order")
    cracks: tuple[CrackSection, ...] = Field((), description="cracks")
    contact: ContactSection = Field(
        default_factory=ContactSection, description="contact of crack faces and of bodies"
    )
    boundary: tuple[BoundarySection, ...] = Field((), description="prescribed motion")
    loads: tuple[AnyLoad, ...] = Field((), description="forces, tractions, gravity")
    solver: SolverSection = Field(description="time steps")
    fracture: FractureSection = Field(
        default_factory=FractureSection, description="J, K_I and K_II at the tips"
    )
    interfaces: tuple[InterfaceSection, ...] = Field(
        (), description="bonds between materials along which a crack may run"
    )
    propagation: PropagationSection | None = Field(
        None, description="when, where to and how fast cracks grow; they do not if not given"
    )
    output: OutputSection = Field(default_factory=OutputSection, description="what is written")

    _source: Source = PrivateAttr(default_factory=lambda: Source("deck"))
    _folder: Path = PrivateAttr(default_factory=Path)
    _numbers: tuple[int, ...] = PrivateAttr(())  # of the bodies, as the deck was written
    _warnings: list[Mistake] = PrivateAttr(default_factory=list)

    @property
    def source_text(self) -> str:
        """The deck as it was written."""
        return self._source.text

    @property
    def folder(self) -> Path:
        """The folder that paths in the deck start from."""
        return self._folder

    @property
    def warnings(self) -> list[Mistake]:
        """What is possible but seldom meant."""
        return self._warnings

    def mistake(self, path: Iterable[str | int], message: str) -> Mistake:
        """Return a mistake at a path of keys, such as ("cracks", 0, "start")."""
        return self._source.mistake(*as_written((tuple(path), message), self._numbers))

    def file_digests(self) -> dict[str, str]:
        """Return the SHA-256 of every file that the deck names, by its name there."""
        return digests(self._source.data, self._folder)

    def lattice_box(self) -> Box:
        """Return lower and upper corner (m) of the grid and its cells along each axis."""
        return parts_of(self).box()

    def contact_of(self, crack: CrackSection) -> AnyContact:
        """Return the contact law of a crack's faces."""
        return crack.contact or self.contact.cracks

    def resolved(self) -> dict[str, Any]:
        """Return the deck with all defaults, as plain data that reads back to the same deck."""
        data = self.model_dump(mode="json", by_alias=True, exclude_none=True)
        if self.grid.lower is not None:
            del data["grid"]["margin"]
        return data


def read_deck(path: str | Path, overrides: Iterable[str] = ()) -> Deck:
    """Read and check a deck; `overrides` are settings such as `solver.cfl=0.3`.

    Raises DeckError with every mistake, or OSError when the file cannot be read.
    """
    source = read_source(str(path))
    if source.data is None and not source.mistakes:
        raise DeckError([source.mistake((), "the deck is empty; it begins with 'cramp: 1'")])
    if not isinstance(source.data, dict):
        message = "a deck is a list of sections such as 'grid: {cell: 1 mm}'"
        raise DeckError([source.mistake((), message)])
    apply_overrides(source, list(overrides))
    return check_deck(source, Path(path).resolve().parent)


def check_deck(source: Source, folder: Path) -> Deck:
    """Return the deck that the data of a source stands for, or raise all its mistakes."""
    data, found, deck = source.data, list(source.mistakes), None
    try:
        deck = Deck.model_validate(data, context={"folder": folder})
        parts = parts_of(deck)
    except ValidationError as failure:
        found += [source.mistake(*error) for error in explain(failure, data)]
        parts = salvage(data, folder)
    if many := [source.mistake(*one) for one in too_many_mistakes(parts)]:
        raise DeckError(found + many)
    wrong = [*name_mistakes(data), *geometry_mistakes(parts)]
    if deck is not None:
        wrong += each_mistakes(deck)
        deck, numbers = each_apart(deck)
        between = list(end_mistakes(deck))
        deck = choose_ends(deck)
        rules = (growth_mistakes, contact_mistakes, ring_mistakes, event_mistakes, rest_mistakes)
        between += [one for rule in rules for one in rule(deck)]
        wrong += [as_written(one, numbers) for one in between]
    found += [source.mistake(*one) for one in wrong]
    if found or deck is None:
        raise DeckError(found)
    deck = _filled(deck)
    deck._source, deck._folder, deck._numbers = source, folder, numbers
    deck._warnings = [source.mistake(*as_written(one, numbers)) for one in _warnings(deck)]
    return deck


def _filled(deck: Deck) -> Deck:
    """Return the deck with those defaults that depend on other sections."""
    every = deck.output.every or deck.solver.end_time / 100.0
    times = {"every": every, "history_every": deck.output.history_every or every / 10.0}
    fracture = {"every": deck.fracture.every or every}
    pieces = [crack.segment or deck.grid.cell / 2.0 for crack in deck.cracks]
    cracks = zip(deck.cracks, pieces, strict=True)
    growth = deck.propagation
    if growth is not None:
        growth = growth.model_copy(update={"piece": growth.piece or deck.grid.cell / 2.0})
    update = {
        "propagation": growth,
        "output": deck.output.model_copy(update=times),
        "fracture": deck.fracture.model_copy(update=fracture),
        "cracks": tuple(crack.model_copy(update={"segment": piece}) for crack, piece in cracks),
    }
    return deck.model_copy(update=update)


def _warnings(deck: Deck) -> Iterator[Wrong]:
    yield from crack_warnings(parts_of(deck))
    yield from ligament_warnings(parts_of(deck))
    yield from thin_warnings(deck)
    yield from plausible_warnings(deck)
    if deck.solver.may_be_unstable:
        better = deck.solver.strain.replace("-", "+")
        message = f"may grow without bound with {deck.solver.update}; use '{better}'"
        yield ("solver", "strain"), f"'{deck.solver.strain}' {message} or a smaller cfl"
    if deck.solver.tears_domains:
        solver = f"{deck.solver.update} and {deck.solver.strain}"
        message = f"'cpdi' may tear a solid that is drawn far out with {solver}"
        yield ("solver", "shape"), f"{message}; use update: flip and strain: usavg-"
    for name, material in deck.materials.items():
        stiff = isinstance(material, Isotropic) and material.poisson >= NEARLY_INCOMPRESSIBLE
        if deck.analysis != "plane_stress" and stiff:
            key = "nu" if getattr(material, "nu", None) is not None else "K"
            message = f"nearly incompressible (nu = {material.poisson:.6g}): stresses may lock"
            yield ("materials", name, key), message
        if name not in {body.material for body in deck.bodies}:
            yield ("materials", name), "is used by no body"
