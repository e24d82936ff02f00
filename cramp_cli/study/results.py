"""The tables and frames of a run, as arrays by name."""

import csv
from itertools import islice
from pathlib import Path

import numpy as np

from cramp_cli.output.exits import FolderError
from cramp_cli.output.fields import Frame, read_frames
from cramp_cli.output.folder import is_run_folder
from cramp_cli.output.history import (
    CRACK_COLUMNS,
    GROWTH_COLUMNS,
    HISTORY_COLUMNS,
    MEAN_COLUMNS,
    named_column,
)

Columns = dict[str, np.ndarray]  # name: (rows,), numbers as float, words as text

WORDS = {name for name, (unit, _) in (CRACK_COLUMNS | GROWTH_COLUMNS).items() if unit == ""}


def require_run(run: Path) -> None:
    """Raise FolderError unless a folder holds a run."""
    if not is_run_folder(run):
        reason = "not the folder of a run of cramp" if run.exists() else "no such folder"
        raise FolderError(f"{run}: {reason}")


def read_table(path: Path) -> Columns:
    """Return the columns of a CSV file; none if there is no file.

    A last line that is still being written is left out. Raises FolderError for a cell that is no
    number.
    """
    if not path.exists():
        return {}
    with path.open(encoding="utf-8", newline="") as file:
        names, *rows = list(csv.reader(file)) or [[]]
    rows = [row for row in rows if len(row) == len(names)]
    columns = zip(*rows, strict=True) if rows else ([] for _ in names)
    return {name: _values(path, name, cells) for name, cells in zip(names, columns, strict=True)}


def _values(path: Path, name: str, cells) -> np.ndarray:
    if name in WORDS:
        return np.array(cells, dtype=str)
    try:
        return np.array(cells, dtype=float)
    except ValueError:
        raise FolderError(f"{path}: column '{name}' holds what is no number") from None


def by_tip(table: Columns) -> dict[str, Columns]:
    """Return the rows of each tip, under names such as `notch end`, in order of appearance."""
    if not table or not len(table["tip"]):
        return {}
    names = np.char.add(np.char.add(table["crack"], " "), table["tip"])
    tips = dict.fromkeys(names.tolist())
    return {tip: {key: values[names == tip] for key, values in table.items()} for tip in tips}


def unit_of(column: str) -> str:
    """Return the SI unit of a column of history.csv, cracks.csv or growth.csv."""
    known = CRACK_COLUMNS | MEAN_COLUMNS | HISTORY_COLUMNS | GROWTH_COLUMNS
    return known.get(column, named_column(column) or ("1", ""))[0]


def frame_at(run: Path, kind: str, time: float | None = None) -> Frame:
    """Return the frame of `particles` or `cracks` nearest to a time (s); the last one for None.

    Raises FolderError when the run has written none.
    """
    found = None
    for frame in read_frames(run / f"{kind}.h5"):
        if found is None or time is None or abs(frame.time - time) < abs(found.time - time):
            found = frame
    if found is None:
        raise FolderError(f"{run / f'{kind}.h5'}: holds no frame yet")
    return found


def first_frame(run: Path, kind: str) -> Frame | None:
    """Return the first frame of `particles` or `cracks`, None if there is none."""
    if not (run / f"{kind}.h5").exists():
        return None
    return next(islice(read_frames(run / f"{kind}.h5"), 1), None)
