"""What a study says: a base deck, what varies in it, and what is collected from the runs."""

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, Field, PrivateAttr

from cramp_cli.schema.explain import checked
from cramp_cli.schema.loader import read_source
from cramp_cli.schema.mistake import DeckError, Mistake, Source
from cramp_cli.schema.section import Count, Section, Wrong, one_of
from cramp_cli.schema.unit_text import UnitError, base_units, split
from cramp_cli.schema.units import Time, complaint

FORMAT = 1
KIND = "how values are combined"
OVER = "path of keys of the deck, as for `cramp run -s`: "
MOST_CASES = 100_000


def _format(version: int) -> int:
    if version != FORMAT:
        raise complaint(f"this program reads study format {FORMAT}", version)
    return version


Lists = Annotated[dict[str, list[Any]], Field(min_length=1)]


class Grid(Section):
    """Every combination of the values."""

    type: Literal["grid"] = Field("grid", description=KIND)
    over: Lists = Field(description=OVER + "list of values")

    def wrong_values(self) -> Iterator[Wrong]:
        """Each path has values."""
        yield from _empty(self.over)


class Zip(Section):
    """The first values together, then the second ones, and so on."""

    type: Literal["zip"] = Field("zip", description=KIND)
    over: Lists = Field(description=OVER + "list of values, all of the same length")

    def wrong_values(self) -> Iterator[Wrong]:
        """The lists have one length."""
        yield from _empty(self.over)
        first, *others = self.over
        for path in others:
            if len(self.over[path]) != len(self.over[first]):
                counts = f"{len(self.over[path])}, {first} has {len(self.over[first])}"
                yield ("over", path), f"must have as many values as the others (got {counts})"


class Listed(Section):
    """Cases one by one."""

    type: Literal["list"] = Field("list", description=KIND)
    cases: tuple[dict[str, Any], ...] = Field(
        min_length=1, description="for each case: path of keys of the deck: value"
    )


class Range(Section):
    """Where samples are drawn from."""

    first: Any = Field(alias="from", description="lowest value; with its unit where it has one")
    last: Any = Field(alias="to", description="highest value, in the same unit")
    scale: Literal["linear", "log"] = Field("linear", description="spacing of the samples")
    whole: bool = Field(False, description="round to whole numbers")

    def wrong_values(self) -> Iterator[Wrong]:
        """Both ends are numbers of one unit, and the second is the larger."""
        ends = {}
        for key, text in (("from", self.first), ("to", self.last)):
            try:
                ends[key] = quantity_of(text)
            except UnitError as problem:
                yield (key,), f"must be a number, with its unit where it has one: {problem}"
        if len(ends) == 2:
            yield from self._wrong_ends(*ends["from"], *ends["to"])

    def _wrong_ends(self, low, unit, high, other) -> Iterator[Wrong]:
        if unit != other:
            yield (
                ("to",),
                f"must have the unit of `from` ({unit or 'none'}) (got {other or 'none'})",
            )
        elif high <= low:
            yield ("to",), f"must be above `from` ({low:g}) (got {high:g})"
        elif self.scale == "log" and low <= 0.0:
            yield ("from",), f"must be above 0 with scale: log (got {low:g})"

    def value(self, share: float) -> float | int | str:
        """Return the value at a share (0 to 1) of the way from first to last, as a deck has it."""
        low, unit = quantity_of(self.first)
        high, _ = quantity_of(self.last)
        value = low * (high / low) ** share if self.scale == "log" else low + share * (high - low)
        number = round(value) if self.whole else float(f"{value:.9g}")
        return f"{number!r} {unit}" if unit else number


Ranges = Annotated[dict[str, Range], Field(min_length=1)]


class LatinHypercube(Section):
    """Samples that fill each range evenly: one in each of as many equal parts as there are."""

    type: Literal["latin_hypercube"] = Field("latin_hypercube", description=KIND)
    over: Ranges = Field(description=OVER + "range")
    samples: Count = Field(ge=1, le=MOST_CASES, description="number of samples")
    seed: Count = Field(ge=0, description="the same seed draws the same samples")


