"""Two results are alike, or it is said which number is not."""

import json
import shutil

import h5py
import numpy as np
import pytest

from cramp_cli.__main__ import main
from cramp_cli.output.exits import FolderError
from cramp_cli.study.compare import Tolerance, assert_alike, compare

TIPS = """\
step,time,crack,tip,J,K_I,status
0,0,a,start,0,nan,ok
0,0,a,end,0,0,ok
10,1e-06,a,start,4,2e-07,ok
10,1e-06,a,end,8,3e-07,ok
"""


@pytest.fixture
def runs(tmp_path):
    """Two equal folders with results."""
    one, other = tmp_path / "one.run", tmp_path / "other.run"
    one.mkdir()
    (one / "cracks.csv").write_text(TIPS)
    (one / "run.log").write_text("not a result")
    with h5py.File(one / "particles.h5", "w") as file:
        file["frame_000000/fields/stress"] = np.arange(12.0).reshape(4, 3)
        file["frame_000000"].attrs["time"] = 0.5
        file["frame_000001/points"] = np.ones((4, 3))
    shutil.copytree(one, other)
    return one, other


def changed(runs, old, new, **options):
    """Return the report about a table in which a piece of text was replaced."""
    path = runs[1] / "cracks.csv"
    assert TIPS.count(old) == 1
    path.write_text(TIPS.replace(old, new))
    return compare(*runs, **options)


def test_equal_results_are_alike(runs):
    report = compare(*runs)
    assert report.alike
    assert report.values == 4 * 7 + 12 + 1 + 12
    assert_alike(*runs)


def test_a_ten_thousandth_is_found_and_named(runs):
    """However small the unit makes a column."""
    for old, new in (("4,2e-07", "4,2.0002e-07"), (",8,3", ",8.0008,3")):
        report = changed(runs, old, new)
        (difference,) = report.differences
        line = 4 if "e-07" in old else 5
        column = "K_I" if "e-07" in old else "J"
        assert f"cracks.csv: {column}, line {line} (step 10, time 1e-06)" in str(report)
        assert difference.off == pytest.approx(1e-4 * difference.reference)
        with pytest.raises(AssertionError, match=f"cracks.csv: {column}, line {line}"):
            assert_alike(*runs)


def test_limits_hold_for_all_or_for_one_column(runs):
    old, new = ",8,3", ",8.0008,3"
    assert changed(runs, old, new, rtol=1.1e-4).alike
    assert changed(runs, old, new, columns={"J": Tolerance(0.0, 9e-4)}).alike
    assert changed(runs, old, new, columns={"J": Tolerance(float("inf"))}).alike
    zero = "a,end,0,0", "a,end,5,0"
    assert changed(runs, *zero, columns={"J": Tolerance(float("inf"))}).alike
    assert not changed(runs, *zero, rtol=1e9).alike
    assert not changed(runs, old, new, columns={"K_I": Tolerance(1.0)}).alike
    assert not changed(runs, old, new, rtol=0.9e-4).alike


def test_round_off_of_zero_is_nothing(runs):
    assert changed(runs, "a,end,0,0", "a,end,7e-10,0").alike  # 1e-10 of the largest J, which is 8
    assert not changed(runs, "a,end,0,0", "a,end,9e-10,0").alike


@pytest.mark.parametrize(
    ("old", "new"),
    [("start,0,nan", "start,0,0"), ("4,2e-07", "4,nan"), ("3e-07,ok", "3e-07,closed"),
     ("4,2e-07", "4,inf"), ("a,end,8", "b,end,8")],
)  # fmt: skip
def test_words_and_what_is_no_number_must_be_the_same(runs, old, new):
    assert len(changed(runs, old, new).differences) == 1
    assert not changed(runs, old, new, rtol=1e3).alike


def test_the_worst_of_many_is_shown(runs):
    report = changed(runs, "4,2e-07,ok\n10,1e-06,a,end,8", "5,2e-07,ok\n10,1e-06,a,end,9.9")
    (difference,) = report.differences
    assert (difference.reference, difference.new, difference.count) == (4.0, 5.0, 2)
    assert "2 values of this column are off" in str(difference)


