"""Machine code on disk, kept under a hash of all that it was made of.

Numba looks only at the file that holds a kernel when it decides whether its cached machine code is
still good; a formula edited in another file would go unnoticed. A kernel is made of its own module,
of those that this one imports, of the bodies that are chosen by the type of an argument
(dispatch.py), and of the fields of the records it may be handed. The hash of these names its
folder: a change anywhere compiles what it touches anew and nothing else, and two copies of the same
sources share their kernels wherever they lie.
"""

import ast
import hashlib
import os
import re
from functools import cache
from pathlib import Path

from numba.core.caching import CacheImpl

from cramp_cli.numerics.cache import PACKAGE, cache_root, recall, remember, source_hash

NAME = PACKAGE.name
DISPATCH = f"{NAME}.numerics.dispatch"
STATES = 8  # of the sources, of which the hashes are remembered
IMPLEMENTS = re.compile(r"^@(\w+)\.implement\(", re.MULTILINE)


def kernel_folder(path: Path) -> Path:
    """Return the folder for the machine code of the kernels in a file of the package."""
    module = module_of(path)
    return _folder(module, _hashes()[module])


def kernel_folders() -> list[Path]:
    """Return the folders of all modules, whether they exist or not."""
    return [_folder(module, made_of) for module, made_of in _hashes().items()]


def _folder(module, made_of) -> Path:
    """Return the folder of a module; kernels that check indices have their own."""
    checked = "-bounds" if os.environ.get("NUMBA_BOUNDSCHECK", "0") not in ("", "0") else ""
    return cache_root() / "kernels" / f"{module}-{made_of}{checked}"


def module_of(path: Path) -> str:
    """Return the name of the module in a file of the package."""
    parts = path.relative_to(PACKAGE.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


@cache
def _hashes() -> dict:
    """Return the hash of every module; they are found once for each state of the sources."""
    now = source_hash()
    known = recall("kernel_hashes")
    if now not in known:
        latest = list(known.items())[1 - STATES :]
        known = dict(latest) | {now: hashes_of(read_sources())}
        remember("kernel_hashes", known)
    return known[now]


def read_sources() -> dict:
    """Return the text of every module of the package, by its name."""
    return {module_of(p): p.read_text(encoding="utf-8") for p in sorted(PACKAGE.rglob("*.py"))}


def hashes_of(sources: dict) -> dict:
    """Return 16 hex digits for every module: the SHA-256 over all its kernels may be made of."""
    trees = {name: ast.parse(text) for name, text in sources.items()}
    imports = {name: _imported(tree, sources) for name, tree in trees.items()}
    bodies = {name: _bodies_elsewhere(name, sources, imports) for name in sources}
    records = "".join(_records(tree) for tree in trees.values())
    hashes = {}
    for name in sources:
        digest = hashlib.sha256(records.encode())
        for part in sorted(_made_of(name, imports, bodies)):
            digest.update(part.encode() + sources[part].encode())
        hashes[name] = digest.hexdigest()[:16]
    return hashes


def _imported(tree, sources) -> set:
    """Return the modules of the package that a module imports."""
    found = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module and node.module.startswith(NAME):
            found |= {node.module} | {f"{node.module}.{alias.name}" for alias in node.names}
        elif isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
    return found & set(sources)


def _bodies_elsewhere(name, sources, imports) -> set:
    """Return the modules with bodies for what a module declares to be chosen by type."""
    if DISPATCH not in imports[name]:
        return set()
    declared = set(re.findall(r"^def (\w+)\(", sources[name], re.MULTILINE))
    users = (n for n in sources if name in imports[n])
    return {n for n in users if declared & set(IMPLEMENTS.findall(sources[n]))}


def _made_of(name, imports, bodies) -> set:
    """Return a module with all that it is made of."""
    found, left = set(), {name}
    while left:
        one = left.pop()
        found.add(one)
        left |= (imports[one] | bodies[one]) - found
    return found


def _records(tree) -> str:
    """Return the fields of all named tuples of a module, as they are declared."""
    return "".join(
        ast.dump(node)
        for node in ast.walk(tree)
        if isinstance(node, ast.ClassDef)
        and any(isinstance(base, ast.Name) and base.id == "NamedTuple" for base in node.bases)
    )


class Locator:
    """Where numba keeps the machine code of one function of the package."""

    def __init__(self, function, path):
        self._line, self._folder = function.__code__.co_firstlineno, kernel_folder(Path(path))

    @classmethod
    def from_function(cls, function, path):
        """Return a locator, or None for a function of others or without a place to write to."""
        if not Path(path).is_relative_to(PACKAGE):
            return None
        locator = cls(function, path)
        try:
            locator.ensure_cache_path()
        except OSError:
            return None
        return locator

    def ensure_cache_path(self) -> None:
        """Make the folder; OSError if it can not be written to."""
        self._folder.mkdir(parents=True, exist_ok=True)
        if not os.access(self._folder, os.W_OK):
            raise PermissionError(str(self._folder))

    def get_cache_path(self) -> str:
        """Return the folder."""
        return str(self._folder)

    def get_source_stamp(self) -> str:
        """Return what changes with the sources: the name of the folder does."""
        return self._folder.name

    def get_disambiguator(self) -> str:
        """Return what tells functions of one name apart."""
        return str(self._line)


def keep_kernels_by_what_they_are_made_of() -> None:
    """Let numba keep the machine code of the package where this module says."""
    if Locator not in CacheImpl._locator_classes:
        CacheImpl._locator_classes = [Locator, *CacheImpl._locator_classes]
