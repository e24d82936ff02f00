"""One HTML page about a run that needs nothing beside it: no network, no other file."""

import html
import json
import re
from pathlib import Path

from cramp_cli.deck.deck import read_deck
from cramp_cli.output.atomic import plain, write_text
from cramp_cli.output.look import describe, facts
from cramp_cli.output.tables import number
from cramp_cli.study.page_data import charts, film
from cramp_cli.study.quantities import label, scale_for
from cramp_cli.study.verdicts import Verdict, judge

PAGE = Path(__file__).parent / "page"
MARKS = {"good": "✓ good", "look": "! look", "bad": "✗ bad"}
WORST = ("bad", "look", "good")
SHOWN = {
    "x": "m",
    "y": "m",
    "J": "J/m^2",
    "J_contour": "J/m^2",
    "K_I": "Pa*m^0.5",
    "K_I_contour": "Pa*m^0.5",
    "K_II": "Pa*m^0.5",
}  # column of the table of tips: unit
LOG_LINES = 200
PLACE = re.compile(r"\{\{(\w+)\}\}")


def report(run: Path, target: Path) -> Path:
    """Write the page of a run and return its path.

    Raises FolderError for what is no run.
    """
    found = describe(run)
    deck = read_deck(run / "resolved.yaml")
    verdicts = judge(run, deck.solver.energy_error)
    known = facts(found)
    parts = {
        "title": html.escape(deck.title or run.name),
        "subtitle": html.escape(f"{run.name}: {known['status']}, {known['time']}"),
        "style": _asset("report.css"),
        "verdicts": _verdict_table(verdicts),
        "tips": _tip_table(found["tips"]),
        "facts": _table(["", ""], [[name, str(value)] for name, value in known.items()]),
        "deck": html.escape(_text(run / "input.yaml")),
        "log": html.escape("\n".join(_text(run / "run.log").splitlines()[-LOG_LINES:])),
        "data": _data(run),
        "script": _asset("report.js"),
    }
    page = PLACE.sub(lambda place: parts[place[1]], _asset("report.html"))
    target.parent.mkdir(parents=True, exist_ok=True)
    write_text(target, page)
    return target


def _asset(name: str) -> str:
    return (PAGE / name).read_text(encoding="utf-8")


def _text(path: Path) -> str:
    return path.read_text(encoding="utf-8", errors="replace") if path.exists() else ""


def _data(run: Path) -> str:
    """Return what the script draws, as JSON that cannot end the element it stands in."""
    drawn, moving = charts(run), film(run)
    times = [line["time"][-1] for one in drawn for line in one["lines"] if line["time"]]
    times += [frame["time"] for frame in moving["frames"]] if moving else []
    end = max(times, default=0.0)
    record = {
        "charts": drawn,
        "film": moving,
        "end": end,
        "time": scale_for("s", end)._asdict(),
    }
    text = json.dumps(plain(record), ensure_ascii=False, separators=(",", ":"))
    return text.replace("<", "\\u003c")


def _verdict_table(verdicts: list[Verdict]) -> str:
    ordered = sorted(verdicts, key=lambda verdict: WORST.index(verdict.mark))
    rows = [
        f'<tr><td class="mark {v.mark}">{MARKS[v.mark]}</td><td>{html.escape(v.question)}</td>'
        f"<td>{html.escape(v.answer)}</td></tr>"
        for v in ordered
    ]
    return f'<div class="scroll"><table>{"".join(rows)}</table></div>'


def _tip_table(tips: list[dict]) -> str:
    if not tips:
        return '<p class="hint">This run has no tips.</p>'
    scales = {name: scale_for(unit, [tip[name] for tip in tips]) for name, unit in SHOWN.items()}
    heads = [
        "tip",
        *(label(name.replace("_contour", " by contour"), scales[name]) for name in SHOWN),
    ]
    rows = [
        [f"{tip['crack']} {tip['tip']}"]
        + [number(tip[name] / scales[name].size) for name in SHOWN]
        + [tip["status"]]
        for tip in tips
    ]
    return _table([*heads, "status"], rows, numbers=range(1, len(SHOWN) + 1))


def _table(heads: list[str], rows: list[list[str]], numbers=()) -> str:
    """Return a table; `numbers` are the columns that are aligned to the right."""
    kinds = [' class="number"' if n in numbers else "" for n in range(len(heads))]
    head = "".join(f"<th{k}>{html.escape(h)}</th>" for k, h in zip(kinds, heads, strict=True))
    lines = (
        "".join(f"<td{k}>{html.escape(c)}</td>" for k, c in zip(kinds, r, strict=True))
        for r in rows
    )
    body = "".join(f"<tr>{line}</tr>" for line in lines)
    top = f"<thead><tr>{head}</tr></thead>" if any(heads) else ""
    return f'<div class="scroll"><table>{top}<tbody>{body}</tbody></table></div>'
