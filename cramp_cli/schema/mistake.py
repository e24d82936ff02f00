"""A mistake of a deck and the place where it stands."""

from dataclasses import dataclass, field
from typing import NamedTuple

Path = tuple[str | int, ...]
MOST_NAMED = 200  # entries of a list that go by their names; in longer ones by their numbers


class Mark(NamedTuple):
    """Line and column, from 1, of a value and of its key; `setting` if the command line set it."""

    line: int
    column: int
    key_line: int
    key_column: int
    setting: str = ""


@dataclass(frozen=True)
class Mistake:
    """What is wrong, where, and at which path of keys."""

    where: str  # "deck.yaml:7:9" or "-s path=value"
    path: Path
    shown_path: str
    message: str
    line: int = 0  # from 1; 0 for the command line
    column: int = 0

    def __str__(self) -> str:
        """Return the line that people read."""
        return ": ".join(part for part in (self.where, self.shown_path, self.message) if part)


class DeckError(Exception):
    """All mistakes of a deck, sorted by line; those of the command line last."""

    def __init__(self, mistakes: list[Mistake]):
        self.mistakes = sorted(set(mistakes), key=_place)
        super().__init__("\n".join(map(str, self.mistakes)))


def _place(mistake: Mistake) -> tuple:
    return (mistake.line == 0, mistake.line, mistake.column, mistake.shown_path, mistake.message)


@dataclass
class Source:
    """A deck as data, with the place of every key."""

    name: str
    text: str = ""
    data: object = None
    marks: dict[Path, Mark] = field(default_factory=dict)
    mistakes: list[Mistake] = field(default_factory=list)
    settings: dict[Path, str] = field(default_factory=dict)  # what the command line changed

    def mistake(self, path: Path, message: str, at_key: bool = False) -> Mistake:
        """Return a mistake at a path of keys; what the deck leaves out is blamed on its parent."""
        path = tuple(path)
        known = next(end for end in range(len(path), -1, -1) if not end or path[:end] in self.marks)
        mark = self.marks.get(path[:known], Mark(1, 1, 1, 1))
        setting = mark.setting or self._setting_below(path)
        if setting:
            return Mistake(f"-s {setting}", path, self.shown(path), message)
        use_key = at_key or known < len(path)
        line, column = mark[2:4] if use_key else mark[:2]
        where = f"{self.name}:{line}:{column}"
        return Mistake(where, path, self.shown(path), message, line, column)

    def _setting_below(self, path: Path) -> str:
        """Return the setting of the command line that changed something below a path, if any."""
        if not path:
            return ""
        changed = (setting for key, setting in self.settings.items() if key[: len(path)] == path)
        return next(changed, "")

    def shown(self, path: Path) -> str:
        """Return a path as text; entries of a list go by their name when it is unique."""
        data, parts = self.data, []
        for key in path:
            parts.append(_entry_name(data, key) if isinstance(data, list) else str(key))
            data = step_into(data, key)
        return ".".join(parts)


def step_into(data: object, key: str | int) -> object:
    """Return the value below `key`, or None when there is none."""
    if isinstance(data, dict):
        return data.get(key)
    if isinstance(data, list) and isinstance(key, int) and 0 <= key < len(data):
        return data[key]
    return None


def _entry_name(entries: list, key: str | int) -> str:
    name = entry_name(step_into(entries, key)) if len(entries) <= MOST_NAMED else ""
    alike = sum(entry_name(entry) == name for entry in entries) if name else 0
    return name if alike == 1 else str(key)


def entry_name(entry: object) -> str:
    """Return the name of a list's entry, or nothing."""
    name = entry.get("name") if isinstance(entry, dict) else None
    return name if isinstance(name, str) and name.replace("-", "_").isidentifier() else ""
