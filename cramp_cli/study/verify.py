"""Decks against theory and papers: which numbers they give, how far off, and whether they changed.

Every deck that has an expectation beside it (inputs/*.expect.yaml, inputs/verification/) is a case;
`cramp_cli/deck/expect.py` says what an expectation holds.
"""

import datetime
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
import yaml

from cramp_cli.deck.expect import ENDING, Entry, Expectation, read_expectation
from cramp_cli.output.atomic import write_text
from cramp_cli.output.exits import FolderError
from cramp_cli.output.tables import number
from cramp_cli.schema.section import unknown
from cramp_cli.study.results import Columns, by_tip, read_table, unit_of
from cramp_cli.study.templates import template_folder

EFFORTS = {"quick": ("quick",), "usual": ("quick", "usual"), "full": ("quick", "usual", "full")}
NOTHING = 1e-4  # percent; smaller errors are told as below it
HEAD = "# Expected numbers of a deck; cramp_cli/deck/expect.py says what the keys mean.\n"


class Finding(NamedTuple):
    """One number of a run beside what it should be."""

    case: str
    what: str  # such as "K_I, notch end"
    unit: str
    value: float  # found; for a curve the rms distance over its peak
    reference: float | None  # None for a curve, and where there is no bound
    error: float | None  # distance from the reference, from the curve
    within: float | None  # allowed
    aim: float | None
    size: float  # errors are told as shares of it; 0 if there is nothing to take a share of
    frozen: float | None  # what this program gave before
    changed: bool  # from the frozen value, by more than is allowed
    source: str

    @property
    def outside(self) -> bool:
        """Whether the number is out of its bound; a number that is not finite is."""
        return self.within is not None and not self.error <= self.within

    @property
    def verdict(self) -> str:
        """One word on it."""
        if self.outside:
            return "off"
        if self.frozen is None:
            return "new"
        return "changed" if self.changed else "pass"

    @property
    def passed(self) -> bool:
        """Whether the number is right and as it was."""
        return self.verdict == "pass"

    def as_json(self) -> dict:
        """Return it as plain data."""
        return self._asdict() | {"verdict": self.verdict}


def cases() -> dict[str, Path]:
    """Return the files of all expectations by the name of the case."""
    folder = template_folder()
    paths = sorted([*folder.glob(f"*{ENDING}"), *folder.glob(f"verification/*{ENDING}")])
    return {path.name.removesuffix(ENDING): path for path in paths}


def chosen(names: Sequence[str], effort: str = "usual") -> list[Expectation]:
    """Return the cases that are named, or else all that an effort holds.

    Raises FolderError for an unknown name, DeckError for a wrong file.
    """
    known = cases()
    for name in names:
        if name not in known:
            raise FolderError(unknown("case", name, known))
    read = [read_expectation(known[name]) for name in names or known]
    return [one for one in read if names or one.effort in EFFORTS[effort]]


def judge(expectation: Expectation, run: Path) -> list[Finding]:
    """Return what a run gave beside what was expected of it.

    Raises DeckError for a column, tip or curve that there is not.
    """
    tables = {name: read_table(run / name) for name in ("cracks.csv", "history.csv")}
    tips = by_tip(tables["cracks.csv"])
    findings = []
    for place, entry in enumerate(expectation.numbers):
        path = ("numbers", place)
        rows = tables[entry.table]
        if entry.tip is not None:
            rows = _known(expectation, (*path, "tip"), "tip", entry.tip, tips)
        _known(expectation, (*path, "column"), "column", entry.column, rows)
        findings.append(_finding(expectation, path, entry, rows))
    return findings


def _known(expectation: Expectation, path, what: str, name: str, among: dict):
    """Return an entry of a dictionary; blame the line of the expectation that names no entry."""
    if name not in among:
        raise _blamed(expectation, path, unknown(what, name, among))
    return among[name]


def _blamed(expectation: Expectation, path, message: str) -> Exception:
    from cramp_cli.schema.mistake import DeckError

    return DeckError([expectation.mistake(path, message)])


