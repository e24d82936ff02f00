"""Run the cases of a study, each in a process of its own; go on where an earlier sweep ended."""

import contextlib
import signal
import subprocess
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path
from threading import Event, Lock
from typing import BinaryIO

from cramp_cli.output.exits import FolderError
from cramp_cli.output.machine import usable_cpus
from cramp_cli.schema.section import meant_by
from cramp_cli.study.cases import Case
from cramp_cli.study.one_case import Sweep, run_case, start
from cramp_cli.study.outcome import Outcome

LEFT_ALONE = ("done", "running")


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


class _Crew:
    """The processes that run now."""

    def __init__(self):
        self.stopped, self.lock = Event(), Lock()
        self.processes: list[subprocess.Popen] = []

    def run(self, sweep: Sweep, case: Case) -> None:
        """Run a case to its end, unless another sweep of the same study has taken it by now."""
        if sweep.folder.outcome(case.name).word not in LEFT_ALONE:
            run_case(sweep, case, self._start)

    def _start(self, words: Sequence[str], log: BinaryIO) -> subprocess.Popen | None:
        with self.lock:
            if self.stopped.is_set():
                return None
            process = start(words, log)
            self.processes.append(process)
            return process

    def end(self, number: int) -> None:
        """Start nothing any more and send a signal to what runs."""
        self.stopped.set()
        for process in list(self.processes):
            process.send_signal(number)  # does nothing to one that has ended

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
