"""Pages that need nothing beside them: templates with places, tables, data for a script."""

import html
import json
import re
from collections.abc import Collection, Sequence
from pathlib import Path

from cramp_cli.output.atomic import plain, write_text

PAGE = Path(__file__).parent / "page"
PLACE = re.compile(r"\{\{(\w+)\}\}")


def write_page(target: Path, template: str, parts: dict[str, str]) -> Path:
    """Fill the places of the page and of a template of the folder page/ and write it.

    parts: HTML for each place; style and scripts are added
    """
    scripts = asset("common.js") + asset(f"{template}.js")
    known = {"style": asset("page.css"), "script": scripts, **parts}
    known["main"] = _filled(asset(f"{template}.html"), known)
    target.parent.mkdir(parents=True, exist_ok=True)
    write_text(target, _filled(asset("page.html"), known))
    return target


def _filled(template: str, parts: dict[str, str]) -> str:
    return PLACE.sub(lambda place: parts[place[1]], template)


def asset(name: str) -> str:
    """Return the text of a file of the folder page/."""
    return (PAGE / name).read_text(encoding="utf-8")


def embedded(record: dict) -> str:
    """Return a record as JSON that cannot end the element it stands in."""
    text = json.dumps(plain(record), ensure_ascii=False, separators=(",", ":"))
    return text.replace("<", "\\u003c")


def table(
    heads: Sequence[str], rows: Sequence[Sequence[str]], numbers: Collection[int] = ()
) -> str:
    """Return a table of texts; `numbers` are the columns that are aligned to the right."""
    kinds = [' class="number"' if n in numbers else "" for n in range(len(heads))]
    head = "".join(f"<th{k}>{html.escape(h)}</th>" for k, h in zip(kinds, heads, strict=True))
    cells = (zip(kinds, row, strict=True) for row in rows)
    lines = ("".join(f"<td{kind}>{html.escape(text)}</td>" for kind, text in row) for row in cells)
    body = "".join(f"<tr>{line}</tr>" for line in lines)
    top = f"<thead><tr>{head}</tr></thead>" if any(heads) else ""
    return f'<div class="scroll"><table>{top}<tbody>{body}</tbody></table></div>'
