"""Changes to a deck from the command line: `path.to.key=value`."""

import re
from typing import Any

from cramp_cli.schema.loader import load
from cramp_cli.schema.mistake import DeckError, Mark, Mistake, Path, Source, entry_name, step_into
from cramp_cli.schema.section import listed, meant_by


class OverrideError(Exception):
    """An override that leads nowhere: path so far and message."""


def apply_overrides(source: Source, settings: tuple[str, ...] | list[str]) -> None:
    """Change the data of a deck in place; note mistakes of the overrides themselves."""
    for setting in settings:
        try:
            _apply(source, setting)
        except OverrideError as problem:
            path, message = problem.args
            shown = source.shown(path)
            source.mistakes.append(Mistake(f"-s {setting}", path, shown, message))


def _apply(source: Source, setting: str) -> None:
    words, equals, text = setting.partition("=")
    keys = re.sub(r"\[(\d+)\]", r".\1", words.strip()).split(".")
    if not equals or not all(keys):
        raise OverrideError((), "must be path.to.key=value, as in solver.cfl=0.3")
    try:
        value = load(text).data
    except DeckError as problem:
        raise OverrideError(tuple(keys), problem.mistakes[0].message) from None
    node: Any = source.data
    path: Path = ()
    for word in keys[:-1]:
        key = _key_in(node, path, word)
        path = (*path, key)
        if isinstance(node, dict) and node.get(key) is None:
            node[key] = {}
            _mark(source, path, setting)
        node = step_into(node, key)
    key = _key_in(node, path, keys[-1])
    node[key] = value
    _mark(source, (*path, key), setting)


def _key_in(node: Any, path: Path, word: str) -> str | int:
    """Return the key or index that a word of the path stands for."""
    if isinstance(node, dict):
        return word
    if not isinstance(node, list):
        raise OverrideError(path, "has no keys below it; set it as a whole")
    if re.fullmatch(r"[0-9]{1,9}", word) and int(word) < len(node):
        return int(word)
    names = [entry_name(entry) for entry in node]
    if word in names:
        return names.index(word)
    known = [name for name in names if name]
    meant = meant_by(word, known)
    hint = f"; did you mean '{meant}'?" if meant else ""
    count = f"{len(node)} entries" if len(node) != 1 else "1 entry"
    named = f" ({listed(known)})" if known else ""
    raise OverrideError(path, f"has {count}{named} and none is '{word}'{hint}")


def _mark(source: Source, path: Path, setting: str) -> None:
    """Blame a path, and all below it, on the command line."""
    for known in [other for other in source.marks if other[: len(path)] == path]:
        del source.marks[known]
    source.marks[path] = Mark(0, 0, 0, 0, setting)
    source.settings[path] = setting
