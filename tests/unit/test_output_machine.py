"""Threads, sizes, limits, exit codes."""

import errno
import subprocess
import sys

import pytest

from cramp_cli.output import exits, machine
from cramp_cli.output.exits import OutOfResources, exit_code, one_line
from cramp_cli.state.failure import NumericalFailure


@pytest.mark.parametrize(
    ("text", "size"),
    [("8 GB", 8e9), ("8GiB", 8 * 2**30), ("512 MiB", 2**29), ("2e9", 2e9), ("1.5 kB", 1500)],
)
def test_sizes_as_people_write_them(text, size):
    assert machine.parse_bytes(text) == size


@pytest.mark.parametrize("text", ["", "GB", "8 apples", "-1 GB", "0", "1..2 GB", "nan"])
def test_what_is_no_size_is_refused(text):
    with pytest.raises(ValueError, match="write it like '8 GB'"):
        machine.parse_bytes(text)


def test_durations_and_intervals_as_people_write_them():
    assert machine.parse_duration("3h50m") == 13800.0
    assert machine.parse_duration("1d") == 86400.0
    assert machine.parse_interval("10m") == (None, 600.0)
    assert machine.parse_interval("500") == (500, None)


@pytest.mark.parametrize("text", ["", "0s", "soon", "10", "m", "1m1h", "-5m", "1.5h"])
def test_what_is_no_duration_is_refused(text):
    with pytest.raises(ValueError, match="write it like '3h50m'"):
        machine.parse_duration(text)


@pytest.mark.parametrize("text", ["0", "-3", "0m", "5 steps", "²"])
def test_what_is_no_interval_is_refused(text):
    with pytest.raises(ValueError, match="write it like '10m'"):
        machine.parse_interval(text)


@pytest.mark.parametrize(("size", "text"), [(999, "999 B"), (25.0e9, "25 GB"), (2e17, "200 PB")])
def test_sizes_as_people_read_them(size, text):
    assert machine.human_bytes(size) == text


def test_a_run_too_big_is_refused_with_both_numbers(tmp_path):
    needs = {"memory_bytes": 10**15, "disk_bytes": 10}
    with pytest.raises(OutOfResources, match=r"1 PB of memory \(1000000000000000 bytes\)"):
        machine.refuse_too_big(needs, tmp_path)


def test_limits_of_the_user_count(tmp_path):
    needs = {"memory_bytes": 2e6, "disk_bytes": 3e6}
    machine.refuse_too_big(needs, tmp_path / "not yet" / "there", 2_000_000, 3_000_000)
    with pytest.raises(OutOfResources, match="--max-memory allows 1 MB"):
        machine.refuse_too_big(needs, tmp_path, 1_000_000, 3_000_000)
    with pytest.raises(OutOfResources, match="--max-disk allows 1 MB"):
        machine.refuse_too_big(needs, tmp_path, 2_000_000, 1_000_000)


@pytest.fixture
def bare(monkeypatch):
    for name in (*machine.THREAD_VARIABLES, "NUMBA_NUM_THREADS"):
        monkeypatch.delenv(name, raising=False)
    return monkeypatch


def test_threads_are_asked_for_in_this_order(bare):
    assert machine.choose_threads() == machine.usable_cpus()
    for count, name in enumerate(reversed(machine.THREAD_VARIABLES), start=3):
        bare.setenv(name, str(count))
        assert machine.choose_threads() == count
    assert machine.choose_threads(7) == 7


@pytest.mark.parametrize("text", ["", "many", "0", "-2", "²"])
def test_nonsense_in_the_environment_is_passed_over(bare, text):
    bare.setenv("CRAMP_NUM_THREADS", text)
    assert machine.choose_threads() == machine.usable_cpus()


def test_a_container_sets_the_memory(monkeypatch, tmp_path):
    (tmp_path / "memory.max").write_text("3000\n")
    (tmp_path / "memory.current").write_text("1000\n")
    monkeypatch.setattr(machine, "CGROUP", tmp_path)
    assert machine.available_memory() == 2000
    (tmp_path / "memory.max").write_text("max\n")
    assert machine.available_memory() != 2000


@pytest.mark.parametrize(
    ("error", "code"),
    [
        (exits.FolderError("in the way"), 4),
        (FileNotFoundError(2, "No such file", "a.yaml"), 4),
        (OSError(errno.ENOSPC, "No space left"), 5),
        (MemoryError(), 5),
        (OutOfResources("too big"), 5),
        (NumericalFailure("NaN"), 6),
        (KeyboardInterrupt(), 130),
        (ZeroDivisionError("oops"), 70),
    ],
)
def test_exit_codes_of_errors(error, code):
    assert exit_code(error) == code
    assert "\n" not in one_line(error)
    assert one_line(error)


def test_an_error_of_a_file_names_it():
    assert one_line(FileNotFoundError(2, "No such file", "a.yaml")) == "a.yaml: No such file"


@pytest.mark.parametrize("megabytes", [100, 200, 300, 400, 700])
def test_a_small_limit_of_memory_is_refused_before_a_library_dies_of_it(tmp_path, megabytes):
    """OpenBLAS ends the process with 1, others say that a file is missing or an import failed."""
    deck = tmp_path / "d.yaml"
    deck.write_text("cramp: 1\n", encoding="utf-8")
    program = f"{sys.executable} -m cramp_cli check {deck}"
    words = ["bash", "-c", f"ulimit -v {megabytes}000 && exec {program}"]
    done = subprocess.run(words, capture_output=True, text=True)
    assert done.returncode == 5
    assert "the memory limit (ulimit -v) leaves" in done.stderr
