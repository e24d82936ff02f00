"""What a run says, on the screen and in run.log."""

import pytest

from cramp_cli.output.log import Log, Reporter
from cramp_cli.output.summary import Summary, summary_text, tips_text
from cramp_cli.output.tables import WIDTH, duration, progress_head, progress_line

EXTRA = {"K_I": 1.23456789e6, "J": 336.0, "energy_error": -1.25e-12}
TIP = {
    "crack": "left notch of the plate",
    "tip": "start",
    "x": -0.0503145,
    "y": -0.0503145,
    "J": -12345.6,
    "K_I": -1.2345e-10,
    "K_II": -1.2345e-10,
    "status": "invalid: radius leaves the body",
}


def run(reporter, steps=1000):
    reporter.start(1.0, "A beam", {"particles": 4000, "dt": "1.2 us"})
    for step in range(steps + 1):
        reporter.progress(step, step / steps, step * 0.01, EXTRA)


def test_lines_grow_evenly_under_one_head(capsys):
    run(Reporter(progress="lines"))
    said = capsys.readouterr()
    assert said.out == ""
    lines = said.err.splitlines()
    assert lines[:3] == ["A beam", "  particles  4000", "  dt         1.2 us"]
    assert lines[3].split() == ["step", "time", "(s)", "%", "left", "K_I", "J", "energy_error"]
    assert 20 <= len(lines[4:]) <= 22
    assert max(map(len, lines)) <= WIDTH


def test_a_slow_run_speaks_every_minute(capsys):
    reporter = Reporter(progress="lines")
    reporter.start(1.0, "slow", {})
    for step in range(10):
        reporter.progress(step, step * 1e-6, step * 61.0, {})
    assert len(capsys.readouterr().err.splitlines()) == 12


def test_other_numbers_get_a_head_of_their_own(capsys):
    """When the last tip is gone the energy error is shown, and not as a J."""
    reporter = Reporter(progress="lines")
    reporter.start(1.0, "A plate breaks", {})
    reporter.progress(1, 0.4, 1.0, {"J": 336.0, "K_I": 1e6})
    reporter.progress(2, 0.6, 2.0, {"energy_error": -0.04})
    lines = capsys.readouterr().err.splitlines()[1:]
    assert [line.split()[4:] for line in (lines[0], lines[2])] == [
        ["left", "J", "K_I"],
        ["left", "energy_error"],
    ]
    assert lines[3].split()[-1] == "-0.04"


def test_the_log_holds_everything_though_the_screen_is_quiet(capsys, tmp_path):
    log = Log(tmp_path / "run.log")
    reporter = Reporter(log, progress="none", verbosity=0)
    run(reporter)
    reporter.message("info", "contour shrunk")
    reporter.message("warning", "energy error 2 %")
    log.close()
    assert capsys.readouterr().err == "warning: energy error 2 %\n"
    text = (tmp_path / "run.log").read_text()
    for part in ("A beam", "energy_error", "contour shrunk", "warning energy", "1.235e+06"):
        assert part.split()[-1] in text
    assert len(text.splitlines()) > 20


def test_a_bar_leaves_the_terminal_as_it_was(capsys):
    with Reporter(progress="bar") as reporter:
        run(reporter, steps=50)
        reporter.message("warning", "look [here]")
    assert "look [here]" in capsys.readouterr().err
    assert reporter._bar is None


def test_auto_means_lines_where_no_terminal_is():
    assert Reporter(progress="auto").mode == "lines"


def test_the_summary_fits_80_columns(capsys):
    summary = Summary(1500, 1.5e-3, 12.0, [TIP, TIP], 3e-4, 1.1e6)
    Reporter(progress="lines").summary(summary)
    said = capsys.readouterr().err
    assert said.rstrip("\n") == summary_text(summary)
    assert max(map(len, said.splitlines())) <= WIDTH
    for part in ("-1.235e+04", "-0.05031", "0.03 %", "1.1e+06 particle-steps/s", "1500 steps"):
        assert part in said
    assert said.isascii()


def test_a_tip_without_numbers_is_shown_by_its_status():
    text = tips_text([{"crack": "c", "tip": "end", "K_I": float("nan"), "status": "closed"}])
    assert "nan" in text
    assert "closed" in text


def test_contours_have_a_line_of_their_own():
    contour = {"J_contour": 336.03, "K_I_contour": 5.797e5, "K_II_contour": 1.0}
    text = tips_text([{"crack": "notch", "tip": "end", "status": "ok", **contour}])
    line = next(line for line in text.splitlines() if "by contour" in line)
    assert [cell.strip() for cell in line.split("|")[3:6]] == ["336", "5.797e+05", "1"]


def test_time_to_compile_is_not_carried_forward(capsys):
    reporter = Reporter(progress="lines")
    reporter.start(1.0, "", {})
    reporter.progress(1, 0.001, 100.0, {})
    reporter.progress(500, 0.5, 101.0, {})
    lines = capsys.readouterr().err.splitlines()
    assert lines[-2].split() == ["1", "0.001", "0"]
    assert lines[-1].split() == ["500", "0.5", "50", "1.0", "s"]


def test_lines_align():
    head, line = progress_head(EXTRA), progress_line(12, 1.5e-3, 0.5, 4000.0, EXTRA)
    assert len(head) == len(line) <= WIDTH


@pytest.mark.parametrize(
    ("seconds", "text"),
    [(None, ""), (0.04, "0.0 s"), (9.96, "10 s"), (99.6, "1m40"), (187, "3m07"), (8130, "2h15")],
)
def test_durations(seconds, text):
    assert duration(seconds) == text
