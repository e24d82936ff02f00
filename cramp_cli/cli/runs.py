"""The words of `cramp run` and `cramp resume`."""

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from cramp_cli.cli.words import Deck, Run, Sets, Strict, Threads


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


def _parser(name: str):
    """Return a parser of an option: the function of that name of output/machine.py."""

    def parse(text):
        from cramp_cli.output import machine

        try:
            return getattr(machine, name)(text)
        except ValueError as error:
            raise typer.BadParameter(str(error)) from None

    return parse


EndTime = Annotated[
    str | None,
    typer.Option("--end-time", metavar="TIME", help="Stop at this time, like '0.2 ms'."),
]
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
    end_time: EndTime = None,
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


def resume(
    context: typer.Context,
    path: Run,
    end_time: EndTime = None,
    threads: Threads = None,
    progress: Shown = Progress.auto,
    max_memory: MaxMemory = None,
    max_disk: MaxDisk = None,
    profile: Profile = False,
    max_wall: MaxWall = None,
    checkpoint_every: CheckpointEvery = "10m",
):
    """Go on with a run that was stopped, killed or failed.

    With a later --end-time a finished run goes on too. Rows and frames behind the newest sound
    checkpoint are cut off: the files become those of a run that was never interrupted.
    """
    from cramp_cli.commands import resume_folder

    how = _how(context, threads, progress, max_memory, max_disk, profile, max_wall)
    print(resume_folder(path, how._replace(checkpoint_every=checkpoint_every), end_time))
