"""Columns as columns: a CSV table by its names, an HDF5 file by the places of its data."""

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from cramp_cli.output.exits import FolderError

TABLES = ("history.csv", "cracks.csv", "growth.csv")
FRAMES = ("particles.h5", "cracks.h5")
KEYS = ("crack", "tip")  # rows of cracks.csv belong to a tip
UNSTEADY = ("step", "time", "dt")  # mean nothing between two rows
HEAD_LINES = 1  # of a table


@dataclass
class Columns:
    """The numbers and texts of one file."""

    name: str
    columns: dict[str, np.ndarray]  # float64, int or text; first axis = row
    is_table: bool  # CSV: all columns have the same rows

    @property
    def rows(self) -> int:
        """Number of rows of a table."""
        return len(next(iter(self.columns.values()), ()))

    def place(self, column: str, row: int) -> str:
        """Return where a value is, in words."""
        if not self.is_table:
            return f"value {row} of {self.columns[column].size}"
        known = {name: self.columns[name] for name in ("step", "time") if name in self.columns}
        more = ", ".join(f"{name} {values[row]:.10g}" for name, values in known.items())
        return f"line {row + HEAD_LINES + 1}" + (f" ({more})" if more else "")


def files_of(path: Path) -> dict[str, Path]:
    """Return the files with results by name: those of a run's folder, or the one file itself."""
    if path.is_dir():
        found = {name: path / name for name in TABLES + FRAMES if (path / name).exists()}
        if not found:
            raise FolderError(f"{path}: holds no results ({', '.join(TABLES + FRAMES)})")
        return found
    if not path.exists():
        raise FolderError(f"{path}: no such file or folder")
    return {path.name: path}


def read_columns(path: Path) -> Columns:
    """Return what a CSV or HDF5 file holds; FolderError when it is neither."""
    if path.suffix == ".csv":
        return Columns(path.name, _read_table(path), is_table=True)
    if path.suffix in (".h5", ".hdf5"):
        return Columns(path.name, _read_data(path), is_table=False)
    raise FolderError(f"{path}: is no .csv and no .h5 file")


def at_times_of(reference: Columns, new: Columns) -> Columns:
    """Return a table at the times of another, linearly between its own rows.

    Rows of different tips are kept apart. Where the new table does not reach, its values are nan.
    Columns that mean nothing between two rows (step, dt, texts) are left out of both.
    """
    for table in (reference, new):
        missing = [name for name in ("time", *_keys(reference)) if name not in table.columns]
        if missing:
            raise FolderError(f"{table.name}: has no column {missing[0]} to compare in time by")
    columns = {
        name: np.full(reference.rows, np.nan)
        for name, values in new.columns.items()
        if name in reference.columns and name not in UNSTEADY and values.dtype.kind != "U"
    }
    for mine, others in _tips(reference, new):
        wanted, known = reference.columns["time"][mine], new.columns["time"][others]
        for name, values in columns.items():
            values[mine] = between(wanted, known, new.columns[name][others])
    return Columns(new.name, columns, is_table=True)


def _keys(table: Columns) -> list[str]:
    return [name for name in KEYS if name in table.columns]


def between(wanted: np.ndarray, known: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Return values at the times wanted, linearly between those known (s); nan outside of them."""
    if not len(known):
        return np.full(len(wanted), np.nan)
    slack = 1e-9 * max(abs(known[0]), abs(known[-1]))
    inside = (wanted >= known[0] - slack) & (wanted <= known[-1] + slack)
    return np.where(inside, np.interp(wanted, known, values), np.nan)


def _tips(reference: Columns, new: Columns):
    """Yield the rows of each tip in both tables, as masks; of a table without tips, all rows."""
    names = _keys(reference)
    rows = [list(zip(*(t.columns[n] for n in names), strict=True)) for t in (reference, new)]
    if not names:
        yield slice(None), slice(None)
    for key in dict.fromkeys(rows[0]):
        yield tuple(np.array([row == key for row in table], dtype=bool) for table in rows)


def _read_table(path: Path) -> dict[str, np.ndarray]:
    with path.open(encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    if not rows:
        raise FolderError(f"{path}: is empty")
    for number, row in enumerate(rows, start=1):
        if len(row) != len(rows[0]):
            raise FolderError(f"{path}:{number}: has {len(row)} cells, not {len(rows[0])}")
    columns = zip(*rows[1:], strict=True) if rows[1:] else [() for _ in rows[0]]
    return {name: _column(cells) for name, cells in zip(rows[0], columns, strict=True)}


def _column(cells: tuple[str, ...]) -> np.ndarray:
    try:
        return np.array(cells, dtype=float)
    except ValueError:
        return np.array(cells, dtype=str)


def _read_data(path: Path) -> dict[str, np.ndarray]:
    """Return all data of an HDF5 file by their places, attributes as `place@name`."""
    import h5py  # late: keeps `cramp --help` fast

    found: dict[str, np.ndarray] = {}

    def keep(place, item) -> None:
        found.update({f"{place}@{n}": np.atleast_1d(_plain(v)) for n, v in item.attrs.items()})
        if isinstance(item, h5py.Dataset):
            found[place] = np.atleast_1d(_plain(item[()]))

    try:
        with h5py.File(path, "r", locking=False) as file:
            file.visititems(keep)
    except OSError as error:
        raise FolderError(f"{path}: cannot be read as HDF5 ({error})") from None
    return found


def _plain(value) -> np.ndarray:
    """Return numbers as they are, anything else as text."""
    values = np.asarray(value)
    return values if values.dtype.kind in "iufb" else values.astype(str)
