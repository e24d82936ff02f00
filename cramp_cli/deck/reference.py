"""The grammar of a deck for readers: every section and key on one page of Markdown."""

from collections.abc import Iterator
from inspect import getdoc
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo
from pydantic_core import PydanticUndefined

from cramp_cli.deck.deck import Deck
from cramp_cli.deck.run import Radii
from cramp_cli.deck.where import Span
from cramp_cli.schema.curve import Constant
from cramp_cli.schema.section import Section
from cramp_cli.schema.units import Quantity

SIGNS = {"gt": "> ", "ge": ">= ", "lt": "< ", "le": "<= "}
WORDS = {str: "text", bool: "true or false", int: "whole number", float: "number"}
SELDOM = {Span: "length (m), or [low, high]", Radii: "length (m), or a list of lengths"}
LATER = {
    ("CrackSection", "segment"): "half a cell",
    ("CrackSection", "contact"): "`contact.cracks`",
    ("SofteningModeSection", "stiffness"): "5 peak / opening",
    ("FractureSection", "every"): "`output.every`",
    ("FractureSection", "radius"): "chosen by the program",
    ("OutputSection", "every"): "`solver.end_time` / 100",
    ("OutputSection", "history_every"): "`output.every` / 10",
    ("Frictional", "mu_static"): "`mu`",
    ("PropagationSection", "piece"): "half a cell",
}
FAMILIES = {
    "shape": "shape",
    "shapes": "shape",
    "assembly": "shape",
    "array": "shape",
    "pack": "shape",
    "image": "shape",
    "mesh": "shape",
    "curve": "curve",
    "loads": "load",
    "contact": "contact law",
    "cohesive": "traction law",
    "materials": "material",
    "anisotropic": "material",
    "hardening": "hardening",
    "propagation": "speed law",
}
TITLES = {
    "Deck": "The deck",
    "VelocityOnPlane": "prescribed velocity",
    "EnergySection": "energy error",
    "SofteningModeSection": "mode",
    "ModeSection": "cubic mode",
    "TrilinearModeSection": "trilinear mode",
}
HEAD = """# Decks

A deck is one YAML file. Plain numbers are in SI; a text carries its unit: `2.4 mm`, `12 GPa`,
`1.5 MPa*m^0.5`. Angles alone are in degrees when they are plain numbers. Keys that are not listed
here are mistakes, and all mistakes are told at once, with line and column. Paths in a deck start
from the folder of the deck.

This page is generated from the program; do not edit it by hand.
"""


def deck_reference() -> str:
    """Return the deck reference as a Markdown page: keys, units, defaults, meaning."""
    pages = [HEAD]
    for section in _sections(Deck, []):
        title = _title(section)
        rows = [_row(section, name, field) for name, field in section.model_fields.items()]
        table = "\n".join(["| key | value | default | meaning |", "|---|---|---|---|", *rows])
        pages.append(f"## {title}\n\n{getdoc(section)}\n\n{table}\n")
    return "\n".join(pages)


def _sections(section: type[BaseModel], seen: list) -> list[type[BaseModel]]:
    """Return a section and all below it, each once, in the order of the deck."""
    if section not in seen:
        seen.append(section)
        for field in section.model_fields.values():
            for below in _sections_in(field.annotation):
                _sections(below, seen)
    return seen


def _sections_in(annotation: Any) -> Iterator[type[BaseModel]]:
    if _is_section(annotation):
        yield annotation
    for part in get_args(annotation) if get_origin(annotation) is not Literal else ():
        yield from _sections_in(part)


def _family(section: Any) -> str:
    """Return what a section is a kind of, if it is one of several kinds."""
    fields = section.model_fields if _is_section(section) else {}
    return FAMILIES[section.__module__.split(".")[-1]] if {"type", "law"} & fields.keys() else ""


def _is_section(annotation: Any) -> bool:
    return isinstance(annotation, type) and issubclass(annotation, Section)


