"""What the commands do, apart from their options: cli.py reads words, this module acts."""

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from cramp_cli.output.machine import choose_threads, human_bytes, refuse_too_big
from cramp_cli.output.tables import facts_text

LARGEST_BUILT = 1.64e9  # bytes that `check` may use: those of five million particles
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


def run_deck(path: Path, options: RunOptions) -> Path | None:
    """Read, check, estimate, build and simulate a deck; return the folder of the results."""
    threads = choose_threads(options.threads)
    folder = options.output or Path(f"{path.stem}.run")
    deck = load_deck(path, options.overrides, options.strict)
    from cramp_cli.build import build, estimate  # late: imports numba
    from cramp_cli.output.folder import RunFolder

    needs = estimate(deck)
    refuse_too_big(needs, folder, options.max_memory, options.max_disk)
    if options.dry_run:
        say(facts_text(f"{path}: nothing wrong; a run would take", readable(needs)))
        return None
    with RunFolder(folder, options.overwrite) as claimed:
        model, state = build(deck)
        _simulate(deck, model, state, claimed, threads, options)
    return folder


def _simulate(deck, model, state, folder, threads: int, options: RunOptions) -> None:
    from cramp_cli.deck.deck import to_yaml
    from cramp_cli.output.log import Reporter
    from cramp_cli.output.run import RunOutputs
    from cramp_cli.simulation import simulate

    texts = deck.source_text, to_yaml(deck.resolved())
    with RunOutputs(folder, *texts, end_time=deck.solver.end_time, threads=threads) as outputs:
        reporter = Reporter(outputs.log, options.progress, options.verbosity)
        for warning in deck.warnings:
            outputs.log.write("warning", str(warning))
        with reporter:
            how = {"threads": threads, "profile": options.profile}
            summary = simulate(deck, model, state, outputs, reporter, **how)
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
        from cramp_cli.build import build, estimate  # late: imports numba

        needs = estimate(deck)
        if needs["memory_bytes"] > LARGEST_BUILT:
            answer["notes"].append(f"{path}: {NOT_BUILT}")
        else:
            build(deck)
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


def warm_up() -> str:
    """Compile all kernels; return how long it took."""
    from time import perf_counter

    from cramp_cli.warm import run_small_cases

    begun = perf_counter()
    run_small_cases()
    return f"{perf_counter() - begun:.1f} s"


def readable(needs: dict) -> dict[str, object]:
    """Return an estimate as lines for people."""
    return {
        name.removesuffix("_bytes"): human_bytes(value) if name.endswith("_bytes") else value
        for name, value in needs.items()
    }


def say(text: str) -> None:
    """Print on stderr, where people read."""
    print(text, file=sys.stderr, flush=True)
