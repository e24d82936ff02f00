"""What a run says: everything into run.log, what a person needs to stderr.

On a terminal a bar shows how far the run is; elsewhere a table grows line by line, as batch users
know it from other codes. run.log holds the table always.
"""

import os
import sys
from datetime import datetime
from pathlib import Path
from typing import TextIO

from cramp_cli.output.manifest import seconds_left
from cramp_cli.output.summary import Summary, summary_text
from cramp_cli.output.tables import facts_text, progress_head, progress_line

PARTS = 20  # lines of the table in a run of even speed
SECONDS = 60.0  # a line at least this often
LOUDNESS = {"error": 0, "warning": 0, "info": 1, "debug": 2}


class Log:
    """run.log: text with the time of day, on disk after every line."""

    def __init__(self, path: Path | None = None) -> None:
        self._file: TextIO | None = path.open("a", encoding="utf-8", buffering=1) if path else None

    def write(self, level: str, text: str) -> None:
        """Add a text of one line or many."""
        if self._file is not None:
            moment = datetime.now().strftime("%H:%M:%S")
            self._file.write("".join(f"{moment} {level:7} {line}\n" for line in text.splitlines()))

    def close(self) -> None:
        """Give the file back."""
        if self._file is not None:
            self._file.close()
            self._file = None


class Reporter:
    """Says how a run goes.

    progress: auto (bar on a terminal, lines elsewhere), bar, lines or none
    verbosity: 0 only warnings and errors, 1 normal, 2 everything
    """

    def __init__(self, log: Log | None = None, progress: str = "auto", verbosity: int = 1) -> None:
        self.log, self.verbosity = log or Log(), verbosity
        self.mode = _mode(progress) if verbosity > 0 else "none"
        self._total: float | None = None
        self._next_time, self._next_wall = 0.0, 0.0
        self._first: tuple[float, float] | None = None
        self._columns: list[str] | None = None
        self._bar = None

    def __enter__(self) -> "Reporter":
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def start(self, total_time: float, title: str, facts: dict[str, object]) -> None:
        """Say what is going to run.

        total_time: end of the run (s)
        facts: what the user may want to check, such as cells, particles, dt
        """
        self._total = total_time
        self._say("info", facts_text(title, facts))
        if self.mode == "bar":
            self._bar = _bar(total_time)

    def progress(self, step: int, time: float, wall: float, extra: dict[str, float]) -> None:
        """Say how far the run is; call it as often as you like.

        time, wall: time in the run and on the clock since its start (s)
        extra: up to three numbers worth a look, such as K_I or energy_error
        """
        if self._bar is not None:
            self._move_bar(time, extra)
        if time >= self._next_time or wall >= self._next_wall:
            self._next_time = time + (self._total or 0.0) / PARTS
            self._next_wall = wall + SECONDS
            self._add_line(step, time, wall, extra)

    def message(self, level: str, text: str) -> None:
        """Say something of level error, warning, info or debug."""
        prefix = "" if level == "info" else f"{level}: "
        self._say(level, prefix + text)

    def summary(self, summary: Summary) -> None:
        """Say how the run ended."""
        self.close()
        self._say("info", summary_text(summary))

    def close(self) -> None:
        """Leave the terminal as it was."""
        if self._bar is not None:
            self._bar.stop()
            self._bar = None

    def _add_line(self, step: int, time: float, wall: float, extra: dict[str, float]) -> None:
        lines = [progress_head(extra)] if list(extra) != self._columns else []
        self._first, self._columns = self._first or (time, wall), list(extra)
        done = time / self._total if self._total else 0.0
        lines.append(progress_line(step, time, done, self._left(time, wall), extra))
        self.log.write("info", "\n".join(lines))
        if self.mode == "lines":
            _to_screen("\n".join(lines))

    def _left(self, time: float, wall: float) -> float | None:
        """Return the seconds to go; what was before the first line does not count."""
        time_before, wall_before = self._first or (0.0, 0.0)
        end = None if self._total is None else self._total - time_before
        return seconds_left(wall - wall_before, time - time_before, end)

    def _move_bar(self, time: float, extra: dict[str, float]) -> None:
        text = "  ".join(f"{name} {value:.4g}" for name, value in list(extra.items())[:2])
        self._bar.update(self._bar.task_ids[0], completed=time, numbers=text)

    def _say(self, level: str, text: str) -> None:
        self.log.write(level, text)
        if LOUDNESS.get(level, 1) > self.verbosity:
            return
        if self._bar is not None:
            self._bar.console.print(text, markup=False, highlight=False)
        else:
            _to_screen(text)


def _mode(progress: str) -> str:
    if progress != "auto":
        return progress
    terminal = sys.stderr is not None and sys.stderr.isatty() and os.environ.get("TERM") != "dumb"
    return "bar" if terminal else "lines"


def _to_screen(text: str) -> None:
    print(text, file=sys.stderr, flush=True)


def _bar(total: float):
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (
        TextColumn("{task.percentage:3.0f} %"),
        BarColumn(bar_width=24),
        TimeRemainingColumn(),
        TextColumn("{task.fields[numbers]}", markup=False),
    )
    bar = Progress(*columns, console=Console(stderr=True), transient=True)
    bar.add_task("", total=total, numbers="")
    bar.start()
    return bar
