"""Run one case of a sweep in a process of its own, started by spawn, and write down its end."""

import subprocess
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from time import monotonic, sleep
from typing import BinaryIO, NamedTuple

from cramp_cli.study.cases import Case
from cramp_cli.study.outcome import SweepFolder, in_use

GRACE = 10.0  # s between the request to end and the end
PATIENCE = 0.5  # s between two looks at a run that goes on without its starter

Start = Callable[[Sequence[str], BinaryIO], subprocess.Popen | None]


class Sweep(NamedTuple):
    """What is run, and where."""

    deck: Path
    cases: Sequence[Case]
    folder: SweepFolder
    timeout: float | None = None  # s on the clock
    threads: int = 1  # of each run


def command(sweep: Sweep, case: Case) -> list[str]:
    """Return the words that run a case; one that was stopped with a checkpoint goes on."""
    settings = [word for setting in case.settings for word in ("-s", setting)]
    run = [str(sweep.deck), "-o", str(sweep.folder.run(case.name)), "--resume", "auto"]
    how = ["-t", str(sweep.threads), "--progress", "none"]
    return [sys.executable, "-m", "cramp_cli", "-q", "run", *run, *how, *settings]


def start(words: Sequence[str], log: BinaryIO) -> subprocess.Popen:
    """Start a process that says what it has to say into a file."""
    return subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=log)


def run_case(sweep: Sweep, case: Case, begin: Start = start) -> None:
    """Run a case to its end, or to the sweep's timeout, and write down how it ended.

    begin: starts a process, or returns None when no case is to be started any more
    """
    folder = sweep.folder
    folder.ended(case.name).unlink(missing_ok=True)
    begun, hung = monotonic(), False
    with folder.log(case.name).open("wb") as log:
        process = begin(command(sweep, case), log)
        if process is None:
            return
        try:
            process.wait(sweep.timeout)
        except subprocess.TimeoutExpired:
            hung = True
            _end(process)
    folder.note(case.name, process.returncode, monotonic() - begun, hung)


def take_up(sweep: Sweep, case: Case) -> str:
    """Run a case unless it is done; return the word for how it is.

    A run whose starter was killed goes on by itself: it is waited for and not begun again.
    """
    while in_use(sweep.folder.run(case.name)):
        sleep(PATIENCE)
    if sweep.folder.outcome(case.name).word != "done":
        run_case(sweep, case)
    return sweep.folder.outcome(case.name).word


def _end(process: subprocess.Popen) -> None:
    """End a process, by force if it does not listen."""
    process.terminate()
    try:
        process.wait(GRACE)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
