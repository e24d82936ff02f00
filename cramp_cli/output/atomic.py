"""Replace a file as a whole: whoever reads it sees the old text or the new, never a part."""

import contextlib
import json
import os
from pathlib import Path


def write_text(path: Path, text: str) -> None:
    """Write a text file by way of a temporary one beside it."""
    beside = path.with_name(f".{path.name}.{os.getpid()}.tmp")
    try:
        beside.write_text(text, encoding="utf-8", newline="\n")
        os.replace(beside, path)
    except BaseException:
        with contextlib.suppress(OSError):
            beside.unlink()
        raise


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
