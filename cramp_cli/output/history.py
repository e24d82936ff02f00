"""Tables of a run: history, cracks, growth, path; columns.json explains them."""

import csv
import io
import os
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from cramp_cli.output.atomic import write_json, write_text
from cramp_cli.output.exits import FolderError

# name: (unit, meaning)
HISTORY_COLUMNS = {
    "step": ("1", "number of time steps done"),
    "time": ("s", "time"),
    "dt": ("s", "length of the last time step"),
    "kinetic_energy": ("J", "kinetic energy of the particles"),
    "strain_energy": ("J", "elastic energy stored in the particles"),
    "fracture_energy": (
        "J",
        "sum of J da of all growth, what running tips have taken out of the solid",
    ),
    "cohesive_stored": ("J", "energy that traction laws of crack faces would give back"),
    "cohesive_energy": ("J", "energy that traction laws of crack faces have dissipated"),
    "friction_energy": ("J", "energy spent by friction of crack faces and bodies"),
    "impact_energy": ("J", "energy lost where faces of cracks meet; below 0 it is none"),
    "plastic_energy": ("J", "energy spent in plastic and viscous strain"),
    "damping_energy": (
        "J",
        "energy taken by damping, and by the filter of updates other than flip",
    ),
    "absorbed_energy": ("J", "energy that has left through absorbing boundaries"),
    "external_work": ("J", "work of loads and moving boundaries"),
    "energy_error": ("1", "sum of all energies minus start and work, over the largest of them"),
    "momentum_x": ("N*s", "momentum of all particles along x"),
    "momentum_y": ("N*s", "momentum of all particles along y"),
}
# of columns with names of a deck, by the beginning of their names
NAMED_COLUMNS = {
    "reaction_": ("N", "force of this boundary on the bodies in the last step before the row"),
    "contact_": ("N", "force of all others on this body, or its group, in the last step"),
}

CRACK_COLUMNS = {
    "step": ("1", "number of time steps done"),
    "time": ("s", "time"),
    "crack": ("", "name of the crack"),
    "tip": ("", "start or end"),
    "x": ("m", "position of the tip"),
    "y": ("m", "position of the tip"),
    "angle": ("rad", "direction in which the crack points at the tip, from the x axis"),
    "length": ("m", "length of the whole crack"),
    "speed": ("m/s", "speed of growth of this tip"),
    "J": ("J/m^2", "J integral over a domain; with a cohesive zone J_tip + J_zone"),
    "K_I": ("Pa*m^0.5", "stress intensity of opening"),
    "K_II": ("Pa*m^0.5", "stress intensity of sliding in the plane"),
    "K_III": ("Pa*m^0.5", "stress intensity of sliding out of the plane"),
    "ctod_n": ("m", "opening of the faces near the tip, along their normal"),
    "ctod_t": ("m", "sliding of the faces near the tip"),
    "J_contour": ("J/m^2", "J integral over a contour on grid lines"),
    "K_I_contour": ("Pa*m^0.5", "K_I from J_contour and the opening of the faces"),
    "K_II_contour": ("Pa*m^0.5", "K_II from J_contour and the opening of the faces"),
    "J_spread": (
        "1",
        "largest less smallest J of domains of several radii, over J: whether J depends on the "
        "radius; no bound of the error, which may be ten times as large in waves",
    ),
    "J_tip": ("J/m^2", "energy release rate of the tip alone"),
    "J_zone": ("J/m^2", "energy release rate that a cohesive zone behind the tip takes"),
    "status": ("", "ok, shrunk, closed, or invalid and why"),
}
# with fracture.means; each belongs to time_mean, not to time
MEAN_COLUMNS = {
    "J_mean": ("J/m^2", "mean of J over the time that a wave takes through the domain"),
    "K_I_mean": ("Pa*m^0.5", "mean of K_I over that time"),
    "K_II_mean": ("Pa*m^0.5", "mean of K_II over that time"),
    "time_mean": ("s", "middle of the time of these means, to which they belong"),
}

