"""The base of every section of a deck, and the choice between kinds of a section.

A section answers with all its mistakes at once: unknown keys (with the key that was meant), keys
that exclude each other, wrong values, and values that do not fit together.
"""

import difflib
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Annotated, Any, Union

from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Discriminator,
    Field,
    Tag,
    ValidationError,
    ValidationInfo,
    model_validator,
)
from pydantic_core import InitErrorDetails, PydanticCustomError

from cramp_cli.schema.units import complaint, shown

TAG = "\x00"  # no key of a deck holds this character, so a tag is never taken for a key
UNKNOWN = "unknown key"

Name = Annotated[
    str,
    Field(pattern=r"^[^\W\d][\w-]*$", max_length=60, description="letters, digits, _ and -"),
]
Flag = Annotated[bool, Field(strict=True)]
Count = Annotated[int, Field(strict=True)]
Wrong = tuple[tuple[str | int, ...], str]  # path below the section, message


class Section(BaseModel):
    """A mapping of known keys that does not change after reading."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, defer_build=True)

    @classmethod
    def prepare(cls, data: dict, folder: Path | None) -> dict:
        """Return the data as the fields expect them; files are named relative to `folder`."""
        return data

    @classmethod
    def wrong_keys(cls, keys: set[str]) -> Iterable[Wrong]:
        """Yield what is wrong with the set of keys, whatever their values."""
        return ()

    def wrong_values(self) -> Iterable[Wrong]:
        """Yield what is wrong between values that are right by themselves."""
        return ()

    @model_validator(mode="wrap")
    @classmethod
    def _all_mistakes(cls, data: Any, handler: Any, info: ValidationInfo) -> Any:
        if isinstance(data, cls):
            return handler(data)
        if not isinstance(data, dict):
            raise complaint("must be a section of keys such as {key: value}", data)
        data, found, meant = _without_unknown(cls, data)
        given = {key for key, value in data.items() if value is not None}
        wrong = list(cls.wrong_keys(given | meant))
        try:
            data = cls.prepare(data, (info.context or {}).get("folder"))
        except PreparationError as problem:
            wrong.append(problem.args)
        try:
            section = handler(data)
        except ValidationError as failure:
            found += _of_handler(failure, meant)
        else:
            wrong += [] if wrong else section.wrong_values()
        found += [_error(*one) for one in wrong]
        if found:
            raise ValidationError.from_exception_data(cls.__name__, found)
        return section


class PreparationError(Exception):
    """Something is wrong with the data of a section: path below it and message."""


def keys_of(section: type[BaseModel]) -> list[str]:
    """Return the keys of a section as a deck writes them."""
    return [field.alias or name for name, field in section.model_fields.items()]


def only_one(keys: set[str], names: Iterable[str], needed: bool = True) -> Iterator[Wrong]:
    """Yield a mistake unless exactly one (or, if not `needed`, at most one) of `names` is given."""
    names = list(names)
    given = [name for name in names if name in keys]
    if len(given) > 1:
        yield (given[1],), f"give only one of {listed(names)}"
    if not given and needed:
        yield (), f"give one of {listed(names)}"


def listed(names: Iterable[str]) -> str:
    """Return names as words: 'a, b, c'."""
    return ", ".join(map(str, names))


def meant_by(word: str, known: Iterable[str]) -> str:
    """Return the known word that was probably meant, or nothing."""
    known = list(known)
    close = difflib.get_close_matches(word[:60], known, n=1, cutoff=0.6)
    close = close or [name for name in known if sorted(name.lower()) == sorted(word.lower())]
    return close[0] if close else ""


def unknown(what: str, word: str, known: Iterable[str]) -> str:
    """Return the message for a word that is not among the known ones."""
    known = list(known)
    meant = meant_by(word, known)
    hint = f"; did you mean '{meant}'?" if meant else ""
    return f"unknown {what} {shown(word)}{hint} (known: {listed(known) or 'none'})"


def one_of(key: str, *sections: type[Section]) -> Any:
    """Return the type of a section whose kind is told by `key`, without a trace in error paths."""
    known = [_kind(section, key) for section in sections]
    kinds = tuple(
        Annotated[section, Tag(TAG + kind)] for section, kind in zip(sections, known, strict=True)
    )

    def tag(data: Any) -> str:
        return TAG + str(data.get(key) if isinstance(data, dict) else getattr(data, key, ""))

    def check(data: Any) -> Any:
        return _check_kind(key, known, data)

    return Annotated[
        Union[kinds],  # noqa: UP007 (built from a tuple)
        Discriminator(tag),
        BeforeValidator(check),
    ]


def _kind(section: type[Section], key: str) -> str:
    return section.model_fields[key].annotation.__args__[0]


def _check_kind(key: str, known: list[str], data: Any) -> Any:
    if isinstance(data, BaseModel):
        return data
    if not isinstance(data, dict):
        raise complaint(f"must be a section such as {{{key}: {known[0]}, ...}}", data)
    kind = data.get(key)
    if isinstance(kind, str) and kind in known:
        return data
    if key not in data:
        message = f"is missing; give one of {listed(known)}"
    elif isinstance(kind, str):
        message = unknown(key, kind, known)
    else:
        message = f"must be one of {listed(known)} (got {shown(kind)})"
    raise ValidationError.from_exception_data(key, [_error((key,), message)])


def _without_unknown(cls: type[Section], data: dict) -> tuple[dict, list, set[str]]:
    """Return the known part of the data, the mistakes about the rest, and what the rest meant."""
    known = keys_of(cls)
    strange = [key for key in data if key not in known]
    if not strange:
        return data, [], set()
    free = [name for name in known if name not in data]
    found, meant = [], set()
    for key in strange[:100]:
        guess = meant_by(key, free)
        meant |= {guess} - {""}
        guess = guess or meant_by(key, known)
        hint = f"; did you mean '{guess}'?" if guess else f"; known here: {listed(known)}"
        found.append(_error((key,), f"{UNKNOWN}{hint}"))
    return {key: data[key] for key in data if key in known}, found, meant


def _error(path: tuple, message: str) -> InitErrorDetails:
    return InitErrorDetails(type=complaint(message), loc=tuple(path), input=None)


def _of_handler(failure: ValidationError, meant: set[str]) -> list[InitErrorDetails]:
    """Return pydantic's errors in a form that can be raised again, without those already told."""
    again = []
    for error in failure.errors(include_url=False):
        if error["type"] == "missing" and error["loc"] in {(key,) for key in meant}:
            continue
        context = error.get("ctx", {})
        kind = error["type"]
        if kind == "cramp":
            kind = PydanticCustomError("cramp", "{message}", context)
        details = InitErrorDetails(type=kind, loc=error["loc"], input=error["input"], ctx=context)
        again.append(details)
    return again
