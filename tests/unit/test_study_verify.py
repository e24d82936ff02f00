"""Numbers of a run are judged by bounds and by what they were; a mistake is told by its line."""

import csv

import numpy as np
import pytest
import yaml

from cramp_cli.deck.deck import DeckError
from cramp_cli.deck.expect import read_expectation
from cramp_cli.output.exits import FolderError
from cramp_cli.study.results import read_table
from cramp_cli.study.verify import chosen, freeze, judge, table
from cramp_cli.study.verify_page import write_page

K_I = {"table": "cracks.csv", "tip": "notch end", "column": "K_I"}
BOUND = {"reference": 100.0, "within": 2.0, "source": "theory"}
CURVE = {"curve": {"file": "curve.csv", "from": 1.0, "until": 3.0}, "within": 0.1, "source": "it"}


@pytest.fixture
def run(tmp_path):
    """A run whose K_I is 0, 25, ... 101 at 0, 1, ... 4 s."""
    folder = tmp_path / "run"
    folder.mkdir()
    rows = [("notch", "end", t, K) for t, K in enumerate((0, 25, 50, 75, 101))]
    write(folder / "cracks.csv", [("crack", "tip", "time", "K_I"), *rows])
    return folder


def write(path, rows):
    with path.open("w", newline="") as file:
        csv.writer(file).writerows(rows)


@pytest.fixture
def expect(tmp_path):
    def make(**entry):
        path = tmp_path / "plate.expect.yaml"
        path.write_text(yaml.safe_dump({"numbers": [K_I | entry]}))
        return read_expectation(path)

    return make


@pytest.mark.parametrize(
    ("entry", "verdict"),
    [
        ({}, "new"),
        ({"value": 101.0}, "pass"),
        ({"value": 101.002}, "changed"),
        ({"value": 101.002, "rtol": 1e-4}, "pass"),
        ({"value": 101.002, "atol": 0.01}, "pass"),
        ({"value": 101.0} | BOUND, "pass"),
        ({"value": 101.0} | BOUND | {"within": 0.9}, "off"),
    ],
)
def test_verdicts(run, expect, entry, verdict):
    (found,) = judge(expect(**entry), run)
    assert found.verdict == verdict
    assert found.passed == (verdict == "pass")


def test_no_number_is_out_of_any_bound(run, expect):
    write(run / "cracks.csv", [("crack", "tip", "time", "K_I"), ("notch", "end", 0, "nan")])
    assert judge(expect(value=float("1"), **BOUND), run)[0].verdict == "off"


def test_distance_from_a_curve_is_rms_over_its_peak(run, expect, tmp_path):
    """At 1, 2, 3 s K_I is 25, 50, 75 and twice the curve 20, 50, 80, which ends at 80."""
    write(tmp_path / "curve.csv", [("time", "K_I"), (1, 10), (3, 40)])
    entry = CURVE | {"curve": CURVE["curve"] | {"scale": 2.0}}
    (found,) = judge(expect(**entry), run)
    off = np.array([25 - 20, 50 - 50, 75 - 80])
    assert found.value == found.error == pytest.approx(np.sqrt(np.mean(off**2)) / 80.0)
    assert not found.outside


def test_nothing_is_frozen_out_of_a_bound(run, expect):
    case = expect(**BOUND | {"within": 0.9})
    before = case.path.read_bytes()
    with pytest.raises(FolderError, match=r"not frozen; K_I, notch end: 101 is out of its bound"):
        freeze(case, judge(case, run))
    assert case.path.read_bytes() == before


def test_what_is_frozen_passes(run, expect):
    case = expect(**BOUND)
    (found,) = judge(freeze(case, judge(case, run)), run)
    assert (found.frozen, found.verdict) == (101.0, "pass")


@pytest.mark.parametrize(
    ("entry", "told"),
    [
        ({"tip": "notch start"}, "numbers.0.tip: unknown tip 'notch start'; did you mean 'notch e"),
        ({"column": "K_1"}, "numbers.0.column: unknown column 'K_1'; did you mean 'K_I'"),
        (CURVE, "curve.csv: no such file"),
        ({"within": 1.0}, "numbers.0.within: goes with reference or curve"),
        (BOUND | {"source": None}, "numbers.0.source: is missing"),
        ({"aim": 1.0}, "numbers.0.aim: goes with within"),
        ({"tip": None}, "numbers.0.tip: goes with cracks.csv"),
        (BOUND | CURVE, "numbers.0.reference: goes without curve"),
    ],
)
def test_mistakes_are_told_with_their_line(run, expect, entry, told):
    with pytest.raises(DeckError) as caught:
        judge(expect(**entry), run)
    assert told in str(caught.value)
    assert "plate.expect.yaml:" in str(caught.value)


def test_a_table_names_a_case_once(run, expect):
    found = judge(expect(value=101.0, **BOUND), run) * 2
    lines = table(found).splitlines()
    assert [line.startswith("plate") for line in lines] == [False, True, False]
    assert lines[1].split()[-5:] == ["1", "%", "2", "%", "pass"]


def test_cases_are_chosen_by_name_or_effort():
    assert [case.name for case in chosen(["denp_100"])] == ["denp_100"]
    sizes = [len(chosen([], effort)) for effort in ("quick", "usual", "full")]
    assert 0 < sizes[0] < sizes[1] < sizes[2]
    with pytest.raises(FolderError, match="did you mean 'denp'"):
        chosen(["demp"])


def test_every_shipped_curve_and_deck_is_there():
    for case in chosen([], "full"):
        assert case.deck_path.exists(), case.path
        for entry in case.numbers:
            assert entry.curve is None or (case.path.parent / entry.curve.file).exists()


def test_a_page_shows_numbers_curves_and_sources(tmp_path):
    """A run that repeats its reference, a third too large: 18 % to 33 %, rms over the peak."""
    (case,) = chosen(["step_load_50"])
    curve = read_table(case.path.parent / "reference" / "step_load.csv")
    run = tmp_path / "runs" / case.name
    run.mkdir(parents=True)
    rows = [("half", "end", t, 4 * K / 3) for t, K in zip(*curve.values(), strict=True)]
    write(run / "cracks.csv", [("crack", "tip", "time", "K_I"), *rows])
    found = judge(case, run)
    page = write_page(tmp_path / "docs" / "all.md", [(case, found)], run.parent).read_text()
    assert 0.18 < found[0].error < 1 / 3
    line = next(line for line in page.splitlines() if line.startswith("| [step_load_50]"))
    assert line.endswith("| **2 %** | off |")
    assert "Out of their bounds: `step_load_50` K_I, half end" in page
    assert "Freund" in page
    assert (tmp_path / "docs" / "all" / "step_load_50.png").stat().st_size > 10_000