def test_rows_columns_and_files_that_are_missing_are_named(runs):
    report = changed(runs, "10,1e-06,a,end,8,3e-07,ok\n", "")
    assert "has 3 rows, the reference 4" in str(report)
    assert len(report.differences) == 1
    assert "cracks.csv: J: is missing in the new result" in str(changed(runs, ",J,", ",G,"))
    (runs[1] / "cracks.csv").unlink()
    assert f"cracks.csv: is missing in {runs[1]}" in str(compare(*runs))


def test_frames_are_compared_value_by_value(runs):
    with h5py.File(runs[1] / "particles.h5", "a") as file:
        file["frame_000000/fields/stress"][2, 1] = 7.001
        del file["frame_000001"]
    frame, stress = compare(*runs).differences
    assert (stress.column, stress.place) == ("frame_000000/fields/stress", "value 7 of 12")
    assert str(frame) == "particles.h5: frame_000001: is missing in the new result"
    assert len(compare(*runs, columns={"stress": Tolerance(1e-3)}).differences) == 1


def test_two_files_may_have_any_names(runs, tmp_path):
    shutil.copy(runs[0] / "cracks.csv", tmp_path / "paper.csv")
    assert compare(tmp_path / "paper.csv", runs[1] / "cracks.csv").alike


def test_tables_are_compared_in_time_tip_by_tip(tmp_path):
    """Between rows a linear function of time is met to round-off, whatever the steps."""

    def table(name, times, factor=1.0):
        rows = ["step,time,crack,tip,J"]
        for n, t in enumerate(times):
            rows += [f"{n},{t},a,start,{factor * t}", f"{n},{t},a,end,{100 - t}"]
        (tmp_path / name).write_text("\n".join(rows) + "\n")
        return tmp_path / name

    reference, fine = table("a.csv", (0, 1, 2)), table("b.csv", (0, 0.3, 0.9, 1.7, 2))
    assert not compare(reference, fine).alike
    assert compare(reference, fine, interpolate=True).alike
    (other,) = compare(reference, table("b.csv", (0, 1.5, 2), 1.1), interpolate=True).differences
    assert other.place == "line 6 (step 2, time 2)"
    (short,) = compare(reference, table("b.csv", (0, 1.5)), interpolate=True).differences
    assert np.isnan(short.new)


@pytest.mark.parametrize("text", ["", "a,b\n1\n"])
def test_what_can_not_be_read_is_named(tmp_path, text):
    (tmp_path / "a.csv").write_text(text)
    with pytest.raises(FolderError, match=r"a\.csv"):
        compare(tmp_path / "a.csv", tmp_path / "a.csv")
    (tmp_path / "a.h5").write_text("no HDF5")
    for name in ("a.h5", "a.txt", "nowhere"):
        with pytest.raises(FolderError, match=name):
            compare(tmp_path / name, tmp_path / name)


def test_diff_answers_people_and_programs(runs, capsys):
    words = ["diff", *map(str, runs)]
    assert main(words) == 0
    assert capsys.readouterr().out == "53 values are alike\n"
    assert not changed(runs, ",8,3", ",8.0008,3").alike
    assert main(words) == 1
    assert "cracks.csv: J, line 5" in capsys.readouterr().out
    assert main([*words, "--json"]) == 1
    assert json.loads(capsys.readouterr().out)["differences"][0]["column"] == "J"
    assert main([*words, "--column", "J:1e-3"]) == 0
    assert main([*words, "--column", "J:0:1e-3"]) == 0
    assert main([*words, "--rtol", "1e-3"]) == 0
    for wrong in ("J", "J:x", "J:-1", "J:1:1:1", "J:nan"):
        assert main([*words, "--column", wrong]) == 2
    assert main(["diff", "nowhere", str(runs[0])]) == 4
