"""Every deck of inputs/ gives its frozen numbers, each beside a bound from theory or papers.

inputs/<name>.expect.yaml says with which settings the deck is run and what the last rows of its
tables hold. `value` is what this version computed on the day in `frozen`; `rtol` is how near a
later version must come; `reference`, `within` and `source` bound it by something that is not this
program. `python tests/regression/test_decks.py` runs all decks and writes new values; it stops at a
bound.
"""

import csv
import datetime
import sys
import tempfile
from pathlib import Path

import pytest
import yaml

from cramp_cli.commands import RunOptions, run_deck

INPUTS = Path(__file__).resolve().parents[2] / "inputs"
DECKS = sorted(path for path in INPUTS.glob("*.yaml") if path.suffixes == [".yaml"])
HEAD = (
    "# Expected numbers of the deck beside it; read by tests/regression/test_decks.py, which says\n"
    "# what the keys mean.\n"
)


def expectation(deck):
    return deck.with_name(f"{deck.stem}.expect.yaml")


def run(deck, settings, folder):
    """Run a deck and return the rows of its tables by file name."""
    options = RunOptions(output=folder, overrides=settings, progress="none", verbosity=0)
    run_deck(deck, options)
    tables = {}
    for path in folder.glob("*.csv"):
        with path.open(newline="", encoding="utf-8") as file:
            tables[path.name] = list(csv.DictReader(file))
    return tables


def last(tables, entry):
    """Return the number that an entry speaks of: the last row of a table, of a tip if named."""
    rows = tables[entry["table"]]
    tip = entry.get("tip", "").split()
    if tip:
        rows = [row for row in rows if [row["crack"], row["tip"]] == tip]
    return float(rows[-1][entry["column"]])


def outside(entry, number):
    """Return whether a number is out of the bound of an entry."""
    return "reference" in entry and abs(number - entry["reference"]) > entry["within"]


@pytest.mark.parametrize("deck", DECKS, ids=lambda deck: deck.stem)
def test_deck_gives_its_numbers(deck, tmp_path):
    expected = yaml.safe_load(expectation(deck).read_text(encoding="utf-8"))
    tables = run(deck, expected["settings"], tmp_path / "run")
    for entry in expected["numbers"]:
        number = last(tables, entry)
        assert number == pytest.approx(entry["value"], rel=entry["rtol"], abs=entry.get("atol", 0))
        assert not outside(entry, number), f"{entry['column']}: {number}, {entry['source']}"


def test_every_number_with_a_source_has_a_bound():
    for deck in DECKS:
        numbers = yaml.safe_load(expectation(deck).read_text(encoding="utf-8"))["numbers"]
        assert any("reference" in entry for entry in numbers), deck.name


def freeze(deck):
    """Run a deck and write its numbers, if they are within their bounds."""
    expected = yaml.safe_load(expectation(deck).read_text(encoding="utf-8"))
    with tempfile.TemporaryDirectory() as folder:
        tables = run(deck, expected["settings"], Path(folder) / "run")
    for entry in expected["numbers"]:
        entry["value"] = last(tables, entry)
        if outside(entry, entry["value"]):
            sys.exit(f"{deck.name}: {entry['column']} = {entry['value']}: {entry['source']}")
    expected["frozen"] = datetime.date.today().isoformat()
    text = yaml.safe_dump(expected, sort_keys=False, width=96)
    expectation(deck).write_text(HEAD + text, encoding="utf-8")


if __name__ == "__main__":
    for path in DECKS:
        freeze(path)
