"""What the commands do, apart from their options: cli.py reads words, this module acts."""

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import typer

from cramp_cli.output.machine import choose_threads, human_bytes, refuse_too_big
from cramp_cli.output.tables import facts_text

LARGEST_BUILT = 3.3e8  # bytes that `check` may use: those of a million particles, two seconds
FEWEST_STEPS = 20
NOT_BUILT = "too large to be built by check; what a load or boundary does not meet, run will tell"


class RunOptions(NamedTuple):
    """The options of `cramp run`."""

    output: Path | None = None
    overrides: Sequence[str] = ()
    threads: int | None = None
    overwrite: bool = False
    dry_run: bool = False
    strict: bool = False
    progress: str = "auto"
    max_memory: int | None = None  # bytes
    max_disk: int | None = None  # bytes
    profile: bool = False
    verbosity: int = 1
    resume: str = "never"  # or auto, must
    max_wall: float | None = None  # s
    checkpoint_every: tuple[int | None, float | None] = (None, 600.0)  # steps, seconds


def run_deck(path: Path, options: RunOptions) -> Path | None:
    """Read, check, estimate, build and simulate a deck; return the folder of the results."""
    if options.overwrite and options.resume != "never":
        raise typer.BadParameter("--overwrite begins anew, --resume goes on: give one of them")
    options = options._replace(
        output=options.output or Path(f"{path.stem}.run"), threads=choose_threads(options.threads)
    )
    deck = load_deck(path, options.overrides, options.strict)
    needs = _fitting_needs(deck, options)
    if options.dry_run:
        say(facts_text(f"{path}: nothing wrong; a run would take", readable(needs)))
        return None
    _run(deck, options)
    return options.output


def resume_folder(folder: Path, options: RunOptions, end_time: str | None = None) -> Path:
    """Go on with the run in a folder, by the deck that it keeps there; return the folder.

    end_time: another end than that of the deck, which may lie behind the end of a finished run
    """
    from cramp_cli.output.folder import refuse_no_run

    refuse_no_run(folder)
    sets = [f"solver.end_time={end_time}"] if end_time else []
    options = options._replace(output=folder, resume="must", overrides=sets)
    return run_deck(folder / "resolved.yaml", options)


def _fitting_needs(deck, options: RunOptions) -> dict:
    """Return what a run takes; raise OutOfResources if that is too much.

    What no memory holds is refused before numba is imported, which takes longer than all else.
    """
    from cramp_cli.deck.size import size_of

    limits = options.output, options.max_memory, options.max_disk
    refuse_too_big(size_of(deck)._asdict(), *limits)
    from cramp_cli.build import estimate  # late: imports numba

    needs = estimate(deck)
    refuse_too_few_steps(deck, needs)
    refuse_too_big(needs, *limits)
    return needs


def refuse_too_few_steps(deck, needs: dict) -> None:
    """Raise DeckError for a run of so few steps that no wave goes anywhere.

    Mostly a modulus or a density without its unit makes the time step far too long.
    """
    from cramp_cli.build.model import time_step  # late: imports numba
    from cramp_cli.deck.deck import DeckError

    steps = round(deck.solver.end_time / time_step(deck))
    if steps < FEWEST_STEPS:
        message = f"is only {steps} time steps of {needs['time step']}"
        remedy = f"a run needs {FEWEST_STEPS}: see the units of E, density and grid.cell"
        raise DeckError([deck.mistake(("solver", "end_time"), f"{message}; {remedy}")])


def _run(deck, options: RunOptions) -> None:
    """Claim the folder, find out where to begin, simulate."""
    from cramp_cli.build import build
    from cramp_cli.deck.deck import to_yaml
    from cramp_cli.output.folder import RunFolder
    from cramp_cli.output.resume import find_start, is_finished
    from cramp_cli.output.stop import Signs

    folder, goes_on = options.output, options.resume != "never"
    with (
        Signs(folder, options.max_wall) as signs,
        RunFolder(folder, options.overwrite or goes_on) as claimed,
    ):
        resolved = to_yaml(deck.resolved())
        if goes_on and is_finished(folder, resolved):
            say(f"{folder}: is done already; nothing is left to do")
            return
        model, state = build(deck)
        start = find_start(folder, options.resume, resolved, state)
        _simulate(deck, resolved, model, start, claimed, signs, options)


