"""The words of commands about a run: info, export, diff, plot, report."""

import json
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from cramp_cli.cli.words import Json, Run


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


def report(
    path: Annotated[
        Path, typer.Argument(help="The folder of a run or of a sweep.", metavar="FOLDER")
    ],
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="The page [FOLDER/report.html].")
    ] = None,
):
    """Write one HTML page about a run or a sweep, to look at or send."""
    from cramp_cli.study.manage import report_folder

    print(report_folder(path, output))
