"""What a report's page draws, small enough to travel with it: curves and frames as plain data."""

import base64
from pathlib import Path
from typing import NamedTuple

import numpy as np

from cramp_cli.output.fields import Frame, read_frames
from cramp_cli.study.curves import BESIDE, ENERGIES, NOISE
from cramp_cli.study.particles import crack_faces, quantities, quantity, usual_quantity
from cramp_cli.study.quantities import label, scale_for
from cramp_cli.study.results import Columns, by_tip, read_table
from cramp_cli.study.snapshots import colour_limits, particle_sizes

MOST_ROWS = 1500  # of a curve
MOST_FRAMES = 40
MOST_SQUARES = 400_000  # of all frames together
LEVELS = 65535  # of a coordinate
TITLES = {"K_I": "K_I", "K_II": "K_II", "J": "J", "energy": "Energy", "energy_error": "Imbalance"}


class Line(NamedTuple):
    """A curve to draw."""

    name: str
    time: np.ndarray  # s
    values: np.ndarray  # SI
    dashed: bool = False
    colour: int = 0
    remarks: list | None = None  # status of each sample, empty where it is ok


def charts(run: Path) -> list[dict]:
    """Return the charts of a run over time: J and K of all tips, energies."""
    history, tips = read_table(run / "history.csv"), by_tip(read_table(run / "cracks.csv"))
    found = [_tip_chart(tips, column) for column in ("K_I", "K_II", "J") if tips]
    return found + ([_energy_chart(history), _error_chart(history)] if history else [])


def _tip_chart(tips: dict[str, Columns], column: str) -> dict:
    lines = []
    for number, (tip, rows) in enumerate(tips.items()):
        remarks = ["" if status == "ok" else str(status) for status in rows["status"]]
        lines.append(Line(tip, rows["time"], rows[column], colour=number, remarks=remarks))
        beside = rows.get(BESIDE[column])
        if beside is not None and np.isfinite(beside).any():
            lines.append(Line(f"{tip}, contour", rows["time"], beside, True, number))
    unit = "J/m^2" if column == "J" else "Pa*m^0.5"
    shared = ("K_I", "K_II") if column.startswith("K") else ("J",)
    largest = [rows[name] for rows in tips.values() for name in shared]
    return _chart(column, unit, lines, largest)


def _energy_chart(history: Columns) -> dict:
    largest = max(np.abs(history[name]).max(initial=0.0) for name in ENERGIES)
    kept = [name for name in ENERGIES if np.abs(history[name]).max(initial=0.0) > NOISE * largest]
    lines = [
        Line(ENERGIES[name][0], history["time"], history[name], name == "external_work", number)
        for number, name in enumerate(kept)
    ]
    return _chart("energy", "J", lines, [line.values for line in lines])


def _error_chart(history: Columns) -> dict:
    error = Line("energy error", history["time"], 100.0 * history["energy_error"])
    return _chart("energy_error", "1", [error], [error.values]) | {"unit": "%"}


def _chart(key: str, unit: str, lines: list[Line], shown: list[np.ndarray]) -> dict:
    """Return a chart; `shown` are the arrays whose size decides unit and least height."""
    scale = scale_for(unit, *(shown or [0.0]))
    largest = max((float(np.nanmax(np.abs(v), initial=0.0)) for v in shown), default=0.0)
    return {
        "title": TITLES[key],
        "unit": scale.unit,
        "least": 0.01 * largest / scale.size,
        "lines": [_line(line, scale.size) for line in lines],
    }