def _finding(expectation: Expectation, path, entry: Entry, rows: Columns) -> Finding:
    if entry.curve:
        time, values, curve, peak = compared(expectation, path, entry, rows)
        value = error = float(np.sqrt(np.mean((values - curve) ** 2))) / peak
    else:
        value = float(rows[entry.column][-1])
        error = None if entry.reference is None else abs(value - entry.reference)
    allowed = entry.atol + entry.rtol * max(abs(entry.value or 0.0), entry.share_of or 0.0)
    return Finding(
        case=expectation.name,
        what=", ".join(filter(None, (entry.column, entry.tip))),
        unit="1" if entry.curve else unit_of(entry.column),
        value=value,
        reference=entry.reference,
        error=error,
        within=entry.within,
        aim=entry.aim,
        size=1.0 if entry.curve else entry.share_of or abs(entry.reference or 0.0),
        frozen=entry.value,
        changed=entry.value is None or not abs(value - entry.value) <= allowed,
        source=entry.source or "",
    )


def compared(expectation: Expectation, path, entry: Entry, rows: Columns):
    """Return times, computed values and the curve at those times, and the peak of the curve.

    The curve is taken linearly between its points.
    """
    wanted = entry.curve
    table = read_table(expectation.path.parent / wanted.file)
    if not table:
        raise _blamed(expectation, (*path, "curve", "file"), f"{wanted.file}: no such file")
    where = (*path, "curve")
    curve = _known(expectation, where, "column", entry.column, table)
    other = _known(expectation, where, "column", wanted.peak or entry.column, table)
    inside = (table["time"] >= wanted.start) & (table["time"] <= wanted.until)
    peak = abs(wanted.scale) * float(np.abs(other[inside]).max(initial=0.0))
    inside = (rows["time"] >= wanted.start) & (rows["time"] <= wanted.until)
    if not inside.any() or peak == 0.0:
        raise _blamed(expectation, where, "holds no sample of the run, or a curve that is zero")
    time = rows["time"][inside]
    expected = wanted.scale * np.interp(time, table["time"], curve)
    return time, rows[entry.column][inside], expected, peak


def freeze(expectation: Expectation, findings: Iterable[Finding]) -> Expectation:
    """Write the numbers found as those that later versions must give; return what is written.

    Raises FolderError, and writes nothing, while a bound is not kept.
    """
    findings = list(findings)
    for one in findings:
        if one.outside:
            told = f"{one.what}: {number(one.value)} is out of its bound ({one.source})"
            raise FolderError(f"{expectation.path}: not frozen; {told}")
    data = yaml.safe_load(expectation.path.read_text(encoding="utf-8"))
    for entry, one in zip(data["numbers"], findings, strict=True):
        entry["value"] = one.value
    data["frozen"] = datetime.date.today().isoformat()
    write_text(expectation.path, HEAD + yaml.safe_dump(data, sort_keys=False, width=96))
    return read_expectation(expectation.path)


def row(one: Finding) -> list[str]:
    """Return the cells of a finding: number, measured, reference, error, bound, aim, verdict."""
    errors = [_error(x, one.size) for x in (one.error, one.within, one.aim)]
    if one.reference is None and one.within is not None:
        return [one.what, "over time", "curve", *errors, one.verdict]
    return [one.what, number(one.value), number(one.reference), *errors, one.verdict]


def _error(value: float | None, size: float) -> str:
    """Return a distance as a share of a size, or as it is where there is none."""
    if value is None or not size:
        return number(value)
    share = 100.0 * value / size
    return f"< {NOTHING:g} %" if share < NOTHING else f"{share:.2g} %"


COLUMNS = ("case", "number", "measured", "reference", "error", "bound", "aim", "")


def table(findings: Iterable[Finding]) -> str:
    """Return the table of all findings, a line each; a case is named once."""
    lines, last = [COLUMNS], ""
    for one in findings:
        lines.append(("" if one.case == last else one.case, *row(one)))
        last = one.case
    widths = [max(len(line[n]) for line in lines) for n in range(len(COLUMNS))]
    return "\n".join(_aligned(line, widths).rstrip() for line in lines)


def _aligned(line: Sequence[str], widths: Sequence[int]) -> str:
    cells = zip(line, widths, strict=True)
    return "  ".join(f"{c:{w}}" if n < 2 else f"{c:>{w}}" for n, (c, w) in enumerate(cells))
