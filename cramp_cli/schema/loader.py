"""Safe YAML: the plain part of it, with the numbers and booleans of YAML 1.2.

PyYAML's own reading takes `1e-3` and `2e11` for text, `NO` for false and `010` for 8, lets the
second of two equal keys win, and follows tags and aliases. Only its scanner is used here; the tree
is built from its events without recursion, and depth and size are bounded before it is asked.
"""

import re

import yaml

from cramp_cli.schema.depth import too_deep
from cramp_cli.schema.mistake import DeckError, Mark, Mistake, Path, Source
from cramp_cli.schema.syntax import fault_of

LARGEST = 16 * 1024 * 1024  # bytes of a deck
DEEPEST = 64
TOO_DEEP = f"is nested more than {DEEPEST} levels deep"
MOST_ENTRIES = 200_000

NOT_PRINTABLE = re.compile(
    "[\x00-\x08\x0b\x0c\x0e-\x1f\x7f\x80-\x84\x86-\x9f\ud800-\udfff\ufeff\ufffe\uffff]"
)
INTEGER = re.compile(r"[-+]?[0-9]+", re.ASCII)
OCTAL_OR_HEX = re.compile(r"0o[0-7]{1,64}|0x[0-9a-fA-F]{1,64}", re.ASCII)
FLOAT = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?", re.ASCII)
INFINITE = re.compile(r"([-+]?)\.(inf|Inf|INF)")
WORDS = {
    **dict.fromkeys(("", "~", "null", "Null", "NULL")),
    **dict.fromkeys(("true", "True", "TRUE"), True),
    **dict.fromkeys(("false", "False", "FALSE"), False),
    **dict.fromkeys((".nan", ".NaN", ".NAN"), float("nan")),
}
SCANNER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


def read_source(path: str) -> Source:
    """Read a deck's file. Raises OSError when it cannot be read, DeckError when it is no YAML."""
    with open(path, "rb") as file:
        raw = file.read(LARGEST + 1)
    return load(decode(raw, str(path)), str(path))


def decode(raw: bytes, name: str) -> str:
    """Return the bytes of a file as text, or say at which line it is not UTF-8."""
    if len(raw) > LARGEST:
        raise _one(name, 1, 1, f"is larger than {LARGEST >> 20} MiB")
    if raw.startswith((b"\xff\xfe", b"\xfe\xff")):
        raise _one(name, 1, 1, "is UTF-16; save it as UTF-8")
    if raw.startswith(b"\xef\xbb\xbf"):
        raise _one(name, 1, 1, "starts with a byte order mark; save it as UTF-8 without BOM")
    try:
        return raw.decode("utf-8")
    except UnicodeDecodeError as problem:
        line = raw.count(b"\n", 0, problem.start) + 1
        column = problem.start - raw.rfind(b"\n", 0, problem.start)
        byte = raw[problem.start]
        raise _one(name, line, column, f"byte 0x{byte:02x} is not UTF-8; save as UTF-8") from None


def load(text: str, name: str = "deck") -> Source:
    """Return the data of a YAML text with the place of every key; DeckError if it is no YAML."""
    strange = NOT_PRINTABLE.search(text)
    if strange:
        line, column = _place_of(text, strange.start())
        code = ord(strange[0])
        raise _one(name, line, column, f"character U+{code:04X} is not allowed in a deck")
    deep = too_deep(text, DEEPEST)
    if deep is not None:
        raise _one(name, *_place_of(text, deep), TOO_DEEP)
    tree = _Tree(name, text)
    try:
        scanner = SCANNER(text)
        try:
            while scanner.check_event():
                tree.take(scanner.get_event())
        finally:
            scanner.dispose()
    except yaml.YAMLError as problem:
        raise _one(name, *fault_of(text, problem)) from None
    return tree.source


def plain_scalar(text: str) -> object:
    """Return what an unquoted word of YAML 1.2 (core schema) stands for."""
    if text in WORDS:
        return WORDS[text]
    if INTEGER.fullmatch(text):
        return int(text) if len(text) <= 300 else float(text)
    if FLOAT.fullmatch(text):
        return float(text)
    if OCTAL_OR_HEX.fullmatch(text):
        return int(text, 0)
    infinite = INFINITE.fullmatch(text)
    return float(f"{infinite[1]}inf") if infinite else text


