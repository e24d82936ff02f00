"""Replace a file as a whole: whoever reads it sees the old one or the new, never a part."""

import contextlib
import json
import os
from collections.abc import Iterator
from pathlib import Path

TEMPORARY = ".*.tmp"  # what a killed process may leave


@contextlib.contextmanager
def replaced(path: Path, *, durable: bool = False) -> Iterator[Path]:
    """Give a temporary path to write to; it takes the place of `path` when all went well.

    durable: wait until the disk holds it, so that it outlives a loss of power
    """
    beside = path.with_name(f".{path.name}.{os.getpid()}.tmp")
    try:
        yield beside
        if durable:
            sync(beside)
        os.replace(beside, path)
        if durable:
            sync(path.parent)
    except BaseException:
        with contextlib.suppress(OSError):
            beside.unlink()
        raise


def sync(path: Path) -> None:
    """Wait until the disk holds a file, or the names in a folder."""
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def sweep(folder: Path) -> None:
    """Remove what processes that were killed have left half written."""
    for path in folder.glob(TEMPORARY):
        path.unlink(missing_ok=True)


def write_text(path: Path, text: str) -> None:
    """Write a text file by way of a temporary one beside it."""
    with replaced(path) as beside:
        beside.write_text(text, encoding="utf-8", newline="\n")


def write_json(path: Path, record: dict) -> None:
    """Write a record as JSON; numbers of numpy become plain, NaN and infinity become null."""
    write_text(path, json.dumps(plain(record), indent=2, ensure_ascii=False) + "\n")


def plain(value):
    """Return a value as JSON can hold it."""
    if isinstance(value, dict):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if hasattr(value, "tolist"):
        return plain(value.tolist())
    if isinstance(value, float):
        return value if abs(value) < float("inf") else None
    return value if isinstance(value, str | int | bool | None) else str(value)
