"""What a deck is expected to give: numbers and curves, each beside a bound from theory or papers.

`inputs/<name>.expect.yaml` belongs to the deck beside it, or names another one. `value` is what
this program computed on the day in `frozen`, and `rtol` how near a later version must come;
`reference`, `within` and `source` bound it by something that is not this program. `aim` is what we
are after and do not demand. For a curve the number is the rms distance from it, as a share of its
peak.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import Literal

from pydantic import Field, PrivateAttr

from cramp_cli.schema.explain import checked
from cramp_cli.schema.loader import read_source
from cramp_cli.schema.mistake import DeckError, Mistake, Source
from cramp_cli.schema.section import Section, Wrong
from cramp_cli.schema.units import Time

ENDING = ".expect.yaml"
Effort = Literal["quick", "usual", "full"]


class ReferenceCurve(Section):
    """A curve over time that a column of a run is compared with."""

    file: str = Field(description="CSV with `time` and columns named as ours, in SI")
    start: Time = Field(alias="from", description="begin of the comparison")
    until: Time = Field(description="its end")
    scale: float = Field(1.0, description="what the curve is multiplied by")
    peak: str | None = Field(None, description="column whose peak counts; the same if not given")

    def wrong_values(self) -> Iterator[Wrong]:
        """Time goes on."""
        if self.until <= self.start:
            yield ("until",), f"must be after `from` ({self.start:g} s) (got {self.until:g} s)"


class Entry(Section):
    """One number of a run: in the last row of a table, or a distance from a curve."""

    table: Literal["cracks.csv", "history.csv"] = Field(description="file of the run")
    column: str = Field(description="its column")
    tip: str | None = Field(None, description="in cracks.csv: the tip, as in `notch end`")
    curve: ReferenceCurve | None = Field(None, description="what the column is compared with")
    value: float | None = Field(None, description="what this program gave when it was frozen")
    rtol: float = Field(
        1e-5, ge=0, description="how near a later version comes, relative to `value` or `share_of`"
    )
    atol: float = Field(0.0, ge=0, description="how near at least, in the column's unit")
    reference: float | None = Field(None, description="the number of theory or paper")
    within: float | None = Field(None, gt=0, description="how far from it is right")
    aim: float | None = Field(None, gt=0, description="how far from it we want to be")
    share_of: float | None = Field(None, gt=0, description="errors are told as shares of this")
    source: str | None = Field(None, description="where reference and bound come from")

    def wrong_values(self) -> Iterator[Wrong]:
        """A bound needs a reference and says where it comes from."""
        bounded = self.within is not None
        if self.curve and self.reference is not None:
            yield ("reference",), "goes without curve: the curve is the reference"
        if bounded != bool(self.curve or self.reference is not None):
            yield ("within",), "goes with reference or curve; give both or neither"
        if bounded and not self.source:
            yield ("source",), "is missing; say where the bound comes from"
        if self.aim is not None and not bounded:
            yield ("aim",), "goes with within"
        if (self.tip is not None) != (self.table == "cracks.csv"):
            yield ("tip",), "goes with cracks.csv, and there it is needed"


class Expectation(Section):
    """The numbers of one deck."""

    title: str = Field("", description="what is verified; the title of the deck if not given")
    deck: str | None = Field(None, description="the deck, seen from here; that of the same name")
    settings: tuple[str, ...] = Field((), description="changes of the deck, as after `run -s`")
    effort: Effort = Field("usual", description="when it is run: quick and usual ones by default")
    frozen: str = Field("", description="day of the values")
    numbers: tuple[Entry, ...] = Field(min_length=1, description="what the run must give")

    _source: Source = PrivateAttr(default_factory=lambda: Source("expect"))

    @property
    def path(self) -> Path:
        """The file of this expectation."""
        return Path(self._source.name)

    @property
    def name(self) -> str:
        """The name of the case."""
        return self.path.name.removesuffix(ENDING)

    @property
    def deck_path(self) -> Path:
        """The deck that is run."""
        return self.path.parent / (self.deck or f"{self.name}.yaml")

    def mistake(self, path: tuple[str | int, ...], message: str) -> Mistake:
        """Return a mistake at a path of keys, such as ("numbers", 0, "column")."""
        return self._source.mistake(path, message)


def read_expectation(path: Path) -> Expectation:
    """Read and check what a deck is expected to give.

    Raises DeckError with every mistake, or OSError when the file cannot be read.
    """
    source = read_source(str(path))
    if not isinstance(source.data, dict):
        message = "this file is a list of sections such as 'numbers: [...]'"
        raise DeckError([source.mistake((), message)])
    expectation = checked(Expectation, source)
    expectation._source = source
    return expectation
