"""What the commands of `cramp sweep` do."""

import json
import sys
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from cramp_cli.deck.sweep import Study, read_study
from cramp_cli.output.exits import DIFFERENT, DONE, FolderError, OutOfResources
from cramp_cli.output.tables import duration
from cramp_cli.study.cases import Case, expand
from cramp_cli.study.collect import check_columns, collect, write_results
from cramp_cli.study.dask_backend import run_on_dask
from cramp_cli.study.one_case import Sweep
from cramp_cli.study.outcome import WORDS, Outcome, SweepFolder
from cramp_cli.study.report import report
from cramp_cli.study.slurm import write_slurm
from cramp_cli.study.sweep import default_folder, only, run_cases, to_do
from cramp_cli.study.sweep_report import sweep_report


class SweepOptions(NamedTuple):
    """The options of `cramp sweep run`."""

    output: Path | None = None
    jobs: int | None = None
    threads: int = 1
    only: str | None = None
    backend: str = "local"
    scheduler: str = ""  # address, for the backend dask
    verbosity: int = 1
    most: int | None = None  # cases; more are refused


class Opened(NamedTuple):
    """A study, its cases and where their runs are."""

    study: Study
    cases: Sequence[Case]
    folder: SweepFolder


def open_study(path: Path, output: Path | None = None) -> Opened:
    """Return a valid study with its cases; raise DeckError with all mistakes of it."""
    study = read_study(path)
    check_columns(study)
    return Opened(study, expand(study), SweepFolder(output or default_folder(path)))


def run_study(path: Path, options: SweepOptions) -> tuple[int, Path]:
    """Run what is not done; return the exit code and the path to look at.

    Raises OutOfResources when there are more cases to run than allowed.
    """
    study, cases, folder = open_study(path, options.output)
    if options.only:
        cases = only(cases, options.only)
    sweep = Sweep(study.deck_path, cases, folder, study.timeout, options.threads)
    todo = to_do(sweep)
    if options.most is not None and len(todo) > options.most:
        text = f"{path}: {len(todo)} cases to run; more than {options.most} need --force"
        raise OutOfResources(text)
    folder.remember(path)
    if options.backend == "slurm" and todo:
        return DONE, write_slurm(sweep, path, todo, options.jobs, sys.executable)
    teller = _Teller(len(todo), options.verbosity)
    teller.begin(len(cases))
    if options.backend == "dask":
        run_on_dask(sweep, todo, options.scheduler, teller.tell)
    else:
        run_cases(sweep, todo, options.jobs, teller.tell)
    outcomes = [folder.outcome(case.name) for case in cases]
    if options.only:
        return _code_of(outcomes[0]), folder.run(options.only)
    return DONE if all(one.word == "done" for one in outcomes) else DIFFERENT, folder.path


def _code_of(outcome: Outcome) -> int:
    """Return the exit code of a case, as a shell tells that of a process ended by a signal."""
    code = outcome.exit_code
    if outcome.word == "done":
        return DONE
    return DIFFERENT if not code else code if code > 0 else 128 - code


class _Teller:
    """Says on stderr how a sweep goes, a line per case."""

    def __init__(self, count: int, verbosity: int):
        self.count, self.verbosity, self.told = count, verbosity, 0

    def begin(self, all_cases: int) -> None:
        if self.verbosity:
            done = all_cases - self.count
            earlier = f", {done} done or running already" if done else ""
            print(f"{self.count} of {all_cases} cases to run{earlier}", file=sys.stderr)

    def tell(self, case: Case, outcome: Outcome) -> None:
        self.told += 1
        if self.verbosity or outcome.word != "done":
            head = f"{self.told:>{len(str(self.count))}}/{self.count}"
            print(f"{head}  {_line(case, outcome)}", file=sys.stderr, flush=True)


def _line(case: Case, outcome: Outcome) -> str:
    """Return what is said of a case: name, how it is, what varies, why it is not done."""
    head = f"{case.name}  {outcome.word:8}  {duration(outcome.wall_time):>6}"
    parts = [head, str(case), outcome.reason]
    return "  ".join(part for part in parts if part)


def tell_study(path: Path, output: Path | None, as_json: bool) -> str:
    """Return how many cases are in which state, and every case that did not end well."""
    study, cases, folder = open_study(path, output)
    found = [(case, folder.outcome(case.name)) for case in cases]
    if as_json:
        rows = [{"case": c.name, **c.parameters, **outcome._asdict()} for c, outcome in found]
        return json.dumps(rows, indent=2)
    counts = Counter(outcome.word for _, outcome in found)
    told = ", ".join(f"{counts[word]} {word}" for word in WORDS if counts[word])
    head = f"{study.title or path}: {len(cases)} cases, {told}"
    others = [(case, one) for case, one in found if one.word not in ("done", "missing")]
    return "\n".join([head, *(_line(case, one) for case, one in others)])


def collect_study(
    path: Path, output: Path | None, table: Path | None, wall_time: bool = False
) -> Path:
    """Write the row of every case into a CSV file and return its path."""
    study, cases, folder = open_study(path, output)
    rows = collect(cases, folder, study.collect, wall_time)
    return write_results(table or folder.path / "results.csv", rows)


def report_folder(path: Path, page: Path | None) -> Path:
    """Write the page of a run or of a sweep, by what the folder holds, and return its path.

    Raises FolderError if the study of a sweep has gone.
    """
    page, whose = page or path / "report.html", SweepFolder(path).study()
    if whose is None:
        return report(path, page)
    if not whose.exists():
        remedy = f"`cramp sweep run STUDY -o {path}` tells where it is now"
        raise FolderError(f"{path}: its study {whose} is not there; {remedy}")
    study, cases, folder = open_study(whose, path)
    rows = collect(cases, folder, study.collect, wall_time=True)
    return sweep_report(page, study.title or whose.stem, rows)
