"""Lists of points from files: one `x,y` row for each point, in metres or a unit of the deck."""

from collections.abc import Iterator
from math import isfinite
from pathlib import Path

from pydantic import TypeAdapter, ValidationError

from cramp_cli.deck.files import read_bytes
from cramp_cli.schema.section import PreparationError, Wrong
from cramp_cli.schema.units import Length, shown

UNIT = "length of a 1 in the file, such as 1 mm; a metre if not given"
LENGTH = TypeAdapter(Length)


def read_into(data: dict, folder: Path | None) -> dict:
    """Replace the key `file` of a section by the points that the file holds."""
    name = data.get("file")
    if not isinstance(name, str) or "points" in data:
        return data
    try:
        unit = LENGTH.validate_python(data.get("unit", 1.0))
    except ValidationError:
        return data  # the field will tell what is wrong with it
    rest = {key: value for key, value in data.items() if key not in ("file", "unit")}
    points = read_points(name, folder or Path())
    return {**rest, "points": [[unit * x, unit * y] for x, y in points]}


def unit_without_file(keys: set[str]) -> Iterator[Wrong]:
    """Yield a mistake if points of the deck itself are given a unit, which they carry already."""
    if "unit" in keys and "file" not in keys:
        yield ("unit",), "goes with file; points in the deck carry their own units"


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
        return read_bytes(name, folder).decode("utf-8-sig")
    except UnicodeDecodeError:
        raise PreparationError(("file",), f"{shown(name)} is not UTF-8 text") from None
