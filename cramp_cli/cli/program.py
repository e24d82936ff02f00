"""The words of commands about the program: doctor, bench, verify."""

import sys
from pathlib import Path
from typing import Annotated

import typer

from cramp_cli.cli.words import Json, Threads


def doctor(
    warmup: Annotated[bool, typer.Option("--warmup", help="Compile all kernels now.")] = False,
):
    """Look at this installation and computer."""
    from cramp_cli.commands import warm_up
    from cramp_cli.output.doctor import examine
    from cramp_cli.output.exits import FILES
    from cramp_cli.output.tables import facts_text

    compiled = {"compiled in": warm_up()} if warmup else {}
    facts, faults = examine()
    print(facts_text("cramp doctor", facts | compiled))
    for fault in faults:
        print(f"problem: {fault}", file=sys.stderr)
    if faults:
        raise typer.Exit(FILES)


def bench(
    threads: Annotated[
        int | None, typer.Option("-t", "--threads", min=1, help="Number of threads.")
    ] = None,
    large: Annotated[bool, typer.Option("--large", help="With 2.5 million particles.")] = False,
    start: Annotated[bool, typer.Option("--start", help="Time a cold and a warm start.")] = False,
    only: Annotated[list[str], typer.Option("--only", help="Cases with this word.")] = (),
    compare: Annotated[
        Path | None, typer.Option("--compare", exists=True, help="An older result, as JSON.")
    ] = None,
    as_json: Json = False,
):
    """Time fixed cases, beside a plain loop.

    In million particle-steps per second, and in "yards": times of the plain loop.
    """
    from cramp_cli.commands import run_bench

    run_bench(threads, large, start, list(only), compare, as_json)


def verify(
    names: Annotated[
        list[str] | None, typer.Argument(help="Cases [all of the effort].", metavar="NAME")
    ] = None,
    quick: Annotated[bool, typer.Option("--quick", help="Within a minute.")] = False,
    full: Annotated[bool, typer.Option("--full", help="With the finest grids.")] = False,
    update: Annotated[
        bool, typer.Option("--update", help="Freeze what is found; refused out of a bound.")
    ] = False,
    report: Annotated[
        Path | None, typer.Option("--report", help="Write a page in Markdown with pictures.")
    ] = None,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="Keep the runs in this folder.")
    ] = None,
    threads: Threads = None,
    as_json: Json = False,
):
    """Run decks that have a reference; tell how far off they are.

    Exit code 1 if a number is out of its bound or has changed.
    """
    from cramp_cli.commands import verify_cases
    from cramp_cli.output.exits import DIFFERENT

    effort = "quick" if quick else "full" if full else "usual"
    if not verify_cases(names or [], effort, update, report, output, threads, as_json):
        raise typer.Exit(DIFFERENT)
