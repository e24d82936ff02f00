"""From a run's folder to files of other programs: VTU with PVD, and CSV."""

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np

from cramp_cli.output.atomic import write_text
from cramp_cli.output.exits import FolderError
from cramp_cli.output.fields import Frame, read_frames

KINDS = ("particles", "cracks")
PVD_HEAD = '<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1">\n<Collection>\n'
AXES = {3: "xyz", 9: ("xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz")}


class Form(NamedTuple):
    """How to write one frame, and the file that lists the frames."""

    write: Callable[[Path, Frame], None]
    index: Callable[[Path, str, list[tuple[float, str]]], Path]


def export(run: Path, target: Path, form: str) -> list[Path]:
    """Write every frame of a run in another form.

    run: folder of the run
    target: folder for the new files, made if need be
    form: vtu or csv
    returns: the files to open, one for particles and one for cracks
    """
    kinds = [kind for kind in KINDS if (run / f"{kind}.h5").exists()]
    if not kinds:
        raise FolderError(f"{run}: no particles.h5 or cracks.h5 to export")
    target.mkdir(parents=True, exist_ok=True)
    return [_export_kind(run / f"{kind}.h5", target, kind, form) for kind in kinds]


def _export_kind(data: Path, target: Path, kind: str, form: str) -> Path:
    frames = []
    for count, frame in enumerate(read_frames(data)):
        name = f"{kind}_{count:06d}.{form}"
        FORMS[form].write(target / name, frame)
        frames.append((frame.time, name))
    return FORMS[form].index(target, kind, frames)


def write_vtu(path: Path, frame: Frame) -> None:
    """Write one frame as VTU: a vertex per particle, a line per piece of crack."""
    import meshio  # late: keeps `cramp --help` fast

    cells = [("vertex", np.arange(len(frame.points))[:, None])]
    owner = None
    if frame.offsets is not None:
        pieces, owner = _pieces(frame.offsets)
        cells = [("line", pieces)]
    per_point = {k: v for k, v in frame.fields.items() if len(v) == len(frame.points)}
    per_line = {k: [v[owner]] for k, v in frame.fields.items() if k not in per_point}
    meshio.Mesh(frame.points, cells, per_point, per_line).write(path)


def write_csv(path: Path, frame: Frame) -> None:
    """Write one frame as a table with one row per point."""
    columns = {f"points_{axis}": values for axis, values in zip("xyz", frame.points.T, strict=True)}
    if frame.offsets is not None:
        columns["line"] = np.repeat(np.arange(len(frame.offsets) - 1), np.diff(frame.offsets))
    for name, values in frame.fields.items():
        if len(values) == len(frame.points):
            columns |= _components(name, values)
    table = np.column_stack([values.astype(float) for values in columns.values()])
    np.savetxt(path, table, fmt="%.9g", delimiter=",", header=",".join(columns), comments="")


def write_pvd(target: Path, kind: str, frames: list[tuple[float, str]]) -> Path:
    """Write the file that gives ParaView the time of every VTU file."""
    lines = [f'<DataSet timestep="{time:.17g}" file="{name}"/>\n' for time, name in frames]
    path = target / f"{kind}.pvd"
    write_text(path, PVD_HEAD + "".join(lines) + "</Collection>\n</VTKFile>\n")
    return path


def write_times(target: Path, kind: str, frames: list[tuple[float, str]]) -> Path:
    """Write the table that gives the time of every CSV file."""
    path = target / f"{kind}.csv"
    write_text(path, "time,file\n" + "".join(f"{time:.17g},{name}\n" for time, name in frames))
    return path


def _pieces(offsets: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the point pairs of all pieces and the line each belongs to."""
    first = np.setdiff1d(np.arange(offsets[-1]), offsets[1:] - 1)
    owner = np.searchsorted(offsets, first, side="right") - 1
    return np.column_stack([first, first + 1]), owner


def _components(name: str, values: np.ndarray) -> dict[str, np.ndarray]:
    if values.ndim == 1:
        return {name: values}
    axes = AXES[values.shape[1]]
    return {f"{name}_{axis}": part for axis, part in zip(axes, values.T, strict=True)}


FORMS = {"vtu": Form(write_vtu, write_pvd), "csv": Form(write_csv, write_times)}
