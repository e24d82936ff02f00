"""Never run a stale kernel.

Numba looks only at the file that holds a kernel when it decides whether its cached machine code is
still good; a formula edited in another file would go unnoticed. So the cache folder is named by a
hash of all sources of this package: change any of them and everything compiles anew.
"""

import hashlib
import os
import tempfile
from pathlib import Path

PACKAGE = Path(__file__).resolve().parent.parent


def source_hash() -> str:
    """Return the first 16 hex digits of the SHA-256 over all sources of the package."""
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


def cache_folder() -> Path:
    """Return the cache folder of exactly this source."""
    return cache_root() / source_hash()


def _nearest_existing(path: Path) -> Path:
    while not path.exists():
        path = path.parent
    return path