def _title(section: type[BaseModel]) -> str:
    """Return the heading of a section: family and kind, or its name."""
    family = _family(section)
    if not family:
        return TITLES.get(section.__name__) or section.__name__.removesuffix("Section").lower()
    field = section.model_fields.get("type") or section.model_fields["law"]
    return f"{family}: {get_args(field.annotation)[0]}"


def _row(section: type[BaseModel], name: str, field: FieldInfo) -> str:
    kind = _kind(field.annotation, field.metadata)
    key = field.alias or name
    default = _default(section, name, field)
    return f"| `{key}` | {kind} | {default} | {field.description} |"


def _default(section: type[BaseModel], name: str, field: FieldInfo) -> str:
    later = LATER.get((section.__name__, name))
    if later:
        return later
    if field.is_required() or name in ("type", "law"):
        return "required"
    value = field.get_default(call_default_factory=True)
    if value is None or value is PydanticUndefined or value == ():
        return "none"
    if isinstance(value, Constant):
        return "`constant`"
    if isinstance(value, BaseModel):
        return "its defaults"
    if isinstance(value, bool):
        return f"`{str(value).lower()}`"
    if isinstance(value, tuple):
        return (
            f"`[{', '.join(f'{part:g}' if isinstance(part, float) else part for part in value)}]`"
        )
    return f"`{value:g}`" if isinstance(value, float) else f"`{value}`" if value != "" else "empty"


def _kind(annotation: Any, metadata: list | tuple = ()) -> str:
    """Return the type of a value in words, with unit and bounds."""
    metadata = [more for part in metadata for more in getattr(part, "metadata", None) or [part]]
    seldom = [text for kind, text in SELDOM.items() if _plain(kind) == (annotation, metadata)]
    quantity = next((part for part in metadata if isinstance(part, Quantity)), None)
    if annotation in SELDOM or seldom:
        text = SELDOM.get(annotation) or seldom[0]
    elif quantity is not None:
        text = f"{quantity.name} ({quantity.unit})" if quantity.unit else quantity.name
    elif _limits(metadata) == [2, 2]:
        text = f"[x, y], {_kind(get_args(annotation)[0])}"
    else:
        text = _of_origin(annotation)
    bounds = [
        f"{sign}{getattr(part, name):g}"
        for part in metadata
        for name, sign in SIGNS.items()
        if hasattr(part, name)
    ]
    return " ".join([text, *bounds])


def _limits(metadata: list) -> list[int]:
    """Return the shortest and longest length of a list, as far as they are given."""
    names = ("min_length", "max_length")
    return [getattr(part, name) for name in names for part in metadata if hasattr(part, name)]


def _plain(kind: Any) -> tuple:
    """Return a type without what is annotated to it, and that."""
    inner, *metadata = get_args(kind) if get_origin(kind) is Annotated else (kind,)
    return inner, list(metadata)


def _anchor(section: type[BaseModel]) -> str:
    return _title(section).lower().replace(": ", "-").replace(" ", "-")


def _of_origin(annotation: Any) -> str:
    origin, parts = get_origin(annotation), get_args(annotation)
    if origin is Annotated:
        return _kind(parts[0], parts[1:])
    if origin is Literal:
        return " \\| ".join(f"`{part}`" for part in parts)
    if origin in (Union, UnionType):
        kinds = [part for part in parts if part is not NoneType]
        family = _family(_plain(kinds[0])[0])
        if family and len(kinds) > 1:
            return f"[{family}](#{_anchor(_plain(kinds[0])[0])}) of one kind"
        return " \\| ".join(map(_kind, kinds))
    if origin is tuple:
        return f"list of {_kind(parts[0])}"
    if origin is dict:
        return f"name: {_kind(parts[1])}"
    if _is_section(annotation):
        return f"[{_title(annotation)}](#{_anchor(annotation)})"
    return WORDS.get(annotation, "text")
