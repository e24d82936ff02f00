"""The commands of cramp: each reads its words, calls one function and prints the answer.

Results go to stdout, everything meant for a person to stderr. What a command needs is imported
inside it, so that `cramp --help` answers at once.
"""

import json
import os
import sys
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from cramp_cli import __version__
from cramp_cli.cli_sweep import sweep

app = typer.Typer(
    add_completion=False,
    no_args_is_help=True,
    rich_markup_mode=None,
    help="Fracture simulation with explicit cracks in the material point method.",
)

app.add_typer(sweep, name="sweep")


class Progress(StrEnum):
    """How a run shows how far it is."""

    auto = "auto"
    bar = "bar"
    lines = "lines"
    none = "none"


class Resume(StrEnum):
    """Whether a run goes on from a checkpoint."""

    never = "never"
    auto = "auto"
    must = "must"


class Picture(StrEnum):
    """Pictures that `plot` draws."""

    tips = "tips"
    energy = "energy"
    path = "path"
    field = "field"
    animation = "animation"
    movie = "movie"


class Ink(StrEnum):
    """Forms of a picture."""

    png = "png"
    pdf = "pdf"
    svg = "svg"


class Form(StrEnum):
    """Files that `export` writes."""

    vtu = "vtu"
    csv = "csv"


@dataclass
class Settings:
    """What holds for all commands."""

    verbosity: int = 1  # 0 quiet, 1 normal, 2 everything


Deck = Annotated[Path, typer.Argument(help="The deck, a YAML file.", metavar="DECK")]
Run = Annotated[Path, typer.Argument(help="The folder of a run.", metavar="RUNDIR")]
Json = Annotated[bool, typer.Option("--json", help="Answer in JSON.")]
Sets = Annotated[
    list[str] | None,
    typer.Option(
        "-s",
        "--set",
        metavar="PATH.TO.KEY=VALUE",
        help="Change one value of the deck; may be given often. Checked like the deck.",
    ),
]
Strict = Annotated[bool, typer.Option("--strict", help="Take every warning as a mistake.")]


def _show_version(asked: bool) -> None:
    if asked:
        print(f"cramp {__version__}")
        raise typer.Exit


def _parser(name: str):
    """Return a parser of an option: the function of that name of output/machine.py."""

    def parse(text):
        from cramp_cli.output import machine

        try:
            return getattr(machine, name)(text)
        except ValueError as error:
            raise typer.BadParameter(str(error)) from None

    return parse


Threads = Annotated[int | None, typer.Option("-t", "--threads", min=1, help="Number of threads.")]
Shown = Annotated[Progress, typer.Option(help="How to show progress.")]
MaxMemory = Annotated[
    int | None,
    typer.Option(
        parser=_parser("parse_bytes"), metavar="SIZE", help="Refuse to use more, like '8 GB'."
    ),
]
MaxDisk = Annotated[
    int | None,
    typer.Option(
        parser=_parser("parse_bytes"), metavar="SIZE", help="Refuse to write more, like '20 GB'."
    ),
]
Profile = Annotated[bool, typer.Option("--profile", help="Say at the end where the time went.")]
MaxWall = Annotated[
    float | None,
    typer.Option(
        parser=_parser("parse_duration"),
        metavar="TIME",
        help="Stop with a checkpoint after so long, like '3h50m'.",
    ),
]
CheckpointEvery = Annotated[
    str,
    typer.Option(
        parser=_parser("parse_interval"),
        metavar="TIME|STEPS",
        help="Between checkpoints: '10m' of time, or '500' steps.",
    ),
]


def _how(context, threads, progress, max_memory, max_disk, profile, max_wall):
    """Return the options that `run` and `resume` share."""
    from cramp_cli.commands import RunOptions

    return RunOptions(
        threads=threads,
        progress=progress.value,
        max_memory=max_memory,
        max_disk=max_disk,
        profile=profile,
        max_wall=max_wall,
        verbosity=context.obj.verbosity,
    )


@app.callback()
def cramp(
    context: typer.Context,
    version: Annotated[
        bool,
        typer.Option("--version", callback=_show_version, is_eager=True, help="Print the version."),
    ] = False,
    verbose: Annotated[
        bool, typer.Option("-v", "--verbose", help="Say more, with tracebacks.")
    ] = False,
    quiet: Annotated[bool, typer.Option("-q", "--quiet", help="Say only what is wrong.")] = False,
    no_color: Annotated[bool, typer.Option("--no-color", help="No colours.")] = False,
):
    context.ensure_object(Settings).verbosity = 0 if quiet else 2 if verbose else 1
    if no_color:
        os.environ["NO_COLOR"] = "1"


