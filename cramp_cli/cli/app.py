"""The command line as a whole: its commands in the order of the help, and what holds for all."""

import os
from typing import Annotated

import typer

from cramp_cli import __version__
from cramp_cli.cli import decks, program, results, runs
from cramp_cli.cli.sweeps import sweep
from cramp_cli.cli.words import Settings

app = typer.Typer(
    no_args_is_help=True,
    rich_markup_mode=None,
    help="Fracture simulation with explicit cracks in the material point method.",
)

COMMANDS = {
    "init": decks.init,
    "run": runs.run,
    "resume": runs.resume,
    "check": decks.check,
    "show": decks.show,
    "schema": decks.schema,
    "info": results.info,
    "export": results.export,
    "diff": results.diff,
    "preview": decks.preview,
    "plot": results.plot,
    "report": results.report,
    "doctor": program.doctor,
    "bench": program.bench,
    "verify": program.verify,
}
for name, command in COMMANDS.items():
    app.command(name)(command)
app.add_typer(sweep, name="sweep")


def _show_version(asked: bool) -> None:
    if asked:
        print(f"cramp {__version__}")
        raise typer.Exit


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
