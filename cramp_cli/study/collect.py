"""One row per case: what varied, how it ended, and numbers taken from its tables."""

import csv
import io
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from cramp_cli.deck.sweep import Reduction, Study
from cramp_cli.output.atomic import replaced, write_text
from cramp_cli.output.exits import FolderError
from cramp_cli.output.history import CRACK_COLUMNS, GROWTH_COLUMNS, HISTORY_COLUMNS, MEAN_COLUMNS
from cramp_cli.schema.mistake import DeckError
from cramp_cli.schema.section import unknown
from cramp_cli.schema.unit_text import UnitError, base_units, split
from cramp_cli.study.cases import Case, shown
from cramp_cli.study.columns import between
from cramp_cli.study.outcome import SweepFolder
from cramp_cli.study.results import WORDS, Columns, by_tip, read_table

Row = dict[str, object]
STATUS = "status"  # of a tip: what those rows say from which its numbers are
OF_TIPS = CRACK_COLUMNS | MEAN_COLUMNS
TABLES = {"cracks": OF_TIPS, "history": HISTORY_COLUMNS, "growth": GROWTH_COLUMNS}


def check_columns(study: Study) -> None:
    """Raise DeckError with every reduction whose column is in no table."""
    wrong = []
    for number, one in enumerate(study.collect):
        known = [name for name in TABLES[table_of(one)] if name not in WORDS]
        if one.column not in known and not one.column.startswith("reaction_"):
            message = unknown("column", one.column, known)
            wrong.append(study.mistake(("collect", number, "column"), message))
    if wrong:
        raise DeckError(wrong)


def table_of(one: Reduction) -> str:
    """Return the table of a reduction: cracks if it has the column, else history."""
    return one.table or ("cracks" if one.column in OF_TIPS else "history")


def collect(
    cases: Sequence[Case], folder: SweepFolder, wanted: Sequence[Reduction], wall_time: bool = False
) -> list[Row]:
    """Return a row for every case, in SI; cells that a case has no number for are missing.

    wall_time: with the seconds each case took, which differ from run to run
    """
    rows = []
    for case in cases:
        outcome = folder.outcome(case.name)
        varied = {path: in_si(value) for path, value in case.parameters.items()}
        row: Row = {"case": case.name, **varied, "state": outcome.word}
        row["exit_code"] = outcome.exit_code
        if wall_time:
            row["wall_time"] = outcome.wall_time
        if outcome.word == "done":
            row |= _numbers(folder.run(case.name), wanted)
        rows.append(row)
    return rows


def in_si(value: object) -> object:
    """Return a text such as '5 mm' as a number in SI, any other value of a deck as it is."""
    if not isinstance(value, str):
        return value
    try:
        number, unit = split(value)
        return float(number * base_units(unit)[0]) if unit else value
    except UnitError:
        return value


def _numbers(run: Path, wanted: Sequence[Reduction]) -> Row:
    """Return the columns of all reductions, and for each tip what the status of their rows says."""
    numbers: Row = {}
    statuses: dict[str, list[str]] = {}
    for one in wanted:
        for tip, table in _tables(run, one).items():
            numbers[_name(tip, one)], used = _take(table, one)
            if "status" in table:
                name = f"{tip.replace(' ', '_')}.{STATUS}"
                statuses.setdefault(name, []).extend(table["status"][used].tolist())
    return numbers | {name: _told(several) for name, several in statuses.items()}


def _tables(run: Path, one: Reduction) -> dict[str, Columns]:
    """Return the table of a reduction for each of its tips; that of the history without a name."""
    source = table_of(one)
    table = read_table(run / f"{source}.csv")
    if source == "history":
        if one.column not in table:
            raise FolderError(f"{run / 'history.csv'}: {unknown('column', one.column, table)}")
        return {"": table}
    tips = by_tip(table)
    if one.tip is not None and source == "cracks" and one.tip not in tips:
        raise FolderError(f"{run / 'cracks.csv'}: {unknown('tip', one.tip, tips)}")
    return {tip: rows for tip, rows in tips.items() if one.tip in (None, tip)}


def _told(statuses: Sequence[str]) -> str:
    """Return what the status of several rows says, each thing once; ok where all rows are."""
    return " | ".join(dict.fromkeys(one for one in statuses if one != "ok")) or "ok"


def _name(tip: str, one: Reduction) -> str:
    """Return the name of a column, such as `notch_end.K_I.max`."""
    take = f"at_{one.time:g}" if one.take == "at" else one.take
    growth = ["growth"] if one.table == "growth" else []
    return ".".join([*([tip.replace(" ", "_")] if tip else []), *growth, one.column, take])


def _take(table: Columns, one: Reduction) -> tuple[float | None, np.ndarray]:
    """Return the number that a reduction takes from a column, None if there is none, and its rows.

    Where there is none the rows are those that could have had it.
    """
    values, rows = table[one.column], np.arange(len(table[one.column]))
    if one.take == "last":
        return (float(values[-1]) if len(values) else None), rows[-1:]
    if one.take == "at":
        found = float(between(np.array([one.time]), table["time"], values)[0])
        after = int(np.searchsorted(table["time"], one.time))
        return (None if np.isnan(found) else found), rows[max(after - 1, 0) : after + 1]
    known = rows[np.isfinite(values)]
    if not len(known):
        return None, rows
    best = known[getattr(np, f"arg{one.take}")(values[known])]
    return float(values[best]), rows[best : best + 1]


def to_csv(rows: Sequence[Row]) -> str:
    """Return rows as CSV, numbers as they are read back bit for bit."""
    names = _columns(rows)
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(names)
    writer.writerows([_cell(row.get(name)) for name in names] for row in rows)
    return text.getvalue()


def _columns(rows: Sequence[Row]) -> list[str]:
    """Return the names of all columns: what varies before the state, numbers after it."""
    before: dict[str, None] = {}
    after: dict[str, None] = {}
    for row in rows:
        names = list(row)
        at = names.index("state") if "state" in names else len(names)
        before |= dict.fromkeys(names[:at])
        after |= dict.fromkeys(names[at:])
    return [*before, *after]


def write_results(path: Path, rows: Sequence[Row]) -> Path:
    """Write rows into a CSV file, or into Parquet if the file is called so.

    Raises FolderError when the package for Parquet is missing.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    if path.suffix == ".parquet":
        _write_parquet(path, rows)
    else:
        write_text(path, to_csv(rows))
    return path


def _write_parquet(path: Path, rows: Sequence[Row]) -> None:
    """Columns of numbers are numbers; one with words in it holds texts, as in the CSV file."""
    try:
        import pyarrow
        from pyarrow.parquet import write_table
    except ImportError:
        raise FolderError(f"{path}: needs pyarrow; pip install 'cramp[parquet]'") from None
    columns = {name: [row.get(name) for row in rows] for name in _columns(rows)}
    for name, values in columns.items():
        if any(isinstance(value, str | list | tuple) for value in values):
            columns[name] = [None if value is None else _cell(value) for value in values]
    with replaced(path) as beside:
        write_table(pyarrow.table(columns), beside)


def cases_table(cases: Sequence[Case]) -> str:
    """Return names and parameters of cases as CSV, values as the study has them."""
    return to_csv([{"case": case.name, **case.parameters} for case in cases])


def _cell(value: object) -> str:
    if value is None:
        return ""
    return repr(value) if isinstance(value, float) else shown(value)