@app.command()
def init(
    template: Annotated[str, typer.Argument(help="Which one; see --list.")] = "center_crack",
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="The new file [<template>.yaml].")
    ] = None,
    listed: Annotated[bool, typer.Option("--list", help="Tell all templates.")] = False,
):
    """Write a commented deck that runs within a minute."""
    from cramp_cli.study.templates import list_text, write_template

    if listed:
        print(list_text())
        return
    for written in write_template(template, output):
        print(written)


@app.command()
def run(
    context: typer.Context,
    deck: Deck,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="Folder of the results [<deck>.run].")
    ] = None,
    sets: Sets = None,
    threads: Threads = None,
    overwrite: Annotated[
        bool, typer.Option("--overwrite", help="Replace an earlier run in that folder.")
    ] = False,
    end_time: Annotated[
        str | None,
        typer.Option("--end-time", metavar="TIME", help="Stop at this time, like '0.2 ms'."),
    ] = None,
    dry_run: Annotated[
        bool, typer.Option("--dry-run", help="Check and estimate only; write nothing.")
    ] = False,
    strict: Strict = False,
    progress: Shown = Progress.auto,
    max_memory: MaxMemory = None,
    max_disk: MaxDisk = None,
    profile: Profile = False,
    resume: Annotated[
        Resume, typer.Option(help="Go on from the newest checkpoint in that folder.")
    ] = Resume.never,
    max_wall: MaxWall = None,
    checkpoint_every: CheckpointEvery = "10m",
):
    """Simulate a deck; show J and K of every tip.

    The deck is checked and its need of memory and disk estimated before anything is allocated.
    Prints the folder of the results on stdout; progress goes to stderr.
    """
    from cramp_cli.commands import run_deck

    sets = (sets or []) + ([f"solver.end_time={end_time}"] if end_time else [])
    how = _how(context, threads, progress, max_memory, max_disk, profile, max_wall)
    options = how._replace(output=output, overrides=sets, overwrite=overwrite, dry_run=dry_run)
    options = options._replace(
        strict=strict, resume=resume.value, checkpoint_every=checkpoint_every
    )
    folder = run_deck(deck, options)
    if folder:
        print(folder)


@app.command("resume")
def resume_run(
    context: typer.Context,
    path: Run,
    threads: Threads = None,
    progress: Shown = Progress.auto,
    max_memory: MaxMemory = None,
    max_disk: MaxDisk = None,
    profile: Profile = False,
    max_wall: MaxWall = None,
    checkpoint_every: CheckpointEvery = "10m",
):
    """Go on with a run that was stopped, killed or failed.

    Rows and frames behind the newest sound checkpoint are cut off: the files become those of a run
    that was never interrupted.
    """
    from cramp_cli.commands import resume_folder

    how = _how(context, threads, progress, max_memory, max_disk, profile, max_wall)
    print(resume_folder(path, how._replace(checkpoint_every=checkpoint_every)))


@app.command()
def check(
    decks: Annotated[list[Path], typer.Argument(help="Decks to look at.")],
    sets: Sets = None,
    as_json: Json = False,
    report: Annotated[
        bool,
        typer.Option(
            "--report", help="Wave speeds, time step, steps, particles, memory, disk, K from J."
        ),
    ] = False,
    strict: Strict = False,
):
    """Name every mistake of a deck; run nothing."""
    from cramp_cli.commands import check_deck, say_check
    from cramp_cli.output.atomic import plain
    from cramp_cli.output.exits import DECK

    answers = [check_deck(deck, sets or [], strict, report) for deck in decks]
    if as_json:
        print(json.dumps(plain(answers), indent=2))
    else:
        for answer in answers:
            say_check(answer)
    if not all(answer["valid"] for answer in answers):
        raise typer.Exit(DECK)


@app.command()
def show(deck: Deck, sets: Sets = None):
    """Print a deck with all defaults, in SI units."""
    from cramp_cli.commands import load_deck
    from cramp_cli.deck.deck import to_yaml

    print(to_yaml(load_deck(deck, sets or []).resolved()), end="")


@app.command()
def schema():
    """Print the JSON Schema of a deck, for editors."""
    from cramp_cli.deck.json_schema import deck_schema

    print(json.dumps(deck_schema(), indent=2))


