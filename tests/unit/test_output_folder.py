"""A run's folder: claimed by one, cleared on demand, never a stranger's."""

import subprocess
import sys

import pytest

from cramp_cli.output.atomic import write_json, write_text
from cramp_cli.output.exits import FILES, FolderError, exit_code
from cramp_cli.output.folder import OUR_FILES, FolderInUse, RunFolder


def earlier_run(path):
    with RunFolder(path) as folder:
        folder.begin("title: first\n", "title: first\n")
        write_json(path / "manifest.json", {"program": "cramp"})
        (path / "history.csv").write_text("step\n")
        (path / "checkpoints").mkdir()
    return path


def test_a_new_folder_keeps_the_deck_verbatim(tmp_path):
    path = tmp_path / "sub" / "my run ü"
    text = "a: 1   # Riß\n"
    with RunFolder(path) as folder:
        folder.begin(text, "a: 1.0\n")
    assert (path / "input.yaml").read_bytes() == text.encode()
    assert (path / "resolved.yaml").read_text() == "a: 1.0\n"


def test_an_earlier_run_is_kept_without_overwrite(tmp_path):
    path = earlier_run(tmp_path / "run")
    with pytest.raises(FolderError, match="--overwrite"):
        RunFolder(path)
    assert (path / "history.csv").exists()


def test_overwrite_removes_our_files_and_no_others(tmp_path):
    path = earlier_run(tmp_path / "run")
    (path / "my plot.png").write_text("picture")
    with RunFolder(path, overwrite=True) as folder:
        assert (path / "history.csv").exists()  # until the new run begins
        folder.begin("title: second\n", "")
        assert (path / "input.yaml").read_text() == "title: second\n"
    assert not (path / "history.csv").exists()
    assert not (path / "checkpoints").exists()
    assert (path / "my plot.png").exists()


def test_a_folder_of_others_is_refused_even_with_overwrite(tmp_path):
    (tmp_path / "thesis.tex").write_text("precious")
    with pytest.raises(FolderError, match=r"thesis\.tex"):
        RunFolder(tmp_path, overwrite=True)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["thesis.tex"]


@pytest.mark.parametrize("name", OUR_FILES)
def test_a_name_like_ours_does_not_make_it_ours(tmp_path, name):
    (tmp_path / name).write_text("by hand")
    with pytest.raises(FolderError, match="not a run of cramp"):
        RunFolder(tmp_path, overwrite=True)


def test_a_file_in_the_way_is_named(tmp_path):
    (tmp_path / "x").write_text("")
    with pytest.raises(FolderError, match="in the way"):
        RunFolder(tmp_path / "x")
    with pytest.raises(FolderError, match="in the way"):
        RunFolder(tmp_path / "x" / "y")


def test_a_run_that_never_began_leaves_no_trace(tmp_path):
    with RunFolder(tmp_path / "run"):
        pass
    assert not (tmp_path / "run").exists()


def test_a_second_run_is_refused_and_told_about_the_first(tmp_path):
    program = (
        "import sys; from cramp_cli.output.folder import RunFolder;"
        "f = RunFolder(sys.argv[1]); print('claimed', flush=True); sys.stdin.read()"
    )
    words = [sys.executable, "-c", program, str(tmp_path / "run")]
    with subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as first:
        first.stdout.readline()
        with pytest.raises(FolderInUse, match=f"in use by process {first.pid} on") as refusal:
            RunFolder(tmp_path / "run", overwrite=True)
        first.kill()
    assert exit_code(refusal.value) == FILES
    RunFolder(tmp_path / "run").release()  # a killed run holds nothing


def test_a_failed_replacement_leaves_the_old_text(tmp_path):
    write_text(tmp_path / "a", "old")
    with pytest.raises(UnicodeEncodeError):
        write_text(tmp_path / "a", "new \ud800")
    assert (tmp_path / "a").read_text() == "old"
    assert [path.name for path in tmp_path.iterdir()] == ["a"]
