"""Many runs from one deck: cases, how they end, what is collected."""

import csv
import json
import os
import re
import signal
import sys
import threading

import numpy as np
import pytest
from written import PLATE, write_run

from cramp_cli.deck.sweep import read_study
from cramp_cli.output.exits import DIFFERENT, DONE, FolderError, OutOfResources
from cramp_cli.schema.mistake import DeckError
from cramp_cli.study import one_case
from cramp_cli.study.cases import expand
from cramp_cli.study.collect import in_si
from cramp_cli.study.manage import (
    SweepOptions,
    collect_study,
    open_study,
    report_folder,
    run_study,
    tell_study,
)
from cramp_cli.study.outcome import SweepFolder
from cramp_cli.study.sweep import run_cases, to_do

HEAD = "cramp_sweep: 1\ndeck: plate.yaml\nvary:\n"
FOUR = HEAD + "  - {type: grid, over: {solver.cfl: [0.1, 0.2, 0.3, 0.4]}}\n"
TWO = "  - {type: KIND, over: {solver.cfl: [0.1, 0.2], title: [a, b]}}\n"
OPTIONS = SweepOptions(jobs=2, verbosity=0)


@pytest.fixture
def study(tmp_path, monkeypatch):
    """Return what writes a study beside its base deck and gives its path."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "plate.yaml").write_text(PLATE, encoding="utf-8")

    def write(text):
        (tmp_path / "cfl.sweep.yaml").write_text(text, encoding="utf-8")
        return tmp_path / "cfl.sweep.yaml"

    return write


def parameters(path):
    return [case.parameters for case in expand(read_study(path))]


# ------------------------------------------------------------------ cases


def test_a_grid_has_every_combination(study):
    cases = parameters(
        study(HEAD + "  - {type: grid, over: {solver.cfl: [0.1, 0.2], title: [a, b]}}")
    )
    assert [tuple(case.values()) for case in cases] == [
        *((0.1, "a"), (0.1, "b"), (0.2, "a"), (0.2, "b"))
    ]


def test_zip_takes_values_together(study):
    cases = parameters(
        study(HEAD + "  - {type: zip, over: {solver.cfl: [0.1, 0.2], title: [a, b]}}")
    )
    assert [tuple(case.values()) for case in cases] == [(0.1, "a"), (0.2, "b")]


def test_entries_of_vary_are_combined(study):
    text = HEAD + "  - {type: list, cases: [{solver.cfl: 0.1}, {solver.cfl: 0.2, title: b}]}\n"
    cases = parameters(study(text + "  - {type: grid, over: {thickness: [1 mm, 2 mm, 3 mm]}}"))
    assert len(cases) == 6
    assert cases[-1] == {"solver.cfl": 0.2, "title": "b", "thickness": "3 mm"}


@pytest.mark.parametrize("kind", ["latin_hypercube", "sobol"])
def test_samples_fill_their_range_and_repeat_with_their_seed(study, kind):
    ranges = "{solver.cfl: {from: 0.1, to: 0.5}, thickness: {from: 1 mm, to: 100 mm, scale: log}}"
    text = HEAD + f"  - {{type: {kind}, samples: 8, seed: 5, over: {ranges}}}"
    cases = parameters(study(text))
    cfl = np.sort([case["solver.cfl"] for case in cases])
    assert np.array_equal(np.floor((cfl - 0.1) / 0.05), np.arange(8))  # one in every eighth
    sizes = [float(case["thickness"].removesuffix(" mm")) for case in cases]
    assert sum(size < 10.0 for size in sizes) == 4  # half of them below the middle of the log
    assert parameters(study(text)) == cases
    assert parameters(study(text.replace("seed: 5", "seed: 6"))) != cases


def test_whole_numbers(study):
    text = HEAD + (
        "  - {type: latin_hypercube, samples: 4, seed: 1, over: "
        "{bodies.plate.particles_per_cell: {from: 1, to: 4, whole: true}}}"
    )
    assert all(type(*case.values()) is int for case in parameters(study(text)))


def test_equal_decks_are_one_case_and_a_changed_deck_is_another(study, tmp_path):
    path = study(HEAD + "  - {type: grid, over: {thickness: [1 mm, 0.001]}}")
    (only,) = expand(read_study(path))
    (tmp_path / "plate.yaml").write_text(PLATE.replace("nu: 0.2", "nu: 0.3"), encoding="utf-8")
    (changed,) = expand(read_study(path))
    assert only.name != changed.name


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("  - {type: zip, over: {a: [1], b: [1, 2]}}", "4:35: vary.0.over.b: must have as many"),
        ("  - {type: grid, over: {a: []}}", "vary.0.over.a: must have at least 1 value"),
        ("  - {type: gird, over: {a: [1]}}", "unknown type 'gird'; did you mean 'grid'?"),
        (
            "  - {type: sobol, samples: 6, seed: 0, over: {a: {from: 0, to: 1}}}",
            "samples: must be a power of 2, such as 4 or 8 (got 6)",
        ),
        (
            "  - {type: sobol, samples: 4, seed: 0, over: {a: {from: 1 mm, to: 2}}}",
            "a.to: must have the unit of `from` (mm) (got none)",
        ),
        (
            "  - {type: sobol, samples: 4, seed: 0, over: {a: {from: x, to: 2}}}",
            "a.from: must be a number",
        ),
        (
            "  - {type: sobol, samples: 4, seed: 0, over: {a: {from: 2, to: 2}}}",
            "a.to: must be above `from` (2) (got 2)",
        ),
        (
            "  - {type: sobol, samples: 4, seed: 0, over: {a: {from: 0, to: 2, scale: log}}}",
            "a.from: must be above 0 with scale: log",
        ),
        (
            "  - {type: grid, over: {solver.clf: [0.1], title: [a]}}",
            "-s solver.clf=0.1: solver.clf: unknown key; did you mean 'cfl'?",
        ),
        (
            "  - {type: grid, over: {title: [a]}}\ncollect: [{column: K_1}]",
            "5:20: collect.0.column: unknown column 'K_1'",
        ),
        (
            "  - {type: grid, over: {title: [a]}}\ncollect: [{column: K_I, take: at}]",
            "collect.0.time: is missing; take: at needs it",
        ),
    ],
)
def test_mistakes_of_a_study_are_told_before_it_runs(study, text, told):
    with pytest.raises(DeckError) as caught:
        open_study(study(HEAD + text))
    assert told in str(caught.value)


# ------------------------------------------------------------------ runs


WORKER = """
import json, os, pathlib, signal, sys, time
folder, how = pathlib.Path(sys.argv[1]), sys.argv[2]
folder.mkdir(parents=True, exist_ok=True)
with (folder / "lives").open("a") as file:
    file.write(how + "\\n")
