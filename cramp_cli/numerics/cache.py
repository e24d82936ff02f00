"""What names the sources of the program, and where it keeps things for later runs."""

import hashlib
import json
import os
import tempfile
from pathlib import Path

PACKAGE = Path(__file__).resolve().parent.parent


def source_hash() -> str:
    """Return the first 16 hex digits of the SHA-256 over the sources of the package."""
    digest = hashlib.sha256()
    for path in sorted(PACKAGE.rglob("*.py")):
        digest.update(path.relative_to(PACKAGE).as_posix().encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def cache_root() -> Path:
    """Return the folder for kernels: CRAMP_CACHE_DIR, the user's cache, or a temporary one."""
    chosen = os.environ.get("CRAMP_CACHE_DIR")
    if chosen:
        return Path(chosen)
    base = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")
    if os.path.isabs(base) and os.access(_nearest_existing(Path(base)), os.W_OK):
        return Path(base) / "cramp"
    return Path(tempfile.gettempdir()) / f"cramp-cache-{os.getuid()}"


def recall(name: str) -> dict:
    """Return what an earlier run has remembered under a name; nothing if it can not be read."""
    try:
        found = json.loads((cache_root() / f"{name}.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return found if isinstance(found, dict) else {}


def remember(name: str, things: dict) -> None:
    """Keep a dictionary for later runs, if there is a place for it."""
    path = cache_root() / f"{name}.json"
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        part = path.with_name(f"{path.name}.{os.getpid()}")
        part.write_text(json.dumps(things), encoding="utf-8")
        part.replace(path)
    except OSError:
        return


def _nearest_existing(path: Path) -> Path:
    while not path.exists():
        path = path.parent
    return path
