"""All files of one run behind one object, so that the loop over time knows no file."""

import contextlib
import traceback
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from cramp_cli.output.atomic import sync
from cramp_cli.output.checkpoint import write_state
from cramp_cli.output.exits import INTERNAL, STOPPED, exit_code, one_line
from cramp_cli.output.fields import FrameWriter, Unreadable
from cramp_cli.output.folder import RunFolder
from cramp_cli.output.history import (
    CRACK_COLUMNS,
    GROWTH_COLUMNS,
    HISTORY_COLUMNS,
    MEAN_COLUMNS,
    PATH_COLUMNS,
    CsvTable,
    cut_tables,
    history_columns,
    write_columns,
)
from cramp_cli.output.log import Log
from cramp_cli.output.manifest import Manifest, Status
from cramp_cli.output.summary import Summary

SHOWN_OF_A_TIP = ("crack", "tip", "x", "y", "J", "K_I", "K_II", "status")


class RunOutputs:
    """Writes what a run finds out; a file comes into being with its first row or frame.

    Used with ``with``: an exception that passes is recorded in manifest.json, and one that is a
    fault of the program also in run.log.

    places: what `places` gave to the checkpoint from which the run goes on; rows and frames behind
    it are cut off; files: SHA-256 of the files that the deck names, for the manifest
    """

    def __init__(
        self,
        folder: RunFolder,
        deck_text: str,
        resolved_text: str,
        *,
        end_time: float | None = None,
        threads: int = 1,
        real: str = "f4",
        places: dict | None = None,
        files: dict[str, str] | None = None,
    ) -> None:
        self.path, self._real = folder.path, real
        self._tables: dict[str, CsvTable] = {}
        self._frames: dict[str, FrameWriter] = {}
        self._before = places["tables"] if places else {}  # tables to go on with
        self.remarks: list[str] = []  # on files that could not be taken up
        if places:
            folder.go_on(resolved_text)
            self._take_up(places)
        self._manifest = Manifest(self.path, deck_text, threads, places, files)
        if not places:
            folder.begin(deck_text, resolved_text)
            write_columns(self.path, HISTORY_COLUMNS)
        self.log = Log(self.path / "run.log")
        self._status = Status(self.path, end_time)
        if places:
            self._status.record |= {"step": places["step"], "time": places["time"]}
        self._status.write()

    def __enter__(self) -> "RunOutputs":
        return self

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> None:
        if error is not None:
            self.fail(error)
        self.log.close()

    def history(self, row: dict) -> None:
        """Append one row to history.csv; its keys are those of HISTORY_COLUMNS and reactions."""
        if "history" not in self._tables:
            write_columns(self.path, history_columns(row))
        self._table("history", history_columns(row)).write(row)
        self._status.update(**{k: row[k] for k in ("step", "time", "energy_error") if k in row})

    def tips(self, rows: Iterable[dict]) -> None:
        """Append one row per tip to cracks.csv; keys as in CRACK_COLUMNS, MEAN_COLUMNS."""
        rows = list(rows)
        for row in rows:
            columns = CRACK_COLUMNS | (MEAN_COLUMNS if MEAN_COLUMNS.keys() <= row.keys() else {})
            self._table("cracks", columns).write(row)
        shown = [{name: row[name] for name in SHOWN_OF_A_TIP if name in row} for row in rows]
        self._status.update(tips=shown)

    def growth(self, rows: Iterable[dict]) -> None:
        """Append one row per event to growth.csv; keys as in GROWTH_COLUMNS."""
        for row in rows:
            self._table("growth", GROWTH_COLUMNS).write(row)

    def last_paths(self, rows: Iterable[dict]) -> None:
        """Write path.csv, the cracks at the end of the run; keys as in PATH_COLUMNS."""
        for row in rows:
            self._table("path", PATH_COLUMNS).write(row)

    def particle_frame(
        self, step: int, time: float, points: np.ndarray, fields: dict[str, np.ndarray]
    ) -> None:
        """Add all particles at one moment: positions (n, 2 or 3) and named fields of them."""
        self._writer("particles").write(step, time, points, fields)

    def crack_frame(
        self,
        step: int,
        time: float,
        polylines: Sequence[np.ndarray],
        fields: dict[str, np.ndarray] | None = None,
    ) -> None:
        """Add all cracks at one moment.

        polylines: one array (n_points, 2 or 3) per crack
        fields: values per point, all cracks one after the other; or one value per crack
        """
        offsets = np.cumsum([0, *map(len, polylines)])
        points = np.concatenate(polylines) if len(polylines) else np.empty((0, 3))
        fields = {"crack": np.arange(len(polylines))} | (fields or {})
        self._writer("cracks").write(step, time, points, fields, offsets)

    def places(self, step: int, time: float) -> dict:
        """Return how far all files are, once the disk holds them; a later run takes it again."""
        tables = {name: self.path / f"{name}.csv" for name in {*self._before, *self._tables}}
        for path in tables.values():
            sync(path)
        for writer in self._frames.values():
            sync(writer.data)
        return {
            "step": step,
            "time": time,
            "wall_time": self._manifest.wall_time,
            "tables": {name: path.stat().st_size for name, path in tables.items()},
            "frames": {kind: writer.count for kind, writer in self._frames.items()},
        }

    def finish(self, summary: Summary) -> None:
        """Record that the run came to its end, with its last numbers."""
        self._status.record |= {"step": summary.steps, "time": summary.time}
        self._status.record["status"] = "done"
        self._status.write()
        self._manifest.finish(summary._asdict())

    def failure(self, state: Any, points: np.ndarray, fields: dict[str, np.ndarray]) -> Path:
        """Write a state that is none to the folder failure/ and return it.

        The same as a checkpoint, to compute with, and as a frame, to look at; what a full disk can
        not take is left out.
        """
        where = self.path / "failure"
        with contextlib.suppress(OSError):
            where.mkdir(exist_ok=True)
            FrameWriter(where, "particles", "f8").write(state.step, state.time, points, fields)
            write_state(where / f"step_{state.step:012d}.h5", state, {})
        return where

    def fail(self, error: BaseException) -> None:
        """Record that the run ended early; nothing here may hide the error itself."""
        with contextlib.suppress(OSError):
            level = "info" if exit_code(error) == STOPPED else "error"
            self.log.write(level, _account(error))
            self._manifest.fail(error)
            self._status.record["status"] = self._manifest.record["status"]
            self._status.write()
        if exit_code(error) != STOPPED:  # that text says all
            error.add_note(f"see {self.path / 'run.log'}")

    def _table(self, name: str, columns: Iterable[str]) -> CsvTable:
        if name not in self._tables:
            path, go_on = self.path / f"{name}.csv", name in self._before
            self._tables[name] = CsvTable(path, columns, go_on=go_on)
        return self._tables[name]

    def _take_up(self, places: dict) -> None:
        """Bring all files back to where they were when a checkpoint was written."""
        cut_tables(self.path, places["tables"])
        for kind in ("particles", "cracks"):
            keep = places["frames"].get(kind)
            try:
                writer = FrameWriter(self.path, kind, self._real, keep)
            except Unreadable as error:
                writer = self._without_earlier_frames(kind, error)
            if keep is not None:
                self._frames[kind] = writer

    def _without_earlier_frames(self, kind: str, error: Unreadable) -> FrameWriter:
        """Begin a new file of frames: a run must not be lost for its pictures."""
        path = self.path / f"{kind}.h5"
        if path.exists():
            path.replace(path.with_suffix(".damaged"))
        self.remarks.append(f"{error}; its frames are lost, later ones go into a new file")
        return FrameWriter(self.path, kind, self._real)

    def _writer(self, kind: str) -> FrameWriter:
        if kind not in self._frames:
            self._frames[kind] = FrameWriter(self.path, kind, self._real)
        return self._frames[kind]


def _account(error: BaseException) -> str:
    """Return the traceback of a fault of the program, one line about any other end."""
    if exit_code(error) == INTERNAL:
        return "".join(traceback.format_exception(error)).rstrip()
    return one_line(error)
