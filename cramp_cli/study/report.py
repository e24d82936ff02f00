"""One HTML page about a run that needs nothing beside it: no network, no other file."""

import html
from pathlib import Path

from cramp_cli.deck.deck import read_deck
from cramp_cli.output.look import describe, facts
from cramp_cli.output.tables import number
from cramp_cli.study.html_page import embedded, table, write_page
from cramp_cli.study.page_data import charts, film
from cramp_cli.study.quantities import label, scale_for
from cramp_cli.study.verdicts import Verdict, judge

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
        "verdicts": _verdict_table(verdicts),
        "tips": _tip_table(found["tips"]),
        "facts": table(["", ""], [[name, str(value)] for name, value in known.items()]),
        "deck": html.escape(_text(run / "input.yaml")),
        "log": html.escape("\n".join(_text(run / "run.log").splitlines()[-LOG_LINES:])),
        "data": _data(run),
    }
    return write_page(target, "report", parts)


def _text(path: Path) -> str:
    return path.read_text(encoding="utf-8", errors="replace") if path.exists() else ""


def _data(run: Path) -> str:
    """Return what the script draws."""
    drawn, moving = charts(run), film(run)
    times = [line["time"][-1] for one in drawn for line in one["lines"] if line["time"]]
    times += [frame["time"] for frame in moving["frames"]] if moving else []
    end = max(times, default=0.0)
    scale = scale_for("s", end)._asdict()
    return embedded({"charts": drawn, "film": moving, "end": end, "time": scale})


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
    return table([*heads, "status"], rows, numbers=range(1, len(SHOWN) + 1))
