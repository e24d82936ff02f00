"""What a run's folder tells about the run."""

import csv
import json
from pathlib import Path

from cramp_cli.output.exits import FolderError
from cramp_cli.output.fields import count_frames
from cramp_cli.output.folder import refuse_no_run
from cramp_cli.output.tables import duration

WORDS = ("crack", "tip", "status")


def describe(run: Path) -> dict:
    """Return manifest, status and number of frames of a run."""
    refuse_no_run(run)
    frames = {kind: count_frames(run / f"{kind}.h5") for kind in ("particles", "cracks")}
    status = _read(run / "status.json")
    manifest = _read(run / "manifest.json")
    return {"manifest": manifest, "status": status, "frames": frames, "tips": last_tips(run)}


def facts(record: dict) -> dict[str, object]:
    """Return the lines of `cramp info` from what `describe` found."""
    manifest, status = record["manifest"], record["status"]
    known = {
        "status": manifest["status"],
        "error": manifest["error"],
        "step": status.get("step"),
        "time": f"{status.get('time', 0.0):.6g} s of {status.get('end_time') or 0.0:.6g} s",
        "started": manifest["start"],
        "parts": _parts(manifest.get("parts", [])),
        "wall time": duration(manifest["wall_time"] or status.get("wall_time")),
        "host": f"{manifest['host']}, {manifest['threads']} threads",
        "cramp": f"{manifest['versions']['cramp']} ({manifest['source_hash']})",
        "deck sha256": manifest["deck_sha256"][:16],
        "frames": ", ".join(f"{count} of {kind}" for kind, count in record["frames"].items()),
    }
    return {name: value for name, value in known.items() if value not in (None, "")}


def _parts(parts: list[dict]) -> str:
    """Return how often a run was taken up again, nothing if it ran in one piece."""
    steps = ", ".join(str(part["step"]) for part in parts[1:])
    return f"{len(parts)}, taken up at step {steps}" if steps else ""


def last_tips(run: Path) -> list[dict]:
    """Return the last row of cracks.csv of every tip, numbers as numbers."""
    path = run / "cracks.csv"
    if not path.exists():
        return []
    with path.open(encoding="utf-8", newline="") as file:
        rows = {(row["crack"], row["tip"]): row for row in csv.DictReader(file)}
    return [_with_numbers(row) for row in rows.values()]


def _with_numbers(row: dict) -> dict:
    return {name: text if name in WORDS else float(text) for name, text in row.items()}


def _read(path: Path) -> dict:
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise FolderError(f"{path}: cannot be read ({error})") from None