def manifest(code, status):
    record = {"program": "cramp", "status": status, "exit_code": code, "error": "went wrong"}
    (folder / "manifest.json").write_text(json.dumps(record))
manifest(None, "running")
K_I = int(folder.name, 16) % 1000 / 7
(folder / "cracks.csv").write_text(f"time,crack,tip,K_I\\n0,notch,end,{K_I}\\n")
if how == "hang": time.sleep(60)
if how == "die": os.kill(os.getpid(), signal.SIGKILL)
code = {"fail": 6, "refuse": 4}.get(how, 0)
if how == "refuse":
    (folder / "manifest.json").unlink()
    print("cramp: disk on fire", file=sys.stderr)
else:
    manifest(code, "done" if code == 0 else "failed")
sys.exit(code)
"""


@pytest.fixture
def workers(monkeypatch):
    """Stand-ins for runs: each does what `how` says for its cfl, and is done without a word."""
    how = {}

    def command(sweep, case):
        words = [str(sweep.folder.run(case.name)), how.get(case.parameters["solver.cfl"], "done")]
        return [sys.executable, "-c", WORKER, *words]

    monkeypatch.setattr(one_case, "command", command)
    return how


def lives(path, cfl):
    """Return how often the case of a cfl was run."""
    study = open_study(path)
    case = next(c for c in study.cases if c.parameters["solver.cfl"] == cfl)
    return (study.folder.run(case.name) / "lives").read_text().split()


def test_failed_hung_and_killed_cases_are_told_and_run_again_alone(study, workers):
    path = study(FOUR + "timeout: 5 s\n")
    workers.update({0.2: "fail", 0.3: "hang", 0.4: "die"})
    code, folder = run_study(path, OPTIONS)
    assert (code, folder.name) == (DIFFERENT, "cfl.sweep")
    assert SweepFolder(folder).study() == path.resolve()
    told = {row["solver.cfl"]: row for row in json.loads(tell_study(path, None, as_json=True))}
    assert [told[cfl]["word"] for cfl in (0.1, 0.2, 0.3, 0.4)] == [
        "done",
        "failed",
        "hung",
        "killed",
    ]
    assert (told[0.2]["exit_code"], told[0.2]["reason"]) == (6, "went wrong")
    assert told[0.4]["reason"] == "ended by signal 9"
    assert tell_study(path, None, as_json=False).startswith(
        f"{path}: 4 cases, 1 done, 1 failed, 1 hung, 1 killed\n"
    )
    workers.clear()
    assert run_study(path, OPTIONS)[0] == DONE
    assert [len(lives(path, cfl)) for cfl in (0.1, 0.2, 0.3, 0.4)] == [1, 2, 2, 2]


def test_a_run_that_never_began_says_why(study, workers):
    path = study(FOUR)
    workers[0.2] = "refuse"
    run_study(path, OPTIONS)
    assert "failed" in tell_study(path, None, as_json=False)
    assert "disk on fire" in tell_study(path, None, as_json=False)


def test_a_case_that_another_sweep_has_done_meanwhile_is_left_alone(study, workers):
    path = study(FOUR)
    opened = open_study(path)
    sweep = one_case.Sweep(opened.study.deck_path, opened.cases, opened.folder)
    todo = to_do(sweep)
    run_study(path, OPTIONS)
    run_cases(sweep, todo, 1, lambda case, outcome: None)
    assert [lives(path, cfl) for cfl in (0.1, 0.2, 0.3, 0.4)] == [["done"]] * 4


def test_one_case_alone_ends_with_its_own_code(study, workers):
    path = study(FOUR)
    workers[0.2] = "fail"
    name = open_study(path).cases[1].name
    assert run_study(path, OPTIONS._replace(only=name))[0] == 6
    assert "1 failed, 3 missing" in tell_study(path, None, as_json=False)
    with pytest.raises(FolderError, match="has no case 'zzz'"):
        run_study(path, OPTIONS._replace(only="zzz"))


def test_many_cases_need_force(study, workers):
    path = study(FOUR)
    with pytest.raises(OutOfResources, match="4 cases to run; more than 3 need --force"):
        run_study(path, OPTIONS._replace(most=3))
    assert run_study(path, OPTIONS._replace(most=4))[0] == DONE
    assert run_study(path, OPTIONS._replace(most=0))[0] == DONE  # nothing is left to run


def test_a_signal_to_end_reaches_the_runs(study, workers):
    path = study(FOUR)
    workers.update(dict.fromkeys((0.1, 0.2, 0.3, 0.4), "hang"))
    timer = threading.Timer(3.0, os.kill, (os.getpid(), signal.SIGTERM))
    timer.start()
    code, _ = run_study(path, OPTIONS)
    timer.join()
    assert code == DIFFERENT
    assert "2 killed, 2 missing" in tell_study(path, None, as_json=False)


def test_a_run_that_lost_its_starter_is_waited_for(study, workers, monkeypatch):
    """Another dask worker takes the case while its run goes on: one life, and it is done."""
    path = study(FOUR)
    opened = open_study(path)
    sweep = one_case.Sweep(opened.study.deck_path, opened.cases, opened.folder)
    case, run = opened.cases[0], opened.folder.run(opened.cases[0].name)
    write_run(run)
    (run / "manifest.json").write_text('{"program": "cramp", "exit_code": null}')
    looks = []

    def sleep(seconds):
        looks.append(seconds)
        (run / "manifest.json").write_text('{"program": "cramp", "exit_code": 0}')

    monkeypatch.setattr(one_case, "sleep", sleep)
    monkeypatch.setattr(one_case, "in_use", lambda folder: folder == run and not looks)
    assert one_case.take_up(sweep, case) == "done"
    assert len(looks) == 1
    assert not (run / "lives").exists()


def test_the_table_from_dask_is_that_from_here(study, workers, tmp_path):
    distributed = pytest.importorskip("distributed")
    path = study(FOUR + "collect: [{column: K_I}]\n")
    here, there = tmp_path / "here.csv", tmp_path / "there.csv"
    workers[0.3] = "fail"
    run_study(path, OPTIONS)
    collect_study(path, None, here)
    with distributed.LocalCluster(2, threads_per_worker=1, processes=False) as cluster:
        address = cluster.scheduler_address
        options = OPTIONS._replace(output=tmp_path / "d", backend="dask", scheduler=address)
        assert run_study(path, options)[0] == DIFFERENT
    collect_study(path, tmp_path / "d", there)
    assert there.read_bytes() == here.read_bytes()
    assert len(set(here.read_text().split())) == 5  # a head and four different rows


def test_without_a_scheduler_one_line_says_so(study, workers):
    pytest.importorskip("distributed")
    options = OPTIONS._replace(backend="dask", scheduler="tcp://127.0.0.1:1")
    with pytest.raises(FolderError, match="no dask scheduler answers"):
        run_study(study(FOUR), options)


def test_slurm_gets_the_cases_that_are_not_done(study, workers):
    path = study(FOUR)
    name = open_study(path).cases[1].name
    run_study(path, OPTIONS._replace(only=name))
    _, script = run_study(path, OPTIONS._replace(backend="slurm"))
    text, todo = script.read_text(), (script.parent / "todo.txt").read_text().split()
    assert "#SBATCH --array=0-2%2\n" in text
    assert len(todo) == 3
    assert name not in todo
    assert (
        '-eq 75 ]; then\n  scontrol requeue "${SLURM_ARRAY_JOB_ID}_${SLURM_ARRAY_TASK_ID}"' in text
    )


def test_the_slurm_script_runs_its_case_and_queues_what_stopped(study, workers, tmp_path):
    """The script runs in bash with stand-ins for srun and scontrol; the run ends with 75."""
    _, script = run_study(study(FOUR), OPTIONS._replace(backend="slurm"))
    (tmp_path / "bin").mkdir()
    for name, body in {
        "srun": 'echo "$@" > ran; exit 75',
        "scontrol": 'echo "$@" > queued',
    }.items():
        (tmp_path / "bin" / name).write_text(f"#!/bin/bash\n{body}\n")
        (tmp_path / "bin" / name).chmod(0o755)
    environment = {
        "PATH": f"{tmp_path / 'bin'}:{os.environ['PATH']}",
        "SLURM_ARRAY_TASK_ID": "2",
        "SLURM_ARRAY_JOB_ID": "17",
    }
    code = os.spawnve(os.P_WAIT, "/bin/bash", ["bash", str(script)], environment)
    case = (script.parent / "todo.txt").read_text().split()[2]
    assert code == 75
    assert (tmp_path / "ran").read_text().split()[-2:] == ["--only", case]
    assert (tmp_path / "queued").read_text() == "requeue 17_2\n"


# ------------------------------------------------------------------ results


COLLECT = """\
collect:
  - {column: K_I, take: max}
  - {column: K_I, take: at, time: 1 us, tip: notch end}
  - {column: J, take: min}
  - {column: kinetic_energy}
