"""The grammar of a deck for editors: JSON Schema."""

from collections.abc import Iterator
from typing import Any

from cramp_cli.deck.deck import FORMAT, Deck

BOUNDS = {
    "gt": "exclusiveMinimum",
    "ge": "minimum",
    "lt": "exclusiveMaximum",
    "le": "maximum",
}


def deck_schema() -> dict[str, Any]:
    """Return the JSON Schema of a deck, for the YAML support of editors."""
    schema = Deck.model_json_schema(by_alias=True)
    for section in [schema, *schema["$defs"].values()]:
        for key, field in section.get("properties", {}).items():
            _complete(section, key, field)
    schema["$schema"] = "https://json-schema.org/draft/2020-12/schema"
    schema["title"] = "cramp deck"
    schema["properties"]["cramp"]["const"] = FORMAT
    return schema


def _complete(section: dict, key: str, field: dict) -> None:
    """Put units into a field's description; ask for the key that tells a section's kind."""
    _without_null(field)
    unit = next((part["title"] for part in _with_units(field)), None)
    if unit:
        field["description"] = f"{field.get('description', '')} - {unit}, or text with a unit"
    if "const" in field and key in ("type", "law"):
        field.pop("default", None)
        section["required"] = [key, *section.get("required", [])]
    if key == "in_time":
        field["anyOf"] = [{"enum": ["constant", "step"]}, {"oneOf": field.pop("oneOf")}]


def _without_null(field: dict) -> None:
    """A key that may be left out is not shown as one that may be null."""
    forms = [form for form in field.get("anyOf", []) if form != {"type": "null"}]
    if len(forms) == 1 and len(field["anyOf"]) == 2:
        bounds = {name: forms[0].pop(sign) for sign, name in BOUNDS.items() if sign in forms[0]}
        del field["anyOf"]
        field |= {**forms[0], **bounds, **{key: field[key] for key in ("description",)}}
        field.pop("default", None)


def _with_units(schema: Any) -> Iterator[dict]:
    """Yield the parts of a schema that tell a unit."""
    if isinstance(schema, dict):
        if "(SI: " in str(schema.get("title", "")):
            yield schema
        for part in schema.values():
            yield from _with_units(part)
    elif isinstance(schema, list):
        for part in schema:
            yield from _with_units(part)
