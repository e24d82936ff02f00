"""How deeply the brackets of a YAML text are nested, told before its scanner looks at them.

The scanner reads ahead, up to a thousand characters, and has a limit of its own that changes from
release to release: what is too deep for us would be too deep for it first, in its own words.
Brackets count where they open or close a list or a mapping: not in comments, in quotes, in blocks
of text or within a plain word. In a text that is no YAML some may be overlooked; the scanner finds
out that it is none.
"""

import re

ROW = re.compile(r"[^\n]*\n?")
# What stands in a line before its value: dashes and a key, or the mark of a document.
BEFORE = re.compile(
    r"[ \t]*(?:---[ \t]+)?(?:[-?:][ \t]+)*"
    r"""(?:(?:"(?:[^"\\\n]|\\.)*"|'(?:[^'\n]|'')*'|[^\s"'\[\]{}#|>][^\n]*?)[ \t]*:[ \t]+)?"""
)
QUOTED = re.compile(r""""(?:[^"\\]|\\.)*"|'(?:[^']|'')*'""", re.DOTALL)
# Within brackets a word may hold a quote, a colon or a number sign, but not begin with them.
WORD = re.compile(r"""[^\s,\[\]{}"'#:][^,\[\]{}:#\n]*|[:#](?=[^\s,\[\]{}"'])""")
COMMENT = re.compile(r"#[^\n]*")


def too_deep(text: str, deepest: int) -> int | None:
    """Return the offset of the first bracket nested more than `deepest` levels, None if none is."""
    at = 0
    while at < len(text):
        start = BEFORE.match(text, at).end()
        first = text[start : start + 1]
        if first and first in "[{":
            at, deep = _behind_brackets(text, start, deepest)
            if deep:
                return at
        elif first and first in "|>":
            at = _behind_block(text, at, start)
            continue
        elif quoted := QUOTED.match(text, start):
            at = quoted.end()
        at = ROW.match(text, max(at, start)).end()
    return None


def _behind_brackets(text: str, at: int, deepest: int) -> tuple[int, bool]:
    """Return the place behind the bracket that closes the one here, or the first too deep, True."""
    depth = 0
    while at < len(text):
        letter = text[at]
        if letter in "[{":
            depth += 1
            if depth > deepest:
                return at, True
        elif letter in "]}":
            depth -= 1
            if depth == 0:
                return at + 1, False
        at = _next(text, at)
    return at, False


def _next(text: str, at: int) -> int:
    """Return the place behind what stands here within brackets."""
    for piece in (WORD, QUOTED):
        if found := piece.match(text, at):
            return found.end()
    if text[at] == "#" and text[at - 1].isspace():
        return COMMENT.match(text, at).end()
    return at + 1


def _behind_block(text: str, line: int, start: int) -> int:
    """Return the place behind a block of text: the first line not set in more than its key."""
    before = text[line:start]
    column = len(before) - len(before.lstrip(" -?:")) if ":" in before.rstrip() else 0
    at = ROW.match(text, start).end()
    while at < len(text):
        row = ROW.match(text, at)
        words = row[0].lstrip(" ")
        if words.strip() and len(row[0]) - len(words) <= column:
            break
        at = row.end()
    return at