GROWTH_COLUMNS = {
    "step": ("1", "number of time steps done"),
    "time": ("s", "time"),
    "crack": ("", "name of the crack"),
    "tip": ("", "start or end"),
    "kind": ("", "growth, arrest, edge, merge or debond"),
    "x": ("m", "position of the tip after the event"),
    "y": ("m", "position of the tip after the event"),
    "angle": ("rad", "direction of the new piece, from the x axis"),
    "length": ("m", "length of the whole crack after the event"),
    "J": ("J/m^2", "energy release rate that drove the event; of a debonded point its energy"),
    "K_I": ("Pa*m^0.5", "stress intensity of opening before the event"),
    "K_II": ("Pa*m^0.5", "stress intensity of sliding before the event"),
    "energy": ("J", "energy spent on the new surface"),
    "mode_I": ("1", "share of opening in the energy of a debonded point"),
}


PATH_COLUMNS = {
    "crack": ("", "name of the crack"),
    "point": ("1", "number of the point, from the start of the crack to its end"),
    "x": ("m", "place of the point at the end of the run"),
    "y": ("m", "place of the point at the end of the run"),
    "X": ("m", "its place in the undeformed body"),
    "Y": ("m", "its place in the undeformed body"),
}

TABLES = ("history", "cracks", "growth", "path")


class CsvTable:
    """A table on disk that is complete after every row.

    columns: names, in the order of the file
    go_on: append to the table that is there, which must have these columns
    """

    def __init__(self, path: Path, columns: Iterable[str], *, go_on: bool = False) -> None:
        self.path, self.columns = Path(path), tuple(columns)
        if go_on:
            self._refuse_others()
        else:
            write_text(self.path, _line(self.columns))

    def write(self, row: dict) -> None:
        """Append one row; a column without a value is written as nan."""
        unknown = set(row) - set(self.columns)
        if unknown:
            raise ValueError(f"{self.path.name}: no column named {', '.join(sorted(unknown))}")
        line = _line(_cell(row.get(name, float("nan"))) for name in self.columns)
        with self.path.open("a", encoding="utf-8", newline="") as file:
            file.write(line)

    def _refuse_others(self) -> None:
        with self.path.open(encoding="utf-8", newline="") as file:
            if file.readline() != _line(self.columns):
                raise FolderError(f"{self.path}: has other columns than this run writes")


def cut_tables(folder: Path, sizes: dict[str, int]) -> None:
    """Bring tables back to where they were: cut each to its size, remove the others.

    sizes: bytes by name without .csv
    """
    for name in TABLES:
        path = Path(folder) / f"{name}.csv"
        if name not in sizes:
            path.unlink(missing_ok=True)
            continue
        found = path.stat().st_size if path.exists() else 0
        if found < sizes[name]:
            raise FolderError(
                f"{path}: has {found} bytes, the checkpoint knows of {sizes[name]}; the table was "
                "changed, start the run anew with --overwrite"
            )
        os.truncate(path, sizes[name])


def history_columns(names: Iterable[str]) -> dict[str, tuple[str, str]]:
    """Return the columns of history.csv, with forces of boundaries and bodies at the end."""
    extra = {name: named_column(name) for name in names if name not in HISTORY_COLUMNS}
    strange = [name for name, meaning in extra.items() if meaning is None]
    if strange:
        raise ValueError(f"history.csv: no column named {', '.join(strange)}")
    return HISTORY_COLUMNS | extra


def named_column(column: str) -> tuple[str, str] | None:
    """Return unit and meaning of a column that is called after something in the deck, or None."""
    return next((text for key, text in NAMED_COLUMNS.items() if column.startswith(key)), None)


def write_columns(folder: Path, history: dict[str, tuple[str, str]]) -> None:
    """Write columns.json: unit and meaning of every column of every table."""
    tables = {
        "history.csv": history,
        "cracks.csv": CRACK_COLUMNS | MEAN_COLUMNS,
        "growth.csv": GROWTH_COLUMNS,
        "path.csv": PATH_COLUMNS,
    }
    write_json(Path(folder) / "columns.json", {name: _explain(t) for name, t in tables.items()})


def _explain(columns: dict[str, tuple[str, str]]) -> dict:
    return {name: {"unit": unit, "meaning": text} for name, (unit, text) in columns.items()}


def _line(cells: Iterable) -> str:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerow(cells)
    return text.getvalue()


def _cell(value: object) -> str:
    if isinstance(value, float | np.floating):
        return f"{value:.17g}"
    return str(value)
