"""Compare two results: which numbers are not alike, where, and by how much.

In a test of your own:

    from cramp_cli.study.compare import assert_alike

    def test_my_beam():
        assert_alike("beam.reference", "beam.run", rtol=1e-6)
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

import numpy as np

from cramp_cli.study.columns import Columns, at_times_of, files_of, read_columns

RTOL = 5.5e-6
FLOOR = 1e-10  # share of the largest number of a column that counts as nothing


class Tolerance(NamedTuple):
    """How far a number may be from its reference: rtol |reference| + atol; inf: any distance."""

    rtol: float = RTOL
    atol: float | None = None  # None: FLOOR times the largest number of the column


class Difference(NamedTuple):
    """A column in which numbers are not alike; the one that is furthest off stands for all."""

    file: str
    column: str
    place: str  # line, step and time of that number, or what is wrong with the whole column
    reference: float | str | None = None
    new: float | str | None = None
    off: float | None = None  # |new - reference|
    allowed: float | None = None
    count: int = 0  # numbers of the column that are off

    def __str__(self) -> str:
        name = f"{self.file}: {self.column}" if self.column else self.file
        if self.reference is None:
            return f"{name}: {self.place}"
        text = f"{name}, {self.place}: {self.reference!r} became {self.new!r}"
        if self.off is not None:
            text += f", off by {self.off:.3g} ({self.allowed:.3g} allowed)"
        return text + (f"; {self.count} values of this column are off" if self.count > 1 else "")


@dataclass
class Report:
    """What a comparison found."""

    differences: list[Difference] = field(default_factory=list)
    values: int = 0  # compared

    @property
    def alike(self) -> bool:
        """Whether nothing differs."""
        return not self.differences

    def __str__(self) -> str:
        if self.alike:
            return f"{self.values} values are alike"
        head = f"{self.values} values compared; not alike:"
        return "\n".join([head, *(f"  {difference}" for difference in self.differences)])

    def as_json(self) -> dict:
        """Return the report as plain data."""
        found = [difference._asdict() for difference in self.differences]
        return {"alike": self.alike, "values": self.values, "differences": found}


def compare(
    reference: str | Path,
    new: str | Path,
    *,
    rtol: float = RTOL,
    atol: float | None = None,
    columns: Mapping[str, Tolerance] | None = None,
    interpolate: bool = False,
) -> Report:
    """Return how two runs, or two CSV or HDF5 files, differ.

    reference, new: folders of runs, or files
    rtol, atol: how far a number may be off, see Tolerance
    columns: tolerances of single columns, by name (of HDF5 data: the last part of the place)
    interpolate: compare tables at the times of the reference, linearly between the rows of the new
    raises: FolderError when something can not be read
    """
    ours, theirs = files_of(Path(reference)), files_of(Path(new))
    if len(ours) == len(theirs) == 1:  # two files may have any names
        theirs = dict(zip(ours, theirs.values(), strict=True))
    report, usual = Report(), Tolerance(rtol, atol)
    for name in dict.fromkeys([*ours, *theirs]):
        if name not in ours or name not in theirs:
            which = new if name in ours else reference
            report.differences.append(Difference(name, "", f"is missing in {which}"))
            continue
        pair = read_columns(ours[name]), read_columns(theirs[name])
        _compare_files(report, *pair, usual, columns or {}, interpolate)
    return report


def assert_alike(reference: str | Path, new: str | Path, **options) -> None:
    """Raise AssertionError with the whole report unless two results are alike; see `compare`."""
    report = compare(reference, new, **options)
    if not report.alike:
        raise AssertionError(str(report))


def _compare_files(report, reference: Columns, new: Columns, usual, columns, interpolate) -> None:
    if interpolate and reference.is_table and "time" in reference.columns:
        new = at_times_of(reference, new)
    else:
        report.differences += _missing(reference, new)
    for name in [name for name in reference.columns if name in new.columns]:
        tolerance = columns.get(name) or columns.get(name.split("/")[-1]) or usual
        ours, theirs = reference.columns[name], new.columns[name]
        report.values += ours.size
        report.differences += _compare_column(reference, name, ours, theirs, tolerance)


def _missing(reference: Columns, new: Columns) -> Iterator[Difference]:
    """Yield the rows, columns and groups that only one of two files has."""
    file = reference.name
    if reference.is_table and reference.rows != new.rows:
        yield Difference(file, "", f"has {new.rows} rows, the reference {reference.rows}")
    for where, some, others in (("new result", reference, new), ("reference", new, reference)):
        names = [name for name in some.columns if name not in others.columns]
        for name in dict.fromkeys(_part(reference, name) for name in names):
            yield Difference(file, name, f"is missing in the {where}")


def _part(results: Columns, name: str) -> str:
    """Return what is named when it is missing: a column, or a whole group such as a frame."""
    return name if results.is_table else name.split("/")[0].split("@")[0]


def _compare_column(
    reference: Columns, name: str, ours: np.ndarray, theirs: np.ndarray, tolerance: Tolerance
) -> Iterator[Difference]:
    if ours.shape != theirs.shape and not reference.is_table:
        shapes = f"has {_shape(theirs)} values, the reference {_shape(ours)}"
        yield Difference(reference.name, name, shapes)
        return
    common = min(len(ours), len(theirs))
    a, b = ours[:common].ravel(), theirs[:common].ravel()
    if "U" in (a.dtype.kind, b.dtype.kind):
        wrong = np.flatnonzero(a.astype(str) != b.astype(str))
        if len(wrong):
            row, count = int(wrong[0]), len(wrong)
            place = reference.place(name, row)
            yield Difference(reference.name, name, place, str(a[row]), str(b[row]), count=count)
        return
    off, allowed = _distance(a.astype(float), b.astype(float), tolerance)
    wrong = np.flatnonzero(~(off <= allowed))
    if len(wrong):
        row = int(wrong[np.argmax(_excess(off[wrong], allowed[wrong]))])
        values = float(a[row]), float(b[row]), float(off[row]), float(allowed[row])
        yield Difference(reference.name, name, reference.place(name, row), *values, len(wrong))


def _distance(a: np.ndarray, b: np.ndarray, tolerance: Tolerance) -> tuple[np.ndarray, np.ndarray]:
    """Return how far numbers are from their reference and how far they may be."""
    finite = np.abs(a[np.isfinite(a)])
    atol = FLOOR * finite.max(initial=0.0) if tolerance.atol is None else tolerance.atol
    with np.errstate(invalid="ignore"):
        off = np.abs(b - a)
    off[(a == b) | (np.isnan(a) & np.isnan(b))] = 0.0
    off[np.isnan(a) != np.isnan(b)] = np.inf
    if np.isinf(tolerance.rtol):
        return off, np.full(len(a), np.inf)
    return off, np.where(np.isfinite(a), tolerance.rtol * np.abs(a), 0.0) + atol


def _excess(off: np.ndarray, allowed: np.ndarray) -> np.ndarray:
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(np.isfinite(off), off / allowed, np.inf)


def _shape(values: np.ndarray) -> str:
    return " x ".join(map(str, values.shape))
