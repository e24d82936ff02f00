"""Lists of points from files: one `x,y` row for each point, in metres."""

from math import isfinite
from pathlib import Path

from cramp_cli.schema.section import PreparationError
from cramp_cli.schema.units import shown

LARGEST = 16 * 1024 * 1024  # bytes


def read_into(data: dict, folder: Path | None) -> dict:
    """Replace the key `file` of a section by the points that the file holds."""
    name = data.get("file")
    if not isinstance(name, str) or "points" in data:
        return data
    rest = {key: value for key, value in data.items() if key != "file"}
    return {**rest, "points": read_points(name, folder or Path())}


def read_points(name: str, folder: Path) -> list[list[float]]:
    """Return the points of a csv file; blank lines, # comments and one header row are skipped."""
    points = []
    for number, line in enumerate(_text(name, folder).splitlines(), 1):
        row = line.split("#")[0].strip()
        if not row:
            continue
        try:
            x, y = map(float, row.split(","))
            if not isfinite(x + y):
                raise PreparationError(("file",), f"line {number} of {name} is not finite")
            points.append([x, y])
        except ValueError:
            if points or any(letter.isdigit() for letter in row):
                message = f"line {number} of {name} is no 'x,y' row (got {shown(row)})"
                raise PreparationError(("file",), message) from None
    return points


def _text(name: str, folder: Path) -> str:
    try:
        path = folder / name
        if path.exists() and not path.is_file():
            raise PreparationError(("file",), f"{shown(name)} is no file")
        with path.open("rb") as file:
            raw = file.read(LARGEST + 1)
        if len(raw) > LARGEST:
            raise PreparationError(("file",), f"is larger than {LARGEST >> 20} MiB")
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise PreparationError(("file",), f"{shown(name)} is not UTF-8 text") from None
    except (OSError, ValueError) as problem:
        reason = getattr(problem, "strerror", None) or problem
        raise PreparationError(("file",), f"cannot read {shown(name)}: {reason}") from None