class Sobol(Section):
    """Samples of a scrambled Sobol sequence: even in all ranges together."""

    type: Literal["sobol"] = Field("sobol", description=KIND)
    over: Ranges = Field(description=OVER + "range")
    samples: Count = Field(ge=1, le=MOST_CASES, description="number of samples, a power of 2")
    seed: Count = Field(ge=0, description="the same seed draws the same samples")

    def wrong_values(self) -> Iterator[Wrong]:
        """Only a power of two keeps the sequence even."""
        if self.samples & (self.samples - 1):
            above = 1 << self.samples.bit_length()
            message = f"must be a power of 2, such as {above // 2} or {above} (got {self.samples})"
            yield ("samples",), message


AnyVary = one_of("type", Grid, Zip, Listed, LatinHypercube, Sobol)


class Reduction(Section):
    """A column of the result: one number from one column of a table of the run."""

    column: str = Field(description="column of cracks.csv, history.csv or growth.csv")
    take: Literal["max", "min", "last", "at"] = Field("last", description="which number")
    time: Time | None = Field(
        None, gt=0, description="for `at`: linearly between the rows around it; nothing beyond them"
    )
    table: Literal["cracks", "history", "growth"] | None = Field(
        None, description="its table; cracks if it has the column, else history"
    )
    tip: str | None = Field(None, description="only this tip, as in `notch end`; all if not given")

    def wrong_values(self) -> Iterator[Wrong]:
        """A time belongs to `at`."""
        if (self.take == "at") != (self.time is not None):
            yield ("time",), "goes with take: at" if self.time else "is missing; take: at needs it"


USUAL = tuple(
    Reduction(column=column, take=take)
    for column in ("K_I", "K_II", "J")
    for take in ("max", "last")
) + (Reduction(column="energy_error"),)


class Study(Section):
    """Many runs from one deck."""

    cramp_sweep: Annotated[Count, AfterValidator(_format)] = Field(
        description="format of the study: 1"
    )
    title: str = Field("", max_length=1000, description="one line about it")
    deck: str = Field(description="the base deck, seen from the folder of the study")
    settings: dict[str, Any] = Field(
        default_factory=dict, alias="set", description="changes of the deck for all cases"
    )
    vary: tuple[AnyVary, ...] = Field(
        min_length=1, description="what varies; of several entries every combination is run"
    )
    timeout: Time | None = Field(
        None, gt=0, description="a case that takes longer on the clock is ended and called hung"
    )
    collect: tuple[Reduction, ...] = Field(
        USUAL, description="columns of the result; K_I, K_II and J of all tips if not given"
    )

    _source: Source = PrivateAttr(default_factory=lambda: Source("study"))
    _folder: Path = PrivateAttr(default_factory=Path)

    def mistake(self, path: tuple[str | int, ...], message: str) -> Mistake:
        """Return a mistake at a path of keys, such as ("collect", 0, "column")."""
        return self._source.mistake(path, message)

    @property
    def deck_path(self) -> Path:
        """Where the base deck is."""
        return self._folder / self.deck


def read_study(path: str | Path) -> Study:
    """Read and check a study.

    Raises DeckError with every mistake, or OSError when the file cannot be read.
    """
    source = read_source(str(path))
    if not isinstance(source.data, dict):
        message = "a study is a list of sections such as 'deck: plate.yaml'"
        raise DeckError([source.mistake((), message)])
    study = checked(Study, source)
    study._source, study._folder = source, Path(path).parent
    return study


def quantity_of(value: Any) -> tuple[float, str]:
    """Return number and unit of a value of a deck; raise UnitError if it is no number."""
    if isinstance(value, bool) or not isinstance(value, int | float | str):
        raise UnitError(f"got {value!r}")
    if not isinstance(value, str):
        return float(value), ""
    number, unit = split(value)
    base_units(unit)
    return float(number), unit


def _empty(over: dict[str, list]) -> Iterator[Wrong]:
    for path, values in over.items():
        if not values:
            yield ("over", path), "must have at least 1 value"
