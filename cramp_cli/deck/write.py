"""A deck as YAML text that reads back to the same values."""

from typing import Any

import yaml

from cramp_cli.schema.loader import plain_scalar


class _Writer(yaml.SafeDumper):
    """Quotes every text that YAML 1.2 would take for something else; writes no anchors."""

    def ignore_aliases(self, data: Any) -> bool:
        """Repeat equal values."""
        return True


def _text(writer: yaml.SafeDumper, text: str) -> yaml.Node:
    style = None if plain_scalar(text) == text and text else "'"
    return writer.represent_scalar("tag:yaml.org,2002:str", text, style=style)


_Writer.add_representer(str, _text)


def to_yaml(data: dict[str, Any]) -> str:
    """Return plain data, such as a resolved deck, as YAML."""
    return yaml.dump(
        data,
        Dumper=_Writer,
        sort_keys=False,
        default_flow_style=None,
        width=100,
        allow_unicode=True,
    )
