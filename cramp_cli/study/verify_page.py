"""The page of a verification: a table of all cases, a picture for every curve over time."""

from collections.abc import Iterable, Sequence
from pathlib import Path

from cramp_cli.deck.deck import read_deck
from cramp_cli.deck.expect import Expectation
from cramp_cli.output.atomic import write_text
from cramp_cli.study.curves import name_of
from cramp_cli.study.figures import BLACK, CYCLE, WIDTH, drawing, save
from cramp_cli.study.quantities import label, scale_for
from cramp_cli.study.results import by_tip, read_table, unit_of
from cramp_cli.study.templates import template_folder
from cramp_cli.study.verify import Finding, row

HEAD = """# Verification

What decks give beside theory and published results. *Error* is the distance from the reference, for
a curve over time the rms distance over its peak. *Bound* is what must be kept; *aim* is what we are
after, and is bold where it is missed. K is that of the domain integral unless it says contour.

This page is generated: `cramp verify --full --report docs/verification.md`, or `make verify`.

| case | number | measured | reference | error | bound | aim | |
|---|---|---:|---:|---:|---:|---:|---|
"""

Results = Sequence[tuple[Expectation, list[Finding]]]


def write_page(page: Path, results: Results, runs: Path) -> Path:
    """Write the page in Markdown and its pictures into a folder of the page's name beside it.

    runs: the folder that holds the runs by the names of their cases
    """
    drawn = [one for one in results if any(entry.curve for entry in one[0].numbers)]
    with drawing() as plt:
        for case, _ in drawn:
            save(_draw(plt, case, runs / case.name), page.with_suffix("") / f"{case.name}.png")
    parts = [HEAD + "".join(_lines(results)), _missed(results), "## Curves over time\n"]
    parts += [_picture(page, case) for case, _ in drawn]
    parts += ["## Sources\n", "".join(_sources(results))]
    page.parent.mkdir(parents=True, exist_ok=True)
    write_text(page, "\n".join(part for part in parts if part))
    return page


def title_of(case: Expectation) -> str:
    """Return what a case is about: its own title, or that of its deck."""
    return case.title or read_deck(case.deck_path, case.settings).title


def _lines(results: Results) -> Iterable[str]:
    for case, findings in results:
        name = f"[{case.name}](#{case.name})"
        for one in findings:
            *cells, aim, verdict = row(one)
            missed = one.aim is not None and not one.error <= one.aim
            cells = [name, *cells, f"**{aim}**" if missed else aim, verdict]
            yield f"| {' | '.join(cells)} |\n"
            name = ""


def _missed(results: Results) -> str:
    """Return a paragraph on what misses its aim or its bound; nothing if there is none."""
    found = [one for _, findings in results for one in findings]
    off = [one for one in found if one.outside]
    missed = [one for one in found if one.aim is not None and not one.error <= one.aim]
    told = []
    for text, some in (("Out of their bounds", off), ("Short of their aims", missed)):
        if some:
            told.append(f"{text}: {'; '.join(f'`{o.case}` {o.what} ({row(o)[3]})' for o in some)}.")
    return "\n".join(f"{text}\n" for text in told)


def _sources(results: Results) -> Iterable[str]:
    for case, findings in results:
        deck = case.deck_path.resolve().relative_to(template_folder().resolve())
        yield f"### {case.name}\n\n{title_of(case)}. `inputs/{deck.as_posix()}`"
        yield (
            f" with {', '.join(f'`{s}`' for s in case.settings)}.\n\n" if case.settings else ".\n\n"
        )
        for one in findings:
            if one.source:
                yield f"* {one.what}: {one.source}\n"
        yield "\n"


def _picture(page: Path, case: Expectation) -> str:
    title = title_of(case)
    return f"![{title}: computed and reference]({page.stem}/{case.name}.png)\n"


def _draw(plt, case: Expectation, run: Path):
    """Return a figure with computed columns and their references over time in one panel."""
    figure, panel = plt.subplots(figsize=(WIDTH, 2.9))
    entries = [entry for entry in case.numbers if entry.curve]
    drawn = [(entry, *_both(case, entry, run)) for entry in entries]
    time = scale_for("s", *(rows["time"] for _, rows, _ in drawn))
    unit = unit_of(entries[0].column)
    size = scale_for(unit, *(rows[entry.column] for entry, rows, _ in drawn))
    for colour, (entry, rows, curve) in zip(CYCLE, drawn, strict=False):
        name = name_of(entry.column)
        until = rows["time"][-1]
        t, shown = rows["time"] / time.size, curve["time"] <= until
        panel.plot(t, rows[entry.column] / size.size, color=colour, label=f"{name}, cramp")
        values = entry.curve.scale * curve[entry.column][shown] / size.size
        style = {"color": BLACK, "lw": 0.9, "ls": (0, (4, 2)), "label": f"{name}, reference"}
        panel.plot(curve["time"][shown] / time.size, values, **style)
    window = entries[0].curve
    panel.axvspan(window.start / time.size, window.until / time.size, color="#F3F3F3", zorder=-1)
    panel.axhline(0.0, color=BLACK, lw=0.5, zorder=0)
    what = "$K$" if entries[0].tip else name_of(entries[0].column)
    panel.set(xlabel=label("time", time), ylabel=label(what, size), title=title_of(case))
    panel.margins(x=0.01)
    panel.legend(ncols=len(entries))
    return figure


def _both(case: Expectation, entry, run: Path):
    """Return the rows of a run and its reference curve."""
    rows = read_table(run / entry.table)
    rows = by_tip(rows)[entry.tip] if entry.tip else rows
    return rows, read_table(case.path.parent / entry.curve.file)