def _simulate(deck, resolved: str, model, start, folder, signs, options: RunOptions) -> None:
    from cramp_cli.output.keeper import Keeper
    from cramp_cli.output.log import Reporter
    from cramp_cli.output.run import RunOutputs
    from cramp_cli.simulation import simulate

    facts = {"end_time": deck.solver.end_time, "threads": options.threads, "places": start.places}
    facts["files"] = deck.file_digests()
    with RunOutputs(folder, deck.source_text, resolved, **facts) as outputs:
        reporter = Reporter(outputs.log, options.progress, options.verbosity)
        for warning in deck.warnings:
            outputs.log.write("warning", str(warning))
        memory = {
            "keeper": Keeper(outputs, signs, options.checkpoint_every, resolved),
            "remembered": start.remembered,
        }
        with reporter:
            for level, text in [*start.remarks, *(("warning", text) for text in outputs.remarks)]:
                reporter.message(level, text)
            how = {"threads": options.threads, "profile": options.profile} | memory
            summary = simulate(deck, model, start.state, outputs, reporter, **how)
        outputs.finish(summary)
        reporter.summary(summary)


def load_deck(path: Path, overrides: Sequence[str] = (), strict: bool = False):
    """Return a valid deck and say its warnings; with `strict`, a warning is a mistake."""
    from cramp_cli.deck.deck import DeckError, read_deck  # late: imports pydantic

    deck = read_deck(str(path), list(overrides))
    if strict and deck.warnings:
        raise DeckError(list(deck.warnings))
    for warning in deck.warnings:
        say(f"warning: {warning}")
    return deck


def check_deck(path: Path, overrides: Sequence[str], strict: bool, report: bool) -> dict:
    """Return what is wrong with a deck, and on demand what a run of it would take.

    The model is built as well, unless it is large: that a load meets nothing shows only there.
    """
    from cramp_cli.deck.deck import DeckError, read_deck

    answer = {"file": str(path), "valid": False, "mistakes": [], "warnings": [], "notes": []}
    try:
        deck = read_deck(str(path), list(overrides))
        from cramp_cli.build import build, estimate, filled  # late: imports numba

        needs = estimate(deck)
        refuse_too_few_steps(deck, needs)
        if needs["memory_bytes"] > LARGEST_BUILT:
            answer["notes"].append(f"{path}: {NOT_BUILT}")
        else:
            model, state = build(deck)
            needs |= filled(deck, model, state) if report else {}
    except DeckError as error:
        return answer | {"mistakes": [str(mistake) for mistake in error.mistakes]}
    warnings = [str(warning) for warning in deck.warnings]
    answer |= {"valid": not (strict and warnings), "warnings": warnings}
    return answer | ({"report": needs} if report else {})


def say_check(answer: dict) -> None:
    """Print what `check_deck` found: mistakes and warnings on stderr, the verdict on stdout."""
    for text in answer["mistakes"]:
        say(text)
    for text in answer["warnings"]:
        say(f"warning: {text}")
    for text in answer["notes"]:
        say(text)
    if answer["valid"]:
        verdict = f"{answer['file']}: no mistakes"
        print(facts_text(verdict, readable(answer.get("report", {}))))


def compare_results(
    reference: Path,
    new: Path,
    rtol: float,
    atol: float | None,
    columns: Sequence[str],
    interpolate: bool,
):
    """Return how two results differ; `columns` are texts such as K_I:1e-3 or K_I:1e-3:10."""
    from cramp_cli.study.compare import compare

    others = dict(map(_tolerance, columns))
    return compare(reference, new, rtol=rtol, atol=atol, columns=others, interpolate=interpolate)