@app.command()
def info(
    path: Run,
    as_json: Json = False,
    tips: Annotated[bool, typer.Option("--tips", help="Only the last J and K of tips.")] = False,
):
    """Tell how a run went, with its last J and K."""
    from cramp_cli.output.look import describe, facts
    from cramp_cli.output.summary import tips_text
    from cramp_cli.output.tables import facts_text

    found = describe(path)
    if as_json:
        print(json.dumps(found["tips"] if tips else found, indent=2))
        return
    if not tips:
        print(facts_text(str(path), facts(found)))
    if found["tips"]:
        print(tips_text(found["tips"]))


@app.command()
def export(
    path: Run,
    form: Annotated[Form, typer.Option("--format", help="Kind of files.")] = Form.vtu,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="Folder for them [RUNDIR/export].")
    ] = None,
):
    """Write all frames as VTU or CSV.

    Prints the files to open: .pvd for ParaView, a table of times and files for CSV.
    """
    from cramp_cli.output.export import export as write_all

    for written in write_all(path, output or path / "export", form.value):
        print(written)


@app.command()
def diff(
    reference: Annotated[Path, typer.Argument(help="Folder of a run, or a CSV or HDF5 file.")],
    new: Annotated[Path, typer.Argument(help="What is compared with it.")],
    rtol: Annotated[
        float, typer.Option(min=0.0, help="Share of the reference that may be off.")
    ] = 5.5e-6,
    atol: Annotated[
        float | None,
        typer.Option(min=0.0, help="What may be off besides [1e-10 of the largest in the column]."),
    ] = None,
    column: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME:RTOL[:ATOL]",
            help="Other limits for one column; may be given often. RTOL inf: any value will do.",
        ),
    ] = None,
    interpolate: Annotated[
        bool,
        typer.Option("--interpolate", help="Compare tables at the times of the reference."),
    ] = False,
    as_json: Json = False,
):
    """Compare two results; tell what differs, where and how far.

    Exit code 1 if something differs.
    """
    from cramp_cli.commands import compare_results
    from cramp_cli.output.atomic import plain
    from cramp_cli.output.exits import DIFFERENT

    report = compare_results(reference, new, rtol, atol, column or [], interpolate)
    print(json.dumps(plain(report.as_json()), indent=2) if as_json else report)
    if not report.alike:
        raise typer.Exit(DIFFERENT)


@app.command()
def preview(
    deck: Deck,
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", help="The picture: .png, .pdf, .svg [<deck>.png]."),
    ] = None,
    sets: Sets = None,
):
    """Draw a deck: bodies, cracks, loads, boundary, grid."""
    from cramp_cli.commands import load_deck
    from cramp_cli.study.preview import preview as draw

    print(draw(load_deck(deck, sets or []), output or Path(f"{deck.stem}.png")))


@app.command()
def plot(
    path: Run,
    pictures: Annotated[
        list[Picture] | None,
        typer.Argument(help="Which ones [all that stand still].", metavar="PICTURE"),
    ] = None,
    columns: Annotated[
        list[str] | None,
        typer.Option("--column", metavar="NAME", help="A column over time; may be given often."),
    ] = None,
    references: Annotated[
        list[Path] | None,
        typer.Option(
            "--reference", metavar="CSV", help="Curves to compare: time and our column names."
        ),
    ] = None,
    field: Annotated[
        str, typer.Option(help="Quantity of the particles, like stress_yy [von_mises].")
    ] = "",
    time: Annotated[str | None, typer.Option(help="Of field and path, like '1 ms' [last].")] = None,
    magnify: Annotated[float, typer.Option(min=0.0, help="Draw the motion that often.")] = 1.0,
    form: Annotated[Ink, typer.Option("--format", help="Kind of files.")] = Ink.png,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="Folder for them [RUNDIR/pictures].")
    ] = None,
):
    """Draw J and K, energies, cracks and fields of a run.

    Pictures: tips, energy, path, field, animation (GIF), movie (MP4, by ffmpeg). Prints the
    files.
    """
    from cramp_cli.study.plot import PlotOptions, View, plot, seconds

    view = View(field, seconds(time), magnify)
    options = PlotOptions(pictures or (), columns or (), references or (), view, form.value)
    for written in plot(path, output or path / "pictures", options):
        print(written)


@app.command()
def report(
    path: Run,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="The page [RUNDIR/report.html].")
    ] = None,
):
    """Write one HTML page about a run, to look at or send."""
    from cramp_cli.study.report import report as write

    print(write(path, output or path / "report.html"))


@app.command()
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


@app.command()
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


@app.command()
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
