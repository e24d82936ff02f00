"""Pictures over time: J and K of the tips, the energy books, any column."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from cramp_cli.output.exits import FolderError
from cramp_cli.schema.section import unknown
from cramp_cli.study.figures import BLACK, CYCLE, GREY, WIDTH
from cramp_cli.study.quantities import Scale, label, scale_for
from cramp_cli.study.results import WORDS, Columns, by_tip, read_table, unit_of

NAMES = {
    "J": "$J$",
    "K_I": r"$K_\mathrm{I}$",
    "K_II": r"$K_\mathrm{II}$",
    "K_III": r"$K_\mathrm{III}$",
}
BESIDE = {"J": "J_contour", "K_I": "K_I_contour", "K_II": "K_II_contour"}
ENERGIES = {
    "external_work": ("external work", BLACK, (0, (4, 2))),
    "kinetic_energy": ("kinetic", CYCLE[0], "-"),
    "strain_energy": ("strain", CYCLE[1], "-"),
    "fracture_energy": ("fracture", CYCLE[2], "-."),
    "cohesive_stored": ("cohesive, stored", GREY, "-"),
    "cohesive_energy": ("cohesive", GREY, "-."),
    "friction_energy": ("friction", CYCLE[3], "-."),
    "impact_energy": ("impact", CYCLE[3], ":"),
    "plastic_energy": ("plastic", CYCLE[4], ":"),
    "damping_energy": ("damping", CYCLE[5], ":"),
}
NOISE = 1e-4  # of the largest number of the same unit: less is drawn as zero


def name_of(column: str) -> str:
    """Return a column's name as a label says it."""
    return NAMES.get(column, column.replace("_", " "))


def draw_tips(plt, run: Path, references: Sequence[Path] = ()):
    """Return a figure of K_I, K_II and J over time, a colour per tip.

    A full line is the domain integral, a dashed one the contour; squares come from reference
    tables, circles mark samples whose status is not `ok`.
    """
    return draw_columns(plt, run, ("K_I", "K_II", "J"), references)


def draw_columns(plt, run: Path, columns: Sequence[str], references: Sequence[Path] = ()):
    """Return a figure with a panel over time for every column of cracks.csv or history.csv.

    references: CSV files with a column `time` and columns of the same names, in SI
    """
    tables = {"cracks": read_table(run / "cracks.csv"), "history": read_table(run / "history.csv")}
    others = {path.stem: _reference(path) for path in references}
    figure, panels = plt.subplots(
        len(columns), 1, sharex=True, squeeze=False, figsize=(WIDTH, 0.7 + 1.75 * len(columns))
    )
    time, chosen = _time_scale(tables), [_lines(run, tables, column) for column in columns]
    largest = _largest_by_unit(columns, chosen, others)
    for panel, column, lines in zip(panels[:, 0], columns, chosen, strict=True):
        _draw_panel(panel, column, lines, others, time, largest[unit_of(column)])
    panels[-1, 0].set_xlabel(label("time", time))
    _legend(figure, panels[:, 0])
    figure.align_ylabels()
    return figure


def _time_scale(tables) -> Scale:
    return scale_for("s", *(table["time"] for table in tables.values() if table))


def _lines(run: Path, tables, column: str) -> dict[str, Columns]:
    """Return the rows to draw of a column, one entry per tip, or one for the whole run."""
    if column in tables["cracks"] and column not in WORDS | {"step", "time"}:
        return by_tip(tables["cracks"])
    if column in tables["history"] and column not in ("step", "time"):
        return {"": tables["history"]}
    known = [n for table in tables.values() for n in table if n not in WORDS | {"step", "time"}]
    raise FolderError(f"{run}: {unknown('column', column, dict.fromkeys(known))}")


def _reference(path: Path) -> Columns:
    if not path.exists():
        raise FolderError(f"{path}: no such file")
    table = read_table(path)
    if "time" not in table:
        raise FolderError(f"{path}: needs a column 'time' in s, and columns named as in cracks.csv")
    return table


def _largest_by_unit(columns, chosen, others) -> dict[str, float]:
    """Return the largest number that is drawn of each unit: K_I and K_II share their scale."""
    largest = {}
    for column, lines in zip(columns, chosen, strict=True):
        tables = [*lines.values(), *others.values()]
        names = (column, BESIDE.get(column, ""))
        drawn = [table[name] for table in tables for name in names if name in table]
        sizes = [np.abs(v[np.isfinite(v)]).max(initial=0.0) for v in drawn]
        unit = unit_of(column)
        largest[unit] = max([largest.get(unit, 0.0), *sizes])
    return largest