"""


def test_a_row_per_case_with_its_numbers(study):
    path = study(HEAD + "  - {type: list, cases: [{thickness: 1 mm}, {title: b}]}\n" + COLLECT)
    opened = open_study(path)
    write_run(opened.folder.run(opened.cases[0].name), K_I=4e5)
    table = collect_study(path, None, None)
    with table.open(encoding="utf-8", newline="") as file:
        first, second = csv.DictReader(file)
    assert list(first) == [
        *("case", "thickness", "title", "state", "exit_code", "notch_end.K_I.max"),
        *("notch_end.K_I.at_1e-06", "notch_end.J.min", "kinetic_energy.last"),
        "notch_end.status",
    ]
    assert [float(first[name]) for name in list(first)[5:-1]] == [4e5, 2e5, 0.0, 2e-6]
    assert (first["thickness"], first["title"], first["state"]) == ("0.001", "", "done")
    assert (second["title"], second["state"], second["notch_end.J.min"]) == ("b", "missing", "")


@pytest.mark.parametrize(("time", "K_I"), [("1.5 us", "300000.0"), ("1 ms", "")])
def test_a_number_at_a_time_is_that_of_this_time(study, time, K_I):
    """K_I rises by 2e5 in each us until 2 us: the row nearest to 1.5 us has 2e5 or 4e5."""
    take = f"collect: [{{column: K_I, take: at, time: {time}}}]"
    path = study(HEAD + "  - {type: list, cases: [{thickness: 1 mm}]}\n" + take)
    opened = open_study(path)
    write_run(opened.folder.run(opened.cases[0].name), K_I=4e5)
    with collect_study(path, None, None).open(encoding="utf-8", newline="") as file:
        (row,) = csv.DictReader(file)
    assert list(row.values())[-2] == K_I


@pytest.mark.parametrize(
    ("statuses", "told"),
    [
        (("doubtful: early", "ok", "ok"), "ok"),
        (("ok", "closed", "ok"), "closed"),
        (("ok", "closed", "invalid: late"), "invalid: late | closed"),
    ],
)
def test_the_table_says_what_the_rows_said_that_its_numbers_are_of(study, statuses, told):
    """The largest K_I is that of the last row; at 1.5 us it lies between the second and third."""
    take = ["{column: K_I, take: max}", "{column: K_I, take: at, time: 1.5 us}"]
    text = HEAD + "  - {type: list, cases: [{thickness: 1 mm}]}\ncollect: [" + ", ".join(take) + "]"
    opened = open_study(path := study(text))
    write_run(opened.folder.run(opened.cases[0].name), statuses=statuses)
    opened.folder.remember(path)
    with collect_study(path, None, None).open(encoding="utf-8", newline="") as file:
        (row,) = csv.DictReader(file)
    assert row["notch_end.status"] == told
    page = report_folder(opened.folder.path, None).read_text(encoding="utf-8")
    assert f"<td>{told}</td>" in page


def test_the_page_of_a_sweep_holds_every_case(study):
    path = study(HEAD + "  - {type: list, cases: [{thickness: 1 mm}, {title: <b>}]}\n" + COLLECT)
    opened = open_study(path)
    write_run(opened.folder.run(opened.cases[0].name), K_I=4e5)
    opened.folder.remember(path)
    page = report_folder(opened.folder.path, None).read_text(encoding="utf-8")
    data = json.loads(re.search(r'id="data">(.*?)</script>', page)[1])
    assert data["parameters"] == ["thickness", "title"]
    assert list(data["numbers"].values())[0] == "notch_end.K_I.max (Pa*m^0.5)"
    assert [row["thickness"] for row in data["rows"]] == [0.001, None]
    assert data["rows"][0]["notch_end.K_I.max"] == 4e5
    assert '<p class="sub">2 cases: 1 done, 1 missing</p>' in page
    assert "&lt;b&gt;" in page
    assert "<td><b>" not in page


def test_the_page_of_a_sweep_whose_study_is_gone_says_what_to_do(study, workers):
    path = study(FOUR)
    _, folder = run_study(path, OPTIONS)
    path.unlink()
    with pytest.raises(FolderError, match="cramp sweep run STUDY -o cfl.sweep"):
        report_folder(folder, None)


def test_the_table_as_parquet_has_the_same_numbers(study, tmp_path):
    parquet = pytest.importorskip("pyarrow.parquet")
    path = study(HEAD + "  - {type: list, cases: [{thickness: 1 mm}, {title: b}]}\n" + COLLECT)
    opened = open_study(path)
    write_run(opened.folder.run(opened.cases[0].name), K_I=4e5)
    table = parquet.read_table(collect_study(path, None, tmp_path / "all.parquet"))
    with collect_study(path, None, None).open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert table.column_names == list(rows[0])
    told = [
        {name: "" if x is None else str(x) for name, x in row.items()} for row in table.to_pylist()
    ]
    assert told == rows


def test_an_unknown_tip_is_named(study):
    path = study(FOUR + "collect: [{column: K_I, tip: notch start}]\n")
    opened = open_study(path)
    write_run(opened.folder.run(opened.cases[0].name))
    with pytest.raises(FolderError, match="unknown tip 'notch start'"):
        collect_study(path, None, None)


@pytest.mark.parametrize(
    ("value", "number"), [("5 mm", 0.005), (3, 3), ("usf", "usf"), ("2 apples", "2 apples")]
)
def test_values_are_collected_in_si(value, number):
    assert in_si(value) == number
