"""Never run a stale kernel.

Numba looks only at the file that holds a kernel when it decides whether its cached machine code is
still good; a formula edited in another file would go unnoticed. So the cache folder is named by a
hash of all sources that kernels are made of: change any of them and everything compiles anew.
"""

import hashlib
import json
import os
import tempfile
from pathlib import Path

PACKAGE = Path(__file__).resolve().parent.parent
WITH_KERNELS = (
    "boundary",
    "cohesive",
    "contact",
    "cracks",
    "materials",
    "numerics",
    "shapes",
    "state",
    "transfer",
)


def source_hash(folders=("",)) -> str:
    """Return the first 16 hex digits of the SHA-256 over the sources of the package or of parts."""
    digest = hashlib.sha256()
    for path in sorted(path for folder in folders for path in (PACKAGE / folder).rglob("*.py")):
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


def cache_folder() -> Path:
    """Return the cache folder of exactly these kernels; those that check indices have their own."""
    checked = "-bounds" if os.environ.get("NUMBA_BOUNDSCHECK", "0") not in ("", "0") else ""
    return cache_root() / f"{source_hash(WITH_KERNELS)}{checked}"


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