def _draw_panel(panel, column, lines, others, time: Scale, largest: float) -> None:
    beside, scale = BESIDE.get(column, ""), scale_for(unit_of(column), largest)
    for colour, (tip, rows) in zip(_colours(lines), lines.items(), strict=True):
        t = rows["time"] / time.size
        panel.plot(t, rows[column] / scale.size, color=colour, label=tip or None)
        if beside in rows:
            panel.plot(t, rows[beside] / scale.size, "--", color=colour, lw=1.0, label=_by(tip))
        if "status" in rows:
            _mark_remarks(panel, t, rows[column] / scale.size, rows["status"])
    for marker, (name, table) in zip("sD^v<>" * len(others), others.items(), strict=False):
        if column in table:
            t = table["time"] / time.size
            style = {"mfc": "none", "mec": BLACK, "ms": 4.5, "mew": 0.9}
            panel.plot(t, table[column] / scale.size, marker, label=name, **style)
    panel.axhline(0.0, color=BLACK, lw=0.5, zorder=0)
    panel.set_ylabel(label(name_of(column), scale))
    panel.grid(axis="y")
    panel.margins(x=0.01)
    _show_noise_as_zero(panel, largest / scale.size)


def _colours(lines) -> list[str]:
    return [CYCLE[number % len(CYCLE)] for number in range(len(lines))]


def _by(tip: str) -> str:
    return f"{tip}, contour".removeprefix(", ")


def _mark_remarks(panel, time, values, status) -> None:
    """Mark the samples whose status is not `ok` by open circles."""
    remarked = (status != "ok") & np.isfinite(values)
    if remarked.any():
        style = {"ls": "", "marker": "o", "mfc": "white", "mec": GREY, "ms": 3.2, "mew": 0.8}
        panel.plot(time[remarked], values[remarked], label="status is not ok", zorder=3, **style)


def _show_noise_as_zero(panel, largest: float) -> None:
    """Keep round-off about zero from filling a panel: beside what has its unit it is zero."""
    drawn = panel.dataLim.intervaly
    if np.abs(drawn).max() < NOISE * largest:
        panel.set_ylim(-0.01 * largest, 0.01 * largest)


def _legend(figure, panels) -> None:
    """Put one legend above all panels, every entry once."""
    entries = {}
    for panel in panels:
        for handle, text in zip(*panel.get_legend_handles_labels(), strict=True):
            entries.setdefault(text, handle)
    if entries:
        figure.legend(
            entries.values(), entries.keys(), loc="outside upper left", ncols=min(len(entries), 5)
        )


def draw_energy(plt, run: Path):
    """Return a figure of the energy books over time and of what is missing in them."""
    table = read_table(run / "history.csv")
    if not table or not len(table["time"]):
        raise FolderError(f"{run / 'history.csv'}: holds no row yet")
    largest = max(np.abs(table[name]).max() for name in ENERGIES)
    kept = {n: look for n, look in ENERGIES.items() if np.abs(table[n]).max() > NOISE * largest}
    time = scale_for("s", table["time"])
    scale = scale_for("J", *(table[name] for name in kept or ("kinetic_energy",)))
    figure, (upper, lower) = plt.subplots(
        2, 1, sharex=True, figsize=(WIDTH, 3.9), height_ratios=(2.4, 1.0)
    )
    t = table["time"] / time.size
    for name, (text, colour, dash) in kept.items():
        upper.plot(t, table[name] / scale.size, color=colour, ls=dash, label=text)
    upper.set_ylabel(label("energy", scale))
    error = 100.0 * table["energy_error"]
    lower.plot(t, error, color=BLACK, lw=1.0)
    lower.axhline(0.0, color=BLACK, lw=0.5, zorder=0)
    lower.set_ylabel("imbalance\n(% of the largest)")
    lower.ticklabel_format(axis="y", scilimits=(-3, 3), useMathText=True)
    lower.set_xlabel(label("time", time))
    for panel in (upper, lower):
        panel.grid(axis="y")
        panel.margins(x=0.01)
    _legend(figure, [upper])
    figure.align_ylabels()
    return figure
