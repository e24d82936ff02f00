"""The outcome of a run in a few numbers, and the page that shows it."""

import io
from math import isfinite, nan
from textwrap import fill
from typing import NamedTuple

from cramp_cli.output.tables import WIDTH, duration, number

BY_DOMAIN = ("x", "y", "J", "K_I", "K_II")
BY_CONTOUR = ("J_contour", "K_I_contour", "K_II_contour")
LONG = 12  # letters of a status that a table has room for


class Summary(NamedTuple):
    """What is said when a run is done; also kept in manifest.json."""

    steps: int
    time: float  # s
    wall_time: float  # s
    tips: list[dict]  # crack, tip, x, y (m), J (J/m^2), K_I, K_II (Pa m^0.5), status
    energy_error: float | None = None  # share of the largest energy
    particle_steps_per_second: float | None = None
    growth: tuple = ()  # of dict: crack, tip, grown (m), energy (J), x, y (m), fate
    events: tuple = ()  # of dict: time (s), event
    rest: str = ""  # whether it has come to rest, of runs with damping


def summary_text(summary: Summary) -> str:
    """Return the table of the tips and the numbers that judge the run."""
    rate, error = summary.particle_steps_per_second, summary.energy_error
    facts = {
        "rest": summary.rest,
        "energy error": "" if error is None else f"{100.0 * error:.3g} %",
        "wall time": f"{duration(summary.wall_time)} for {summary.steps} steps",
        "speed": "" if rate is None else f"{rate:.3g} particle-steps/s",
    }
    lines = [*map(growth_line, summary.growth)]
    lines += [f"{number(one['time'])} s: {one['event']}" for one in summary.events]
    lines += [f"{name:13} {text}" for name, text in facts.items() if text]
    return "\n".join([tips_text(summary.tips), *lines] if summary.tips else lines)


def growth_line(end: dict) -> str:
    """Return what became of an end that has grown."""
    name = f"{end['crack']} {end['tip']}"
    grown, energy, x, y = (number(end[key]) for key in ("grown", "energy", "x", "y"))
    return f"{name:13} grew {grown} m for {energy} J, {end['fate']} at ({x}, {y}) m"


def tips_text(tips: list[dict]) -> str:
    """Return a table with one line per crack tip."""
    from rich.console import Console  # late: keeps `cramp --help` fast

    page = io.StringIO()
    console = Console(file=page, width=WIDTH, no_color=True, force_terminal=False, markup=False)
    console.print(_table(tips))
    lines = [line.rstrip() for line in page.getvalue().splitlines()]
    return "\n".join([*lines, *(_status(tip) for tip in tips if len(tip["status"]) > LONG)])


def _status(tip: dict) -> str:
    """Return what a table has no room for: why the numbers of a tip can not be trusted."""
    return fill(f"{_name(tip)}: {tip['status']}", WIDTH, subsequent_indent="  ")


def _table(tips: list[dict]):
    from rich import box
    from rich.table import Table

    table = Table(box=box.ASCII2, show_edge=False, show_header=True)
    table.add_column("tip", overflow="fold", max_width=16)
    for heading in ("x\nm", "y\nm", "J\nJ/m^2", "K_I\nPa*m^0.5", "K_II\nPa*m^0.5"):
        table.add_column(heading, justify="right", no_wrap=True)
    table.add_column("status", no_wrap=True)
    for tip in tips:
        status = tip["status"] if len(tip["status"]) <= LONG else "see below"
        table.add_row(_name(tip), *_numbers(tip, "x", "y", "J", "K_I", "K_II"), status)
        if isfinite(tip.get("J_contour", nan)):
            table.add_row("  by contour", "", "", *_numbers(tip, *BY_CONTOUR), "")
    return table


def _name(tip: dict) -> str:
    return f"{tip.get('crack', '')} {tip.get('tip', '')}".strip()


def _numbers(tip: dict, *names: str) -> list[str]:
    return [number(tip.get(name)) for name in names]
