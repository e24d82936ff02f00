"""Pydantic's errors in plain words, at the path of keys of the deck."""

import re
from typing import Any

from pydantic import ValidationError

from cramp_cli.schema.mistake import DeckError, Path, Source, step_into
from cramp_cli.schema.section import TAG, UNKNOWN, Section, listed, meant_by
from cramp_cli.schema.units import shown

MOST = 1000  # mistakes told of one deck
BOUNDS = {
    "greater_than": ("must be above {}", "gt"),
    "greater_than_equal": ("must be at least {}", "ge"),
    "less_than": ("must be below {}", "lt"),
    "less_than_equal": ("must be at most {}", "le"),
}
TYPES = {
    "bool_type": "must be true or false",
    "bool_parsing": "must be true or false",
    "string_type": "must be text",
    "int_type": "must be a whole number",
    "int_from_float": "must be a whole number",
    "int_parsing": "must be a whole number",
    "int_parsing_size": "must be a smaller number",
    "float_type": "must be a number",
    "finite_number": "must be a finite number",
    "list_type": "must be a list [...]",
    "tuple_type": "must be a list [...]",
    "dict_type": "must be a section of keys such as {name: ...}",
    "model_type": "must be a section of keys such as {key: value}",
    "model_attributes_type": "must be a section of keys such as {key: value}",
    "string_pattern_mismatch": "must start with a letter and hold only letters, digits, _ and -",
}


def checked(section: type[Section], source: Source) -> Any:
    """Return the section that the data of a source stands for, or raise all its mistakes."""
    found = list(source.mistakes)
    try:
        right = section.model_validate(source.data)
    except ValidationError as failure:
        found += [source.mistake(*error) for error in explain(failure, source.data)]
    if found:
        raise DeckError(found)
    return right


def explain(failure: ValidationError, data: Any) -> list[tuple[Path, str, bool]]:
    """Return path, message and whether the key itself is wrong, for each error."""
    found = []
    errors = [error for error in failure.errors(include_url=False) if not _is_echo(error)]
    for error in errors[:MOST]:
        loc, of_key = error["loc"], False
        if loc and loc[-1] == "[key]":
            loc, of_key = loc[:-1], True
        path = _path(loc, data)
        message = _message(error, error["input"] if of_key else _value_at(path, data))
        found.append((path, message, of_key or message.startswith(UNKNOWN)))
    if len(errors) > MOST:
        found.append(((), f"and {len(errors) - MOST} more mistakes", False))
    return found


def _is_echo(error: dict) -> bool:
    """A list is called too short when its entries are wrong; those are told already."""
    return error["type"] == "too_short" and len(error["input"]) >= error["ctx"]["min_length"]


def _path(loc: tuple, data: Any) -> Path:
    """Return an error's place as keys of the deck, without what pydantic adds to it."""
    loc = [key for key in loc if not (isinstance(key, str) and key.startswith(TAG))]
    path: tuple = ()
    for key in loc:
        if isinstance(data, list | dict):
            path = (*path, key)
        data = step_into(data, key)
    return path


def _value_at(path: Path, data: Any) -> Any:
    """Return what the deck itself says at a path: '-3 GPa', not the number made of it."""
    for key in path:
        data = step_into(data, key)
    return data


def _message(error: dict, value: Any) -> str:
    kind, context = error["type"], error.get("ctx", {})
    got = f" (got {shown(value)})"
    if kind == "cramp":
        return context["message"]
    if kind == "missing":
        return "is missing"
    if kind in BOUNDS:
        text, name = BOUNDS[kind]
        return text.format(f"{context[name]:g}") + f" (got {_bare(value)})"
    if kind in TYPES:
        return TYPES[kind] + got
    if kind in ("literal_error", "enum"):
        return _choice(context["expected"], value)
    if kind in ("too_short", "too_long"):
        return _length(kind, context, len(error["input"]))
    if kind == "string_too_long":
        return f"must be at most {context['max_length']} characters long"
    text = error["msg"].removeprefix("Value error, ")
    return text[:1].lower() + text[1:] + got


def _bare(value: Any) -> str:
    """Return a value without quotes: '-3 GPa' reads better as -3 GPa."""
    return shown(value).strip("'")


def _choice(expected: str, value: Any) -> str:
    known = re.findall(r"'([^']*)'", expected) or [expected]
    meant = meant_by(value, known) if isinstance(value, str) else ""
    hint = f"; did you mean '{meant}'?" if meant else ""
    rule = f"must be {known[0]}" if len(known) == 1 else f"must be one of {listed(known)}"
    return f"{rule} (got {shown(value)}){hint}"


def _length(kind: str, context: dict, length: int) -> str:
    limit = context["min_length" if kind == "too_short" else "max_length"]
    word = "at least" if kind == "too_short" else "at most"
    entries = "entry" if limit == 1 else "entries"
    return f"must have {word} {limit} {entries} (got {length})"