def _line(line: Line, size: float) -> dict:
    keep = slice(None, None, -(-len(line.time) // MOST_ROWS))
    return {
        "name": line.name,
        "time": _digits(line.time[keep]),
        "values": _digits(line.values[keep] / size),
        "dashed": line.dashed,
        "colour": line.colour,
        "remarks": line.remarks[keep] if line.remarks else None,
    }


def _digits(values: np.ndarray) -> list:
    """Return numbers of six digits; None for what is no number."""
    return [float(f"{v:.6g}") if np.isfinite(v) else None for v in values.tolist()]


def film(run: Path) -> dict | None:
    """Return frames of particles and cracks, None if the run wrote none."""
    if not (run / "particles.h5").exists():
        return None
    frames = _spread(list(read_frames(run / "particles.h5")))
    names = [name for name in _shown(frames[-1]) if name] if frames else []
    if not names:
        return None
    cracks = _cracks(run, frames)
    sizes = particle_sizes(run, frames[0])
    kept, step = _thinned(frames, float(sizes.max()))
    low, high = _box(frames, float(sizes.max()))
    return {
        "box": [*low.tolist(), *high.tolist()],
        "size": float(sizes.max()) * step,
        "length": _unit("m", low, high),
        "quantities": [_field(frames, kept, name) for name in names],
        "frames": [
            {"time": frame.time, "points": _packed(_levels(frame.points[kept, :2], low, high))}
            for frame in frames
        ],
        "cracks": [[_face(around) for around in crack_faces(c, f)] if c else [] for f, c in cracks],
    }


def _shown(frame: Frame) -> list[str]:
    known = quantities(frame)
    wanted = [usual_quantity(frame), "stress_yy", "displacement"]
    return [name for name in dict.fromkeys(wanted) if name in known]


def _spread(frames: list[Frame]) -> list[Frame]:
    """Return frames spread evenly over time, first and last among them."""
    if len(frames) <= MOST_FRAMES:
        return frames
    return [frames[round(n)] for n in np.linspace(0, len(frames) - 1, MOST_FRAMES)]


def _cracks(run: Path, frames: list[Frame]) -> list[tuple[Frame, Frame | None]]:
    """Return each frame with the cracks at its moment."""
    path = run / "cracks.h5"
    known = {frame.step: frame for frame in read_frames(path)} if path.exists() else {}
    return [(frame, known.get(frame.step)) for frame in frames]


def _thinned(frames: list[Frame], side: float) -> tuple[np.ndarray, int]:
    """Return which particles are drawn, one of every `step` by `step`, and that step.

    All are, unless the page would become too large; what leaves the grid later is left out.
    """
    count = min(len(frame.points) for frame in frames)
    step = 1
    while count / step**2 * len(frames) > MOST_SQUARES:
        step += 1
    if step == 1:
        return np.arange(count), 1
    bins = np.floor(frames[0].points[:count, :2] / (step * side)).astype(int)
    _, kept = np.unique(bins, axis=0, return_index=True)
    return np.sort(kept), step


def _box(frames: list[Frame], side: float) -> tuple[np.ndarray, np.ndarray]:
    lows = [frame.points[:, :2].min(axis=0) for frame in frames]
    highs = [frame.points[:, :2].max(axis=0) for frame in frames]
    return np.min(lows, axis=0) - side, np.max(highs, axis=0) + side


def _field(frames: list[Frame], kept: np.ndarray, name: str) -> dict:
    shown = [quantity(frame, name) for frame in frames]
    low, high = colour_limits(shown)
    scale = scale_for(shown[0].unit, np.array([low, high]))
    bytes_of = [np.clip((q.values[kept] - low) / (high - low), 0.0, 1.0) * 255 for q in shown]
    return {
        "name": label("von Mises stress" if name == "von_mises" else name.replace("_", " "), scale),
        "low": low / scale.size,
        "high": high / scale.size,
        "signed": shown[0].signed,
        "values": [_packed(np.round(values).astype("u1")) for values in bytes_of],
    }


def _levels(points: np.ndarray, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    return np.round((points - low) / (high - low) * LEVELS).astype("<u2")


def _packed(values: np.ndarray) -> str:
    return base64.b64encode(np.ascontiguousarray(values).tobytes()).decode("ascii")


def _face(around: np.ndarray) -> list:
    """Return both faces of a crack as lists of coordinates (m)."""
    return [[float(f"{x:.6g}") for x in face.ravel()] for face in np.split(around, 2)]


def _unit(unit: str, *values) -> dict:
    scale = scale_for(unit, *values)
    return {"size": scale.size, "unit": scale.unit}
