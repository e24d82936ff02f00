"""Decks to begin with: those of inputs/, which are tests at the same time."""

import re
import shutil
from pathlib import Path

import cramp_cli
from cramp_cli.deck.files import names_of_files
from cramp_cli.output.exits import FolderError
from cramp_cli.schema.loader import read_source
from cramp_cli.schema.section import unknown

PACKAGE = Path(cramp_cli.__file__).parent


def template_folder() -> Path:
    """Return the folder of the decks: in the package once installed, beside it in a clone."""
    shipped = PACKAGE / "inputs"
    return shipped if shipped.is_dir() else PACKAGE.parent / "inputs"


def templates() -> dict[str, Path]:
    """Return decks and studies by name, without the files of expected numbers."""
    paths = sorted(template_folder().glob("*.yaml"))
    return {p.stem: p for p in paths if not p.name.endswith(".expect.yaml")}


def title_of(path: Path) -> str:
    """Return the title that a deck or study gives itself."""
    found = re.search(r"^title: (.*)$", path.read_text(encoding="utf-8"), re.MULTILINE)
    return found[1] if found else ""


def list_text() -> str:
    """Return a line for every template: name and title."""
    known = templates()
    widest = max(map(len, known))
    return "\n".join(f"{name:{widest}}  {title_of(path)}" for name, path in known.items())


def write_template(name: str, target: Path | None = None) -> list[Path]:
    """Copy a template; a study brings its deck along, a deck its files, unless they are there.

    target: the new file; its name in this folder if None
    returns: the files written
    Raises FolderError for an unknown name or a file in the way.
    """
    known = templates()
    if name not in known:
        raise FolderError(unknown("template", name, known))
    target = target or Path(known[name].name)
    if target.exists():
        raise FolderError(f"{target}: exists already; choose another file with -o")
    target.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(known[name], target)
    return [target, *_brought(known[name], target.parent)]


def _brought(template: Path, folder: Path) -> list[Path]:
    """Copy what a template names beside it: the base deck of a study, the files of a deck."""
    data = read_source(str(template)).data
    deck = [data["deck"]] if "deck" in data else []
    missing = [name for name in (*deck, *names_of_files(data)) if not (folder / name).exists()]
    for name in missing:
        shutil.copyfile(template.parent / name, folder / name)
    return [folder / name for name in missing]