class _Tree:
    """Builds lists and dictionaries from the scanner's events."""

    def __init__(self, name: str, text: str):
        self.source = Source(name, text)
        self.open: list[tuple[dict | list, Path]] = []
        self.key: list = []  # the pending key of each open mapping: (text, mark) or None
        self.documents = self.entries = 0

    def take(self, event: yaml.Event) -> None:
        """Go on with one event."""
        if isinstance(event, yaml.NodeEvent):
            self.entries += 1
            self._refuse(event)
        if isinstance(event, yaml.ScalarEvent):
            self._scalar(event)
        elif isinstance(event, yaml.MappingStartEvent | yaml.SequenceStartEvent):
            self._begin(event, {} if isinstance(event, yaml.MappingStartEvent) else [])
        elif isinstance(event, yaml.MappingEndEvent | yaml.SequenceEndEvent):
            self.open.pop()
            self.key.pop()
        elif isinstance(event, yaml.DocumentStartEvent):
            self.documents += 1
            if self.documents > 1:
                raise self._stop(event, "a deck is one document; remove this '---'")

    def _refuse(self, event: yaml.NodeEvent) -> None:
        if isinstance(event, yaml.AliasEvent) or event.anchor is not None:
            raise self._stop(event, "anchors (&) and aliases (*) are not allowed; repeat the value")
        if event.tag is not None:
            raise self._stop(event, f"tags such as {event.tag[:40]} are not allowed")
        if len(self.open) >= DEEPEST and not isinstance(event, yaml.ScalarEvent):
            raise self._stop(event, TOO_DEEP)
        if self.entries > MOST_ENTRIES:
            text = f"has more than {MOST_ENTRIES} entries; put long lists of points into a csv file"
            raise self._stop(event, text)

    def _scalar(self, event: yaml.ScalarEvent) -> None:
        if self.open and isinstance(self.open[-1][0], dict) and self.key[-1] is None:
            if event.value == "" and event.implicit[0]:
                raise self._stop(event, "a key is missing before ':'")
            self.key[-1] = (event.value, event.start_mark)
            return
        self._put(event, plain_scalar(event.value) if event.implicit[0] else event.value)

    def _begin(self, event: yaml.NodeEvent, container: dict | list) -> None:
        if self.open and isinstance(self.open[-1][0], dict) and self.key[-1] is None:
            raise self._stop(event, "a key must be a plain word")
        path = self._put(event, container)
        self.open.append((container, path))
        self.key.append(None)

    def _put(self, event: yaml.NodeEvent, value: object) -> Path:
        """Store a value in the innermost open container; return its path."""
        at = event.start_mark
        line, column = at.line + 1, at.column + 1
        if not self.open:
            self.source.data = value
            self.source.marks[()] = Mark(line, column, line, column)
            return ()
        container, path = self.open[-1]
        if isinstance(container, list):
            container.append(value)
            path = (*path, len(container) - 1)
            self.source.marks[path] = Mark(line, column, line, column)
            return path
        key, key_at = self.key[-1]
        self.key[-1] = None
        mark = Mark(line, column, key_at.line + 1, key_at.column + 1)
        return self._put_below(container, (*path, key), mark, value)

    def _put_below(self, container: dict, path: Path, mark: Mark, value: object) -> Path:
        """Store a value under a key; of two equal keys the first counts and the second is noted."""
        key = path[-1]
        if key not in container:
            container[key] = value
            self.source.marks[path] = mark
            return path
        first = self.source.marks.get(path)
        text = f"duplicate key; '{key}' stands already in line {first.key_line if first else '?'}"
        line, column = mark.key_line, mark.key_column
        where, shown = f"{self.source.name}:{line}:{column}", self.source.shown(path)
        self.source.mistakes.append(Mistake(where, path, shown, text, line, column))
        return (*path, "(second)")

    def _stop(self, event: yaml.Event, message: str) -> DeckError:
        at = event.start_mark
        return _one(self.source.name, at.line + 1, at.column + 1, message)


def _one(name: str, line: int, column: int, message: str) -> DeckError:
    return DeckError([Mistake(f"{name}:{line}:{column}", (), "", message, line, column)])


def _place_of(text: str, offset: int) -> tuple[int, int]:
    return text.count("\n", 0, offset) + 1, offset - text.rfind("\n", 0, offset)
