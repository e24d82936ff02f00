"""A deck of inputs/ runs as `cramp run` runs it; its rows are kept in memory instead of files."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from support import read

from cramp_cli.build import build
from cramp_cli.deck.deck import read_deck
from cramp_cli.simulation import simulate

INPUTS = Path(__file__).resolve().parents[1] / "inputs"


class Rows:
    """Stands in for the files of a run: keeps the rows of its tables, forgets the frames."""

    def __init__(self):
        self.tables = {"history": [], "cracks": [], "growth": []}

    def history(self, row):
        self.tables["history"].append(row)

    def tips(self, rows):
        self.tables["cracks"] += rows

    def growth(self, rows):
        self.tables["growth"] += rows

    def last_paths(self, rows):
        self.tables["path"] = rows

    def particle_frame(self, step, time, points, fields):
        pass

    def crack_frame(self, step, time, polylines, fields):
        pass


class Listener:
    """Stands in for the terminal: keeps the warnings."""

    def __init__(self):
        self.warnings = []

    def start(self, end_time, title, facts):
        pass

    def progress(self, step, time, wall, headline):
        pass

    def message(self, level, text):
        if level == "warning":
            self.warnings.append(text)


@dataclass
class Run:
    """A finished run."""

    model: Any
    state: Any
    tables: dict  # rows of history.csv and cracks.csv by name
    warnings: list

    @property
    def history(self):
        return self.tables["history"]

    @property
    def growth(self):
        return self.tables["growth"]

    def tip(self, end, crack=None):
        """Return the rows of one tip, of the crack named or of the only one."""
        rows = self.tables["cracks"]
        return [row for row in rows if row["tip"] == end and crack in (None, row["crack"])]


def run_input(name, *settings):
    """Run inputs/<name>.yaml to its end; `settings` are those of -s."""
    return _run(read_deck(INPUTS / f"{name}.yaml", settings))


def run_deck(deck, **overrides):
    """Run a deck, text or data, to its end; overrides as in `support.build_deck`."""
    return _run(read(deck, **overrides))


def _run(deck):
    model, state = build(deck)
    rows, listener = Rows(), Listener()
    simulate(deck, model, state, rows, listener)
    return Run(model, state, rows.tables, listener.warnings)
