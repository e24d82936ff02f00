"""One HTML page about a sweep: a response plot and the table of all cases."""

import html
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from cramp_cli.output.tables import number
from cramp_cli.study.cases import shown
from cramp_cli.study.collect import STATUS, Row
from cramp_cli.study.html_page import embedded, table, write_page
from cramp_cli.study.outcome import WORDS
from cramp_cli.study.results import unit_of

BESIDE = ("case", "state", "exit_code", "wall_time")  # columns that are no result


def sweep_report(target: Path, title: str, rows: Sequence[Row]) -> Path:
    """Write the page of a sweep and return its path.

    rows: those of `collect`, one per case
    """
    names = list(dict.fromkeys(name for row in rows for name in row))
    varied = [n for n in names if any(n in _before_state(row) for row in rows)]
    results = [name for name in names if name not in (*varied, *BESIDE)]
    plotted = [name for name in results if not name.endswith(f".{STATUS}")]
    drawn = [{name: _plotted(row.get(name)) for name in (*varied, *plotted)} for row in rows]
    counts = Counter(row["state"] for row in rows)
    told = ", ".join(f"{counts[word]} {word}" for word in WORDS if counts[word])
    parts = {
        "title": html.escape(title),
        "subtitle": f"{len(rows)} cases: {told}",
        "cases": _cases(rows, [*varied, "state", "wall_time", *results]),
        "data": embedded({"rows": drawn, "parameters": varied, "numbers": _with_units(plotted)}),
    }
    return write_page(target, "sweep", parts)


def _with_units(results: list[str]) -> dict[str, str]:
    """Return each result with the label of its axis: `notch_end.K_I.max (Pa*m^0.5)`."""
    units = {name: unit_of(name.split(".")[-2]) for name in results}
    return {name: f"{name} ({unit})" if unit != "1" else name for name, unit in units.items()}


def _before_state(row: Row) -> list[str]:
    names = list(row)
    return names[1 : names.index("state")]


def _plotted(value: object) -> object:
    """Return a number or a text; lists and the like become text."""
    return value if isinstance(value, int | float | None.__class__) else shown(value)


def _cases(rows: Sequence[Row], names: list[str]) -> str:
    heads = ["case", *(f"{n} (s)" if n == "wall_time" else n for n in names)]
    cells = [[str(row["case"]), *(_text(row.get(name)) for name in names)] for row in rows]
    numbers = [n for n, name in enumerate(names, 1) if _is_number(rows, name)]
    return table(heads, cells, numbers)


def _is_number(rows: Sequence[Row], name: str) -> bool:
    given = [row[name] for row in rows if row.get(name) is not None]
    return bool(given) and all(isinstance(value, int | float) for value in given)


def _text(value: object) -> str:
    if value is None:
        return ""
    return number(value) if isinstance(value, int | float) else shown(value)
