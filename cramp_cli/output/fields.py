"""Particles and cracks over time: numbers in HDF5, beside them an XDMF file that ParaView opens.

Every frame has its own points, so that particles may move and cracks may grow. The HDF5 file is
opened, extended and closed for each frame and the XDMF file replaced as a whole after it: both can
be read at any moment, also after the run was killed.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

from cramp_cli.output.atomic import write_text
from cramp_cli.output.exits import FolderError
from cramp_cli.output.hdf5 import extended, opened
from cramp_cli.output.xdmf import collection, grid

OLD = ("earliest", "v110")  # VTK reads no points of newer files
PACKED = {"compression": "gzip", "compression_opts": 1, "shuffle": True}


class Unreadable(FolderError):
    """A file of frames is missing or none of HDF5."""


class Frame(NamedTuple):
    """All particles, or all cracks, at one moment."""

    step: int
    time: float  # s
    points: np.ndarray  # (n, 3), m
    fields: dict[str, np.ndarray]  # name: (n,), (n, 3) or (n, 9); of cracks also (n_lines,)
    offsets: np.ndarray | None  # (n_lines + 1,) first point of every line; None for particles


class FrameWriter:
    """Writes `kind`.h5 and `kind`.xdmf in a folder, one frame after the other.

    real: type of the floating point numbers on disk
    keep: go on after so many frames of the files that are there, forget those behind them
    """

    def __init__(self, folder: Path, kind: str, real: str = "f4", keep: int | None = None) -> None:
        self.data = Path(folder) / f"{kind}.h5"
        self.index = Path(folder) / f"{kind}.xdmf"
        self.kind, self.real = kind, real
        self._grids: list[str] = []
        self.count = 0  # frames so far
        if keep is None:
            self.data.unlink(missing_ok=True)
            self.index.unlink(missing_ok=True)
        else:
            self._take_up(keep)

    def write(
        self,
        step: int,
        time: float,
        points: np.ndarray,
        fields: dict[str, np.ndarray],
        lines: np.ndarray | None = None,
    ) -> None:
        """Add one frame.

        points: (n, 2) or (n, 3) positions (m)
        fields: per point (n,), (n, 2 or 3), (n, 2, 2), (n, 3, 3) or (n, 9); or per line (n_lines,)
        lines: (n_lines + 1,) first point of every line; None if the points are particles
        """
        frame = _tidy(Frame(step, time, points, fields, lines), self.real)
        size, parts = _size(frame)
        with extended(self.data, "a", size, parts, libver=OLD) as file:
            name = f"frame_{self.count:06d}"
            if name in file:  # left by a write that did not come to its end
                del file[name]
            _store(file.create_group(name), frame)
        self._add(name, frame)
        write_text(self.index, collection(self.kind, self._grids))

    def _add(self, name: str, frame: Frame) -> None:
        self.count += 1
        if len(frame.points):  # VTK has no grid without points
            self._grids.append(grid(f"{self.data.name}:/{name}", frame))

    def _take_up(self, keep: int) -> None:
        with _open_whole(self.data, "a") as file:
            names = sorted(file)
            whole = sum("time" in file[name].attrs for name in names[:keep])
            if whole < keep:
                raise FolderError(
                    f"{self.data}: holds {whole} frames, the checkpoint knows of {keep}; the file "
                    "was changed, start the run anew with --overwrite"
                )
            for name in names[:keep]:
                self._add(name, _load(file[name], read=lambda data: data))
            for name in names[keep:]:
                del file[name]
        write_text(self.index, collection(self.kind, self._grids))


def read_frames(path: str | Path) -> Iterator[Frame]:
    """Yield every complete frame of a .h5 file (or of the one beside a .xdmf file), in order."""
    data = Path(path).with_suffix(".h5")
    if not data.exists():
        raise FolderError(f"{data}: no such file")
    with _open_whole(data, "r") as file:
        for name in sorted(file):
            if "time" in file[name].attrs:
                yield _load(file[name])


def count_frames(path: str | Path) -> int:
    """Return how many complete frames a .h5 file holds; none if there is no file."""
    if not Path(path).exists():
        return 0
    with opened(Path(path)) as file:
        return sum("time" in group.attrs for group in file.values())


def tensor_of_plane(values: np.ndarray) -> np.ndarray:
    """Return (n, 9) tensors of (n, 4) components xx, yy, zz, xy."""
    xx, yy, zz, xy = np.asarray(values).T
    zero = np.zeros_like(xx)
    return np.stack([xx, xy, zero, xy, yy, zero, zero, zero, zz], axis=1)


def _open_whole(path: Path, mode: str):
    """Open a file that must be there and whole, or raise Unreadable."""
    try:
        return opened(path, mode if path.exists() else "r", libver=OLD)
    except OSError as error:
        raise Unreadable(f"{path}: cannot be read as HDF5 ({error})") from None


def _size(frame: Frame) -> tuple[int, int]:
    """Return the bytes of a frame before compression, and how many data sets and groups it has."""
    arrays = [frame.points, *frame.fields.values()]
    lines = 0 if frame.offsets is None else frame.offsets.nbytes * 3
    return sum(a.nbytes for a in arrays) + 12 * len(frame.points) + lines, len(arrays) + 4


def _store(group, frame: Frame) -> None:
    _dataset(group, "points", frame.points)
    if frame.offsets is None:
        _dataset(group, "cells", np.arange(len(frame.points), dtype="i4"))
    else:
        _dataset(group, "offsets", frame.offsets)
        _dataset(group, "cells", polylines(frame.offsets))
    for name, values in frame.fields.items():
        _dataset(group, f"fields/{name}", values)
    group.attrs["step"] = frame.step
    group.attrs["time"] = frame.time  # last: a frame without it is not complete


def _dataset(group, name: str, values: np.ndarray) -> None:
    group.create_dataset(name, data=values, **(PACKED if values.size else {}))


def _load(group, read=lambda data: data[()]) -> Frame:
    """Return a frame of a file; `read` makes an array of a dataset, or leaves it on disk."""
    stored = group.get("fields", {})
    fields = {name: read(data) for name, data in stored.items()}
    offsets = read(group["offsets"]) if "offsets" in group else None
    step, time = int(group.attrs["step"]), float(group.attrs["time"])
    return Frame(step, time, read(group["points"]), fields, offsets)


def polylines(offsets: np.ndarray) -> np.ndarray:
    """Return the mixed topology of XDMF: 2 (polyline), number of points, points; of every line."""
    ends = zip(offsets[:-1], offsets[1:], strict=True)
    return np.array([i for a, b in ends for i in (2, b - a, *range(a, b))], dtype="i4")


def _tidy(frame: Frame, real: str) -> Frame:
    """Bring a frame into the shapes and types of the file."""
    offsets = None if frame.offsets is None else np.asarray(frame.offsets, dtype="i4")
    counts = {len(frame.points)} | (set() if offsets is None else {len(offsets) - 1})
    points = _components("points", frame.points, counts, real)
    names = sorted(frame.fields)  # the order in which HDF5 gives them back to a run that goes on
    fields = {name: _components(name, frame.fields[name], counts, real) for name in names}
    return Frame(int(frame.step), float(frame.time), points.reshape(-1, 3), fields, offsets)


def _components(name: str, values: np.ndarray, counts: set[int], real: str) -> np.ndarray:
    values = np.asarray(values)
    if len(values) not in counts:
        raise ValueError(f"field {name}: {len(values)} values for {max(counts)} points")
    values = values.astype(real if values.dtype.kind == "f" else "i4", copy=False)
    if values.shape[1:] == (2,):
        return np.pad(values, ((0, 0), (0, 1)))
    if values.shape[1:] == (2, 2):
        values = np.pad(values, ((0, 0), (0, 1), (0, 1)))
    if values.shape[1:] == (3, 3):
        return values.reshape(-1, 9)
    if values.shape[1:] not in ((), (3,), (9,)):
        raise ValueError(f"field {name}: no way to write the shape {values.shape}")
    return values
