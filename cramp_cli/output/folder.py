"""The folder of one run: found free, locked, cleared of an older run, never shared by two."""

import fcntl
import json
import os
import shutil
import socket
from fnmatch import fnmatch
from pathlib import Path

from cramp_cli.output.atomic import TEMPORARY, sweep, write_text
from cramp_cli.output.exits import FolderError
from cramp_cli.output.stop import STOP

PROGRAM = "cramp"
LOCK = ".lock"
MANIFEST = "manifest.json"
OUR_FILES = (
    "input.yaml",
    "resolved.yaml",
    MANIFEST,
    "run.log",
    "status.json",
    "history.csv",
    "cracks.csv",
    "growth.csv",
    "path.csv",
    "columns.json",
    "particles.xdmf",
    "particles.h5",
    "cracks.xdmf",
    "cracks.h5",
    "checkpoints",
    "failure",
    STOP,
)


class FolderInUse(FolderError):
    """Another run writes into this folder now."""


class RunFolder:
    """A claimed folder; used with ``with``, it is given free at the end.

    Claiming changes nothing but the lock, so that an older run is still whole when the new deck
    turns out to be impossible; `begin` removes the older run's files and no others.
    """

    def __init__(self, path: str | Path, overwrite: bool = False) -> None:
        self.path = Path(path)
        self.begun = False
        _make(self.path)
        refuse_foreign(self.path)
        self._lock = _lock(self.path)
        try:
            if not overwrite:
                refuse_results(self.path)
        except FolderError:
            os.close(self._lock)
            raise

    def __enter__(self) -> "RunFolder":
        return self

    def __exit__(self, *error: object) -> None:
        self.release()

    def begin(self, deck_text: str, resolved_text: str) -> None:
        """Clear an older run away and keep both texts of the deck."""
        self.begun = True
        for name in OUR_FILES:
            if name != MANIFEST:  # it says that the folder is ours, also after a kill in here
                _remove(self.path / name)
        sweep(self.path)
        write_text(self.path / "input.yaml", deck_text)
        write_text(self.path / "resolved.yaml", resolved_text)

    def go_on(self, resolved_text: str) -> None:
        """Clear away what would stop or confuse the next part of a run; keep its end time."""
        self.begun = True
        write_text(self.path / "resolved.yaml", resolved_text)
        _remove(self.path / STOP)
        _remove(self.path / "failure")
        sweep(self.path)

    def release(self) -> None:
        """Let others use the folder; one in which no run began leaves no trace."""
        if self._lock is None:
            return
        if not self.begun and os.listdir(self.path) == [LOCK]:
            shutil.rmtree(self.path, ignore_errors=True)
        os.close(self._lock)
        self._lock = None


def is_run_folder(path: Path) -> bool:
    """Tell whether a folder holds a run of this program."""
    return run_status(path) is not None


def run_status(path: Path) -> str | None:
    """Return how the run in a folder ended, by its manifest, or None if it holds none."""
    try:
        manifest = json.loads((path / MANIFEST).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    ours = isinstance(manifest, dict) and manifest.get("program") == PROGRAM
    return str(manifest.get("status")) if ours else None


def refuse_no_run(path: Path) -> None:
    """Raise if a folder holds no run of this program."""
    if not is_run_folder(path):
        reason = "not the folder of a run of cramp" if path.exists() else "no such folder"
        raise FolderError(f"{path}: {reason}")


def refuse_foreign(path: Path) -> None:
    """Raise if a folder holds files that no run of ours has written."""
    names = {name for name in os.listdir(path) if name != LOCK and not fnmatch(name, TEMPORARY)}
    if names and not is_run_folder(path):
        raise FolderError(
            f"{path}: holds files that are not a run of cramp (such as {min(names)}); "
            "choose another folder with -o"
        )


def refuse_results(path: Path) -> None:
    """Raise if a folder holds an older run."""
    if is_run_folder(path):
        raise FolderError(
            f"{path}: holds an earlier run; replace it with --overwrite, or choose another "
            "folder with -o"
        )


def _make(path: Path) -> None:
    try:
        path.mkdir(parents=True, exist_ok=True)
    except (FileExistsError, NotADirectoryError):
        raise FolderError(f"{path}: a file is in the way of this folder") from None


def _lock(path: Path) -> int:
    """Lock a folder until the process ends, however it ends."""
    handle = os.open(path / LOCK, os.O_RDWR | os.O_CREAT, 0o644)
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        holder = os.pread(handle, 200, 0).decode(errors="replace").strip() or "another process"
        os.close(handle)
        raise FolderInUse(f"{path}: in use by {holder}; choose another folder with -o") from None
    os.ftruncate(handle, 0)
    os.pwrite(handle, f"process {os.getpid()} on {socket.gethostname()}\n".encode(), 0)
    return handle


def _remove(path: Path) -> None:
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    else:
        path.unlink(missing_ok=True)
