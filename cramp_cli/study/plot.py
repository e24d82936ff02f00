"""All pictures of a run: each kind by its name, written beside the run."""

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from cramp_cli.output.exits import FolderError
from cramp_cli.schema.unit_text import UnitError, base_units, split
from cramp_cli.study.crack_path import draw_path
from cramp_cli.study.curves import draw_columns, draw_energy, draw_tips
from cramp_cli.study.figures import drawing, save
from cramp_cli.study.results import require_run
from cramp_cli.study.snapshots import View, animate, draw_field

KINDS = {
    "tips": "cracks.csv",
    "energy": "history.csv",
    "path": "cracks.h5",
    "field": "particles.h5",
    "animation": "particles.h5",
    "movie": "particles.h5",
}  # kind of picture: the file it needs
MOVING = {"animation": ".gif", "movie": ".mp4"}
USUAL = ("tips", "energy", "path", "field")


class PlotOptions(NamedTuple):
    """The options of `cramp plot`."""

    kinds: Sequence[str] = ()  # empty: those of USUAL that the run has files for
    columns: Sequence[str] = ()  # drawn over time in a picture of their own, alone if given alone
    references: Sequence[Path] = ()
    view: View = View()
    form: str = "png"


def plot(run: Path, target: Path, options: PlotOptions) -> list[Path]:
    """Draw pictures of a run into a folder; return their paths.

    Raises FolderError for what is no run, an unknown column, or a file that is missing.
    """
    require_run(run)
    kinds = _chosen(run, options)
    with drawing() as plt:
        made = [_draw(plt, run, target, kind, options) for kind in kinds]
        if options.columns:
            figure = draw_columns(plt, run, options.columns, options.references)
            made.append(save(figure, target / f"{'-'.join(options.columns)}.{options.form}"))
    if not made:
        raise FolderError(f"{run}: holds nothing to draw yet")
    return made


def seconds(text: str | None) -> float | None:
    """Return the time that a text such as '1 ms' tells (s); None for None.

    Raises FolderError for another text.
    """
    if text is None:
        return None
    try:
        number, unit = split(text)
        scale, powers = base_units(unit or "s")
        if powers == base_units("s")[1]:
            return float(number * scale)
    except UnitError:
        pass
    raise FolderError(f"--time '{text}' is no time; write it like '1 ms'")


def _chosen(run: Path, options: PlotOptions) -> list[str]:
    for kind in options.kinds:
        if not (run / KINDS[kind]).exists():
            raise FolderError(f"{run}: has no {KINDS[kind]}, which the picture '{kind}' is made of")
    if options.kinds or options.columns:
        return list(options.kinds)
    return [kind for kind in USUAL if (run / KINDS[kind]).exists()]


def _draw(plt, run: Path, target: Path, kind: str, options: PlotOptions) -> Path:
    path = target / f"{kind}.{options.form}"
    if kind == "tips":
        return save(draw_tips(plt, run, options.references), path)
    if kind == "energy":
        return save(draw_energy(plt, run), path)
    if kind in MOVING:
        return animate(plt, run, options.view, path.with_suffix(MOVING[kind]))
    draw = {"path": draw_path, "field": draw_field}[kind]
    return save(draw(plt, run, options.view), path)
