"""Who ran what, where and with which outcome: manifest.json; and how far it is: status.json."""

import hashlib
import json
import os
import platform
import socket
import sys
import time
from datetime import UTC, datetime
from pathlib import Path

from cramp_cli.numerics.cache import source_hash
from cramp_cli.output.atomic import write_json
from cramp_cli.output.exits import DONE, INTERRUPTED, STOPPED, exit_code, one_line
from cramp_cli.output.folder import MANIFEST, PROGRAM
from cramp_cli.output.machine import versions

FORMAT = 1
SECONDS_BETWEEN_STATUS = 1.0


class Manifest:
    """The record of a run, on disk from its first moment and completed at its end.

    goes_on: what a checkpoint knows of the time before it: step and wall_time (s)
    files: SHA-256 of the files that the deck names
    """

    def __init__(
        self,
        folder: Path,
        deck_text: str,
        threads: int,
        goes_on: dict | None = None,
        files: dict[str, str] | None = None,
    ) -> None:
        self.path = Path(folder) / MANIFEST
        self._begun = time.monotonic()
        earlier = json.loads(self.path.read_text(encoding="utf-8")) if goes_on else {}
        self.record = {
            "program": PROGRAM,
            "format": FORMAT,
            "versions": versions(),
            "source_hash": source_hash(),
            "deck_sha256": earlier.get("deck_sha256", sha256(deck_text)),
            "files_sha256": earlier.get("files_sha256", files or {}),
            "argv": list(sys.argv),
            "directory": os.getcwd(),
            "host": socket.gethostname(),
            "system": platform.platform(),
            "process": os.getpid(),
            "threads": threads,
            "start": earlier.get("start", now()),
            "parts": earlier.get("parts", []),
            "end": None,
            "status": "running",
            "exit_code": None,
            "wall_time": None,
            "error": None,
            "summary": {},
        }
        part = {"start": now(), "host": socket.gethostname(), "threads": threads}
        self.record["parts"].append(part | {"step": goes_on["step"] if goes_on else 0})
        self._before = goes_on["wall_time"] if goes_on else 0.0
        write_json(self.path, self.record)

    @property
    def wall_time(self) -> float:
        """Seconds spent on this run, those of its earlier parts included."""
        return self._before + time.monotonic() - self._begun

    def finish(self, summary: dict) -> None:
        """Write that the run came to its end."""
        self._close(status="done", exit_code=DONE, summary=summary)

    def fail(self, error: BaseException) -> None:
        """Write that the run ended early, and why."""
        code = exit_code(error)
        status = {INTERRUPTED: "interrupted", STOPPED: "stopped"}.get(code, "failed")
        self._close(status=status, exit_code=code, error=one_line(error))

    def _close(self, **outcome: object) -> None:
        self.record.update(outcome, end=now(), wall_time=self.wall_time)
        write_json(self.path, self.record)


class Status:
    """The newest numbers of a running simulation, at most once a second."""

    def __init__(self, folder: Path, end_time: float | None) -> None:
        self.path = Path(folder) / "status.json"
        self.end_time = end_time
        self.record: dict = {"status": "running", "step": 0, "time": 0.0, "end_time": end_time}
        self._begun = time.monotonic()
        self._written = 0.0
        self._first: tuple[float, float] | None = None  # wall time and time of the first numbers

    def update(self, **numbers: object) -> None:
        """Take new numbers; write them if the file is older than a second."""
        self.record.update(numbers)
        if self._first is None and self.record["time"] > 0.0:  # kernels are compiled by now
            self._first = time.monotonic() - self._begun, self.record["time"]
        if time.monotonic() - self._written >= SECONDS_BETWEEN_STATUS:
            self.write()

    def write(self) -> None:
        """Write the newest numbers."""
        wall = time.monotonic() - self._begun
        before, done = self._first or (0.0, 0.0)
        end = None if self.end_time is None else self.end_time - done
        left = seconds_left(wall - before, self.record["time"] - done, end)
        write_json(self.path, {**self.record, "wall_time": wall, "eta": left, "written": now()})
        self._written = time.monotonic()


def seconds_left(wall: float, done: float, end: float | None) -> float | None:
    """Return how long a run still takes if it goes on as before (s)."""
    if end is None or done <= 0.0:
        return None
    return max(0.0, wall * (end - done) / done)


def sha256(text: str) -> str:
    """Return the SHA-256 of a text as hex digits."""
    return hashlib.sha256(text.encode()).hexdigest()


def now() -> str:
    """Return the moment as ISO 8601 in UTC."""
    return datetime.now(UTC).isoformat(timespec="seconds")
