"""The words of `cramp sweep`: many runs from one deck."""

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

sweep = typer.Typer(no_args_is_help=True, help="Run many cases of one deck and collect them.")

Study = Annotated[Path, typer.Argument(help="The study, a YAML file.", metavar="STUDY")]
Folder = Annotated[
    Path | None, typer.Option("-o", "--output", help="Folder of the runs [<study>.sweep].")
]
MOST_UNASKED = 100  # cases


class Backend(StrEnum):
    """Who runs the cases."""

    local = "local"
    slurm = "slurm"
    dask = "dask"


@sweep.command()
def expand(
    study: Study,
    names: Annotated[bool, typer.Option("--names", help="Only their names, a line each.")] = False,
):
    """List all cases with what varies, as CSV."""
    from cramp_cli.study.collect import cases_table
    from cramp_cli.study.manage import open_study

    cases = open_study(study).cases
    print("\n".join(case.name for case in cases) if names else cases_table(cases).rstrip())


@sweep.command()
def run(
    context: typer.Context,
    study: Study,
    output: Folder = None,
    jobs: Annotated[
        int | None,
        typer.Option("-j", "--jobs", min=1, help="Cases at a time [processors / threads]."),
    ] = None,
    threads: Annotated[int, typer.Option("-t", "--threads", min=1, help="Of each run.")] = 1,
    only: Annotated[
        str | None, typer.Option(metavar="CASE", help="Run this case; end with its exit code.")
    ] = None,
    force: Annotated[
        bool, typer.Option("--force", help=f"Run more than {MOST_UNASKED} cases.")
    ] = False,
    backend: Annotated[
        Backend, typer.Option(help="Here, as a script for sbatch, or on dask workers.")
    ] = Backend.local,
    scheduler: Annotated[
        str, typer.Option(metavar="ADDRESS", help="Of dask, like tcp://host:8786.")
    ] = "",
):
    """Run the cases that are not done yet; print the folder.

    Cases that failed, hung or were killed are run again. Ends with 1 if any case is not done.
    """
    from cramp_cli.study.manage import SweepOptions, run_study

    if (backend is Backend.dask) != bool(scheduler):
        raise typer.BadParameter("--backend dask and --scheduler ADDRESS go together")
    most = None if force or only else MOST_UNASKED
    loud = context.obj.verbosity
    options = SweepOptions(output, jobs, threads, only, backend.value, scheduler, loud, most)
    code, written = run_study(study, options)
    print(written)
    raise typer.Exit(code)


@sweep.command()
def status(
    study: Study,
    output: Folder = None,
    as_json: Annotated[bool, typer.Option("--json", help="Answer in JSON.")] = False,
):
    """Tell how many cases are done, and why others are not."""
    from cramp_cli.study.manage import tell_study

    print(tell_study(study, output, as_json))


@sweep.command()
def collect(
    study: Study,
    output: Folder = None,
    table: Annotated[
        Path | None,
        typer.Option("--to", help="The table, .csv or .parquet [<study>.sweep/results.csv]."),
    ] = None,
    wall_time: Annotated[
        bool, typer.Option("--wall-time", help="With the seconds each case took.")
    ] = False,
):
    """Write a table with a row per case, as CSV or Parquet."""
    from cramp_cli.study.manage import collect_study

    print(collect_study(study, output, table, wall_time))
