"""Words that several commands share."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer


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
Threads = Annotated[int | None, typer.Option("-t", "--threads", min=1, help="Number of threads.")]
