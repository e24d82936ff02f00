"""Files that a deck names: read whole, bounded in size, known by their SHA-256."""

import hashlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from pydantic import Field

from cramp_cli.deck.shape import Shape
from cramp_cli.schema.section import PreparationError
from cramp_cli.schema.units import shown

LARGEST = 256 * 1024 * 1024  # bytes


class FileShape(Shape):
    """A shape that stands in a file, which must not change while a run goes on.

    The resolved deck names the file by its whole path and holds its SHA-256: whoever reads that
    deck again, as a resumed run does, gets the same shape or a mistake.
    """

    file: str = Field(description="its file, seen from the deck")
    sha256: str | None = Field(
        None, description="SHA-256 of the file: another one is a mistake; any if not given"
    )

    @classmethod
    def prepare(cls, data: dict, folder: Path | None) -> dict:
        """Find the file and compare it with what it is said to be."""
        name = data.get("file")
        if not isinstance(name, str):
            return data
        digest = hashlib.sha256(read_bytes(name, folder or Path())).hexdigest()
        said = data.get("sha256")
        if isinstance(said, str) and said.lower() != digest:
            message = f"{shown(name)} is another file, with SHA-256 {digest}"
            remedy = "bring the old one back, or drop sha256"
            raise PreparationError(("sha256",), f"{message}; {remedy}")
        path = str(((folder or Path()) / name).absolute())
        return {**data, "file": path, "sha256": digest}

    @property
    def short_name(self) -> str:
        """The name of the file without its folder."""
        return Path(self.file).name


def read_bytes(name: str, folder: Path) -> bytes:
    """Return what a file holds; raise PreparationError, blamed on the key `file`, if it can not."""
    try:
        path = folder / name
        if path.exists() and not path.is_file():
            raise PreparationError(("file",), f"{shown(name)} is no file")
        with path.open("rb") as file:
            raw = file.read(LARGEST + 1)
    except (OSError, ValueError) as problem:
        reason = getattr(problem, "strerror", None) or problem
        raise PreparationError(("file",), f"cannot read {shown(name)}: {reason}") from None
    if len(raw) > LARGEST:
        raise PreparationError(("file",), f"is larger than {LARGEST >> 20} MiB")
    return raw


def digests(data: Any, folder: Path) -> dict[str, str]:
    """Return the SHA-256 of every file that a deck names, by its name there, for the records."""
    names = dict.fromkeys(names_of_files(data))
    return {name: hashlib.sha256(read_bytes(name, folder)).hexdigest() for name in names}


def names_of_files(data: Any) -> Iterator[str]:
    """Yield the values of all keys `file` of a deck."""
    if isinstance(data, dict):
        if isinstance(data.get("file"), str):
            yield data["file"]
        data = list(data.values())
    for value in data if isinstance(data, list) else ():
        yield from names_of_files(value)
