"""Every deck of inputs/ gives its frozen numbers, each beside a bound from theory or papers.

`cramp verify` does the same; `cramp verify --update` writes new values, unless a bound is missed.
"""

import pytest

from cramp_cli.commands import run_case
from cramp_cli.deck.expect import read_expectation
from cramp_cli.study.templates import template_folder
from cramp_cli.study.verify import cases, judge

CASES = cases()


def is_slow(path):
    return path.parent.name == "verification" and read_expectation(path).effort != "quick"


SLOW = {name for name, path in CASES.items() if is_slow(path)}
ALL = [pytest.param(n, marks=pytest.mark.slow) if n in SLOW else n for n in CASES]


@pytest.mark.parametrize("name", ALL)
def test_deck_gives_its_numbers(name, tmp_path):
    case = read_expectation(CASES[name])
    findings = judge(case, run_case(case, tmp_path / "run"))
    assert [one for one in findings if not one.passed] == []


@pytest.mark.parametrize("name", CASES)
def test_every_case_has_a_bound(name):
    numbers = read_expectation(CASES[name]).numbers
    assert any(entry.within is not None for entry in numbers)


def test_every_deck_is_a_case():
    decks = {p.stem for p in template_folder().glob("*.yaml") if p.suffixes == [".yaml"]}
    assert decks <= set(CASES)