def _tolerance(text: str):
    from cramp_cli.study.compare import Tolerance

    name, *limits = text.split(":")
    try:
        tolerance = Tolerance(*map(float, limits))
        if not limits or not all(limit >= 0.0 for limit in map(float, limits)):
            raise ValueError
    except (TypeError, ValueError):
        message = f"'{text}' is no limit; write it like 'K_I:1e-3' or 'K_I:1e-3:10'"
        raise typer.BadParameter(message) from None
    return name, tolerance


def warm_up() -> str:
    """Compile all kernels; return how long it took."""
    from time import perf_counter

    from cramp_cli.warm import run_small_cases

    begun = perf_counter()
    run_small_cases()
    return f"{perf_counter() - begun:.1f} s"


def run_bench(
    threads: int | None,
    large: bool,
    start: bool,
    only: list[str],
    older: Path | None,
    as_json: bool,
) -> None:
    """Time the cases and print them as they come, or all as JSON in the end."""
    import json

    count = choose_threads(threads)
    from cramp_cli.study.bench import HEAD, bench, read_old, row, stages_text, time_start

    old = read_old(older)

    def tell(name: str, timing: dict) -> None:
        say(row(name, timing, old.get(name)) + "\n" + stages_text(timing))

    say(HEAD)
    found = bench(count, large, only, tell)
    if start:
        found["start"] = time_start()
        text = "first step: after {cold:.1f} s with nothing compiled, {warm:.2f} s warm"
        say((text + "; run of one step: {over:.2f} s").format(**found["start"]))
    print(json.dumps(found, indent=2) if as_json else table(found, old, HEAD, row))


def table(found: dict, old: dict, head: str, row) -> str:
    """Return the table of a bench."""
    return "\n".join([head, *(row(n, t, old.get(n)) for n, t in found["cases"].items())])


def run_case(expectation, folder: Path, threads: int | None = None) -> Path:
    """Run the deck of an expectation quietly into a folder and return that folder."""
    how = {"overwrite": True, "progress": "none", "verbosity": 0, "threads": threads}
    options = RunOptions(output=folder, overrides=expectation.settings, **how)
    run_deck(expectation.deck_path, options)
    return folder


def verify_cases(
    names: Sequence[str],
    effort: str,
    update: bool,
    page: Path | None,
    output: Path | None,
    threads: int | None,
    as_json: bool,
) -> bool:
    """Run cases, print what they give and how far off it is; return whether all are right."""
    import json
    from tempfile import TemporaryDirectory
    from time import perf_counter

    from cramp_cli.output.atomic import plain
    from cramp_cli.study import verify

    results, begun = [], perf_counter()
    with TemporaryDirectory() as temporary:
        for case in verify.chosen(names, effort):
            run = run_case(case, (output or Path(temporary)) / case.name, threads)
            found = verify.judge(case, run)
            if update:
                case, found = _frozen(case, found, run)
            results.append((case, found))
            say(f"{case.name}: {perf_counter() - begun:.0f} s")
        if page:
            from cramp_cli.study.verify_page import write_page

            say(str(write_page(page, results, output or Path(temporary))))
    found = [one for _, findings in results for one in findings]
    answer = [one.as_json() for one in found]
    print(json.dumps(plain(answer), indent=2) if as_json else verify.table(found))
    return all(one.passed for one in found)


def _frozen(case, found, run: Path):
    """Freeze what was found, unless a bound is missed; return case and findings as they are now."""
    from cramp_cli.output.exits import FolderError
    from cramp_cli.study import verify

    try:
        case = verify.freeze(case, found)
    except FolderError as refused:
        say(str(refused))
        return case, found
    return case, verify.judge(case, run)


def readable(needs: dict) -> dict[str, object]:
    """Return an estimate as lines for people."""
    return {
        name.removesuffix("_bytes"): human_bytes(value) if name.endswith("_bytes") else value
        for name, value in needs.items()
    }


def say(text: str) -> None:
    """Print on stderr, where people read."""
    print(text, file=sys.stderr, flush=True)
