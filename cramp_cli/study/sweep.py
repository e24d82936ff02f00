"""Run the cases of a study, each in a process of its own; go on where an earlier sweep ended."""

import contextlib
import signal
import subprocess
import sys
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path
from threading import Event, Lock
from time import monotonic
from typing import NamedTuple

from cramp_cli.output.exits import FolderError
from cramp_cli.output.machine import usable_cpus
from cramp_cli.schema.section import meant_by
from cramp_cli.study.cases import Case
from cramp_cli.study.outcome import Outcome, SweepFolder

LEFT_ALONE = ("done", "running")
GRACE = 10.0  # s between the request to end and the end


class Sweep(NamedTuple):
    """What is run, and where."""

    deck: Path
    cases: Sequence[Case]
    folder: SweepFolder
    timeout: float | None = None  # s on the clock
    threads: int = 1  # of each run


def default_folder(study: Path) -> Path:
    """Return the folder of a study's runs: plate.sweep for plate.sweep.yaml or plate.yaml."""
    return Path(f"{study.stem.removesuffix('.sweep')}.sweep")


def to_do(sweep: Sweep) -> list[Case]:
    """Return the cases that are neither done nor running."""
    words = {case.name: sweep.folder.outcome(case.name).word for case in sweep.cases}
    return [case for case in sweep.cases if words[case.name] not in LEFT_ALONE]


def only(cases: Sequence[Case], name: str) -> list[Case]:
    """Return the one case of a name. Raises FolderError if there is none."""
    found = [case for case in cases if case.name == name]
    if not found:
        meant = meant_by(name, [case.name for case in cases])
        hint = f"; did you mean '{meant}'?" if meant else "; `cramp sweep expand` lists them"
        raise FolderError(f"the study has no case '{name}'{hint}")
    return found


def run_cases(
    sweep: Sweep, cases: Sequence[Case], jobs: int | None, tell: Callable[[Case, Outcome], None]
) -> None:
    """Run cases, so many at a time, and tell each outcome as it comes.

    Case after case is started by spawn, never by fork. An interrupt, or a signal to end, goes on to
    the runs and no further case is started.
    """
    jobs = jobs or max(1, usable_cpus() // sweep.threads)
    (sweep.folder.path / "runs").mkdir(parents=True, exist_ok=True)
    crew = _Crew()
    with ThreadPoolExecutor(jobs) as pool, crew.passing_signals_on():
        futures = {pool.submit(crew.run, sweep, case): case for case in cases}
        try:
            for future in as_completed(futures):
                future.result()
                tell(futures[future], sweep.folder.outcome(futures[future].name))
        except BaseException:
            crew.end(signal.SIGTERM)
            raise


def command(sweep: Sweep, case: Case) -> list[str]:
    """Return the words that run a case."""
    settings = [word for setting in case.settings for word in ("-s", setting)]
    run = [str(sweep.deck), "-o", str(sweep.folder.run(case.name)), "--overwrite"]
    how = ["-t", str(sweep.threads), "--progress", "none"]
    return [sys.executable, "-m", "cramp_cli", "-q", "run", *run, *how, *settings]


class _Crew:
    """The processes that run now."""

    def __init__(self):
        self.stopped, self.lock = Event(), Lock()
        self.processes: set[subprocess.Popen] = set()

    def run(self, sweep: Sweep, case: Case) -> None:
        """Run a case to its end and write down how it ended."""
        folder = sweep.folder
        folder.ended(case.name).unlink(missing_ok=True)
        begun, hung = monotonic(), False
        with folder.log(case.name).open("wb") as log:
            process = self._start(command(sweep, case), log)
            if process is None:
                return
            try:
                process.wait(sweep.timeout)
            except subprocess.TimeoutExpired:
                hung = True
                _end(process)
        with self.lock:
            self.processes.discard(process)
        folder.note(case.name, process.returncode, monotonic() - begun, hung)

    def _start(self, words, log) -> subprocess.Popen | None:
        with self.lock:
            if self.stopped.is_set():
                return None
            process = subprocess.Popen(
                words, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=log
            )
            self.processes.add(process)
            return process

    def end(self, number: int) -> None:
        """Start nothing any more and send a signal to what runs."""
        self.stopped.set()
        for process in list(self.processes):
            with contextlib.suppress(ProcessLookupError):
                process.send_signal(number)

    @contextlib.contextmanager
    def passing_signals_on(self):
        """Let signals of a batch system reach the runs, which stop at a step's end."""
        numbers = (signal.SIGTERM, signal.SIGUSR1)
        before = [signal.signal(n, lambda number, _: self.end(number)) for n in numbers]
        try:
            yield
        finally:
            for number, handler in zip(numbers, before, strict=True):
                signal.signal(number, handler)


def _end(process: subprocess.Popen) -> None:
    """End a process, by force if it does not listen."""
    process.terminate()
    try:
        process.wait(GRACE)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
