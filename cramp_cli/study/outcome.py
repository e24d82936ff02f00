"""How the cases of a sweep are: what its folder holds, and the word for each case."""

import fcntl
import json
import os
from pathlib import Path
from typing import NamedTuple

from cramp_cli.output.atomic import write_json
from cramp_cli.output.exits import DONE, INTERRUPTED, STOPPED
from cramp_cli.output.folder import LOCK

STUDY = "sweep.json"  # file in the folder of a sweep
WORDS = ("done", "running", "stopped", "failed", "hung", "killed", "interrupted", "missing")


class Outcome(NamedTuple):
    """How a case is."""

    word: str  # one of WORDS
    exit_code: int | None = None
    wall_time: float | None = None  # s
    reason: str = ""


class SweepFolder(NamedTuple):
    """Where the runs of a sweep are."""

    path: Path

    def remember(self, study: Path) -> None:
        """Write down of which study these are the runs."""
        self.path.mkdir(parents=True, exist_ok=True)
        write_json(self.path / STUDY, {"study": str(study.resolve())})

    def study(self) -> Path | None:
        """Return the study; None if the folder is not that of a sweep."""
        known = _json(self.path / STUDY).get("study")
        return Path(known) if known else None

    def run(self, name: str) -> Path:
        """Return the folder of a case's run."""
        return self.path / "runs" / name

    def log(self, name: str) -> Path:
        """Return the file of what a case's run said on the screen."""
        return self.path / "runs" / f"{name}.log"

    def ended(self, name: str) -> Path:
        """Return the file of how a case's process ended."""
        return self.path / "runs" / f"{name}.json"

    def note(self, name: str, exit_code: int, wall_time: float, hung: bool) -> None:
        """Write down how the process of a case ended."""
        record = {"exit_code": exit_code, "wall_time": wall_time, "hung": hung}
        write_json(self.ended(name), record)

    def outcome(self, name: str) -> Outcome:
        """Return how a case is, by its run's folder and by how its process ended."""
        run, ended = _json(self.run(name) / "manifest.json"), _json(self.ended(name))
        if in_use(self.run(name)):
            return Outcome("running")
        code = run.get("exit_code", ended.get("exit_code"))
        wall = run.get("wall_time") or ended.get("wall_time")
        reason = run.get("error") or _last_line(self.log(name))
        if code == DONE:
            return Outcome("done", code, wall)
        if ended.get("hung"):
            return Outcome("hung", ended["exit_code"], ended["wall_time"], "took too long")
        if run and code is None:
            code = ended.get("exit_code")
            return Outcome("killed", code, wall, _signal(code))
        if code is None:
            return Outcome("missing")
        if code < 0:
            return Outcome("killed", code, wall, _signal(code))
        word = {STOPPED: "stopped", INTERRUPTED: "interrupted"}.get(code, "failed")
        return Outcome(word, code, wall, reason.split("\n")[0])


def in_use(run: Path) -> bool:
    """Tell whether a process writes into the folder of a run now."""
    try:
        handle = os.open(run / LOCK, os.O_RDWR)
    except OSError:
        return False
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return True
    finally:
        os.close(handle)
    return False


def _json(path: Path) -> dict:
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}


def _last_line(path: Path) -> str:
    try:
        lines = path.read_text(encoding="utf-8", errors="replace").split("\n")
    except OSError:
        return ""
    return next((line.removeprefix("cramp: ") for line in reversed(lines) if line.strip()), "")


def _signal(code: int | None) -> str:
    return f"ended by signal {-code}" if code and code < 0 else "ended without a word"
