"""The promises of docs/reliability.md, each test by the number of its promise.

What takes longer is in test_soak.py.
"""

import csv
import json
import os
import re
import resource
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from fuzz import generated, mutated
from plate import GROWING, PLATE
from promises import STEPS, begin, cramp, differences, run_in_pieces, wait_for
from runs import INPUTS
from support import build_deck, read

from cramp_cli import simulation
from cramp_cli.build import build
from cramp_cli.build.model import time_step
from cramp_cli.cracks.crossing import double_area
from cramp_cli.deck.deck import read_deck
from cramp_cli.energy_balance import Balance
from cramp_cli.numerics import kernel_cache
from cramp_cli.output.checkpoint import checkpoints, read_state
from cramp_cli.output.exits import FolderError
from cramp_cli.output.fields import read_frames
from cramp_cli.output.look import describe, facts
from cramp_cli.output.stop import Signs
from cramp_cli.settling import Settling
from cramp_cli.simulation import DUES, MOST_REMARKS, _Run
from cramp_cli.state.failure import NumericalFailure
from cramp_cli.state.measures import FIELDS

DECKS = sorted(path for path in INPUTS.glob("*.yaml") if "." not in path.stem)
LONG = ("-s", "solver.end_time=1")  # s: nobody waits for its end


def manifest(run):
    return json.loads((run / "manifest.json").read_text(encoding="utf-8"))


# ------------------------------------------------------------------ 1 the same bytes


@pytest.mark.parametrize(
    "stops", [(0,), (1,), (57,), (30, 31, 90), (STEPS,)], ids=lambda stops: str(stops)
)
def test_1_a_run_in_pieces_is_the_same_to_the_byte(here, stops):
    whole = run_in_pieces(here / "plate.yaml", here / "whole")
    pieces = run_in_pieces(here / "plate.yaml", here / "pieces", stops)
    assert manifest(pieces)["status"] == "done"
    assert [part["step"] for part in manifest(pieces)["parts"]] == [0, *stops]
    assert differences(whole, pieces) == []
    parts = facts(describe(pieces))["parts"]
    assert parts.startswith(f"{len(stops) + 1}, taken up at step {stops[0]}")


@pytest.mark.parametrize("deck", DECKS, ids=lambda deck: deck.stem)
def test_1_every_deck_of_inputs_can_be_run_in_pieces(tmp_path, deck):
    """Sixty steps each: symmetry planes, friction, several cracks, growth if there is any."""
    dt = time_step(read_deck(deck))
    settings = {"solver.end_time": 60, "output.every": 20, "output.history_every": 7}
    settings |= {"fracture.every": 10}
    options = {"overrides": [f"{key}={steps * dt!r}" for key, steps in settings.items()]}
    options["checkpoint_every"] = 60, None
    whole = run_in_pieces(deck, tmp_path / "whole", **options)
    pieces = run_in_pieces(deck, tmp_path / "pieces", (13, 40), **options)
    assert differences(whole, pieces) == []


def test_1_a_growing_crack_can_be_run_in_many_pieces(here):
    """Its lists are as long as the crack was at the start of a piece; no sample may show that."""
    (here / "growing.yaml").write_text(GROWING, encoding="utf-8")
    options = {"overrides": ["output.every=1 us", "solver.end_time=40 us"]}
    options["checkpoint_every"] = 25, None
    whole = run_in_pieces(here / "growing.yaml", here / "whole", **options)
    pieces = run_in_pieces(here / "growing.yaml", here / "pieces", range(25, 220, 25), **options)
    assert differences(whole, pieces) == []


@pytest.mark.parametrize("update", ["fmpm(2)", "xpic(2)"])
def test_1_every_update_can_be_run_in_pieces(here, update):
    options = {"overrides": [f"solver.update={update}"]}
    whole = run_in_pieces(here / "plate.yaml", here / "whole", **options)
    pieces = run_in_pieces(here / "plate.yaml", here / "pieces", (50,), **options)
    assert differences(whole, pieces) == []


def test_1_means_over_time_go_on_where_they_were(here):
    """Stops within the time of a mean, and just before a row of the table."""
    options = {"overrides": ["fracture.means=true", "fracture.every=2 us"]}
    options["checkpoint_every"] = 1, None
    whole = run_in_pieces(here / "plate.yaml", here / "whole", **options)
    pieces = run_in_pieces(here / "plate.yaml", here / "pieces", (29, 33, 60), **options)
    assert differences(whole, pieces) == []
    with (whole / "cracks.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert any(float(row["K_I_mean"]) != float(row["K_I"]) for row in rows)


def test_1_all_that_the_loop_over_time_holds_is_kept_or_follows_from_the_state():
    """A new attribute of the loop belongs into `remember`, or into the list here."""
    model, state, _ = build_deck(PLATE)
    run = _Run(read(PLATE), model, state, None, None, 1, None)
    follows = {"deck", "model", "state", "outputs", "reporter", "keeper", "scratch", "watch"}
    follows |= {"begun_at", "judged"}
    kept = set(run.remember())
    assert set(vars(run)) - follows - {*DUES} == kept - {"due"}
    assert set(vars(run.balance)) - {"limits", "solver"} == {*Balance.REMEMBERED}
    assert set(vars(run.settling)) == {*Settling.REMEMBERED}
    assert set(vars(run.history_due)) == {"every", "slack", "count"}


def test_1_the_number_of_threads_does_not_matter(here):
    for threads in (1, 2, 4):
        words = ("-t", threads, "--checkpoint-every", STEPS)
        assert cramp("run", "plate.yaml", "-o", f"{threads}.run", *words).returncode == 0
    assert differences(here / "1.run", here / "2.run") == []
    assert differences(here / "1.run", here / "4.run") == []


def test_1_a_run_that_ends_at_rest_ends_at_the_same_byte(here):
    """Its drag and its end hang on what it has seen: in pieces and with any number of threads."""
    rest = {"damping": "auto", "stop_when": "at_rest", "end_time": "2 ms"}
    sets = [f"solver.{key}={value}" for key, value in rest.items()]
    options = {"overrides": sets, "checkpoint_every": (50, None)}
    whole = run_in_pieces(here / "plate.yaml", here / "whole", **options)
    assert manifest(whole)["summary"]["rest"].startswith("at rest at ")
    end = manifest(whole)["summary"]["steps"]
    stops = 33, end // 2, end - 1
    pieces = run_in_pieces(here / "plate.yaml", here / "pieces", stops, **options)
    assert differences(whole, pieces) == []
    for threads in (2, 4):
        words = ("-t", threads, "--checkpoint-every", 50, *(w for s in sets for w in ("-s", s)))
        assert cramp("run", "plate.yaml", "-o", f"{threads}.run", *words).returncode == 0
        assert differences(whole, here / f"{threads}.run") == []


@pytest.mark.slow
@pytest.mark.parametrize(
    ("deck", "cell", "end"), [("composite", "0.5 mm", "42 us"), ("five_disks", "1 mm", "56 us")]
)
def test_1_cracks_that_grow_do_so_in_pieces_and_with_any_number_of_threads(
    tmp_path, deck, cell, end
):
    """Round an inclusion; towards a contact. Both stops come while a tip runs."""
    settings = [f"grid.cell={cell}", f"solver.end_time={end}", "output.every=20 us"]
    path, every = INPUTS / f"{deck}.yaml", 10
    options = {"overrides": settings, "checkpoint_every": (every, None)}
    whole = run_in_pieces(path, tmp_path / "whole", **options)
    with (whole / "growth.csv").open() as file:
        steps = [int(row["step"]) for row in csv.DictReader(file) if row["kind"] == "growth"]
    assert len(steps) > 6
    stops = steps[2] + 1, steps[-2] + 1
    assert differences(whole, run_in_pieces(path, tmp_path / "pieces", stops, **options)) == []
    words = [word for setting in settings for word in ("-s", setting)]
    for threads in (1, 2, 4):
        run = tmp_path / f"{threads}.run"
        more = ("-o", run, "-t", threads, "--checkpoint-every", every)
        assert cramp("run", path, *more, *words).returncode == 0
        assert differences(whole, run) == []


def test_1_a_changed_deck_is_refused_by_the_name_of_the_key(here):
    run_in_pieces(here / "plate.yaml", here / "plate.run")
    told = r"solver.cfl: 0.5 in the run, 0.3 now"
    for resume in ("auto", "must"):
        with pytest.raises(FolderError, match=told):
            run_in_pieces(here / "plate.yaml", here / "plate.run", overrides=["solver.cfl=0.3"])
        done = cramp("run", "plate.yaml", "--resume", resume, "-s", "grid.cell=1 mm")
        assert done.returncode == 4
        assert "grid.cell: 0.002 in the run, 0.001 now" in done.stderr
    comment = (here / "plate.yaml").read_text() + "# nothing new\n"
    (here / "plate.yaml").write_text(comment)
    assert cramp("run", "plate.yaml", "--resume", "must").returncode == 0


def test_1_a_finished_run_goes_on_to_a_later_end(here):
    """As if that had been its end from the start: rows of the first end are cut off again."""
    every = ("-s", "output.every=3 us", "-s", "output.history_every=1 us")
    assert cramp("run", "plate.yaml", "-o", "whole.run", *every).returncode == 0
    assert cramp("run", "plate.yaml", "--end-time", "11 us", *every).returncode == 0
    assert cramp("resume", "plate.run", "--end-time", "20 us").returncode == 0
    assert differences(here / "whole.run", here / "plate.run") == []
    again = cramp("resume", "plate.run")
    assert (again.returncode, "is done already" in again.stderr) == (0, True)
    back = cramp("resume", "plate.run", "--end-time", "5 us")
    assert (back.returncode, "is done already" in back.stderr) == (0, True)


def test_1_a_stopped_run_does_not_go_back(here):
    every = ("--checkpoint-every", STEPS)
    assert cramp("run", "plate.yaml", *every).returncode == 0
    record = manifest(here / "plate.run") | {"status": "stopped"}
    (here / "plate.run/manifest.json").write_text(json.dumps(record))
    back = cramp("resume", "plate.run", "--end-time", "5 us")
    assert back.returncode == 4
    assert "behind the end asked for" in back.stderr


def test_1_a_deck_changed_in_the_folder_is_refused(here):
    run = run_in_pieces(here / "plate.yaml", here / "plate.run")
    record = manifest(run) | {"status": "stopped"}
    (run / "manifest.json").write_text(json.dumps(record))
    resolved = (run / "resolved.yaml").read_text()
    (run / "resolved.yaml").write_text(resolved.replace("cfl: 0.5", "cfl: 0.4"))
    done = cramp("resume", run)
    assert done.returncode == 4
    assert "is not the deck of the checkpoints" in done.stderr


# ------------------------------------------------------------------ 2 stopped or killed


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGUSR1, signal.SIGINT])
def test_2_a_signal_stops_a_run_with_a_checkpoint(here, number):
    with begin("run", "plate.yaml", *LONG) as run:
        wait_for(here / "plate.run/cracks.xdmf", run)
        run.send_signal(number)
        _, told = run.communicate(timeout=300)
    assert run.returncode == 75
    assert "go on with: cramp resume plate.run" in told
    assert (manifest(here / "plate.run")["status"], len(checkpoints(here / "plate.run"))) == (
        "stopped",
        1,
    )
    assert len(list(read_frames(here / "plate.run/particles.xdmf"))) >= 1


@pytest.fixture
def ctrl_c():
    """Ctrl-C as on a terminal, whatever the tests run under."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("ctrl_c")
def test_2_a_second_ctrl_c_ends_at_once(tmp_path):
    with Signs(tmp_path) as signs:
        assert signs() == ""
        signal.raise_signal(signal.SIGINT)
        assert signs() == "Ctrl-C"
        with pytest.raises(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)


@pytest.mark.usefixtures("ctrl_c")
def test_2_what_a_shell_ignores_stays_ignored(tmp_path):
    """A shell without job control starts commands in the background deaf to Ctrl-C."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    with Signs(tmp_path) as signs:
        signal.raise_signal(signal.SIGINT)
        assert signs() == ""


def test_2_signals_are_given_back(tmp_path):
    before = signal.getsignal(signal.SIGTERM)
    with Signs(tmp_path):
        assert signal.getsignal(signal.SIGTERM) != before
    assert signal.getsignal(signal.SIGTERM) == before


def test_2_a_file_stop_and_the_wall_limit_stop_a_run(here):
    with begin("run", "plate.yaml", *LONG) as run:
        wait_for(here / "plate.run/cracks.xdmf", run)
        (here / "plate.run/STOP").touch()
        _, told = run.communicate(timeout=300)
    assert run.returncode == 75
    assert "stopped by the file plate.run/STOP" in told
    done = cramp("resume", "plate.run", "--max-wall", "1s")
    assert done.returncode == 75
    assert "stopped by --max-wall" in done.stderr
    assert not (here / "plate.run/STOP").exists()


def test_2_a_killed_run_goes_on_to_the_same_end(here):
    words = ("run", "plate.yaml", "-s", "solver.end_time=40 us", "--checkpoint-every", "50")
    with begin(*words) as run:
        wait_for(here / "plate.run/checkpoints/step_000000000100.h5", run)
        run.kill()
    assert run.returncode == -9
    assert cramp("resume", "plate.run", "--checkpoint-every", "50").returncode == 0
    assert cramp(*words, "-o", "whole.run").returncode == 0
    assert differences(here / "whole.run", here / "plate.run") == []


def test_2_a_damaged_checkpoint_is_passed_over_and_the_log_says_so(here):
    stops = (30, 60)
    whole = run_in_pieces(here / "plate.yaml", here / "whole")
    run = here / "pieces"
    run_in_pieces(here / "plate.yaml", run, stops, checkpoint_every=(30, None))
    newest, older = checkpoints(run)
    newest.write_bytes(newest.read_bytes()[:-9])
    record = manifest(run) | {"status": "stopped"}
    (run / "manifest.json").write_text(json.dumps(record))
    assert cramp("resume", run, "--checkpoint-every", STEPS).returncode == 0
    log = (run / "run.log").read_text()
    assert f"{newest}: is damaged (its checksum is wrong); an older one is tried" in log
    assert f"goes on from the checkpoint of step {int(older.stem[5:])}" in log
    assert differences(whole, run) == []


def test_2_a_damaged_file_of_frames_does_not_end_a_run(here):
    """The numbers of the tables do not depend on it."""
    whole = run_in_pieces(here / "plate.yaml", here / "whole")
    run_in_pieces(here / "plate.yaml", here / "r", (60,), checkpoint_every=(9999, None))
    max((here / "r/checkpoints").iterdir()).unlink()  # that of the end: frames are still to come
    (here / "r/particles.h5").write_bytes(b"no HDF5")
    (here / "r/manifest.json").write_text(json.dumps(manifest(here / "r") | {"status": "stopped"}))
    done = cramp("resume", "r")
    assert done.returncode == 0
    assert "its frames are lost, later ones go into a new file" in done.stderr
    assert (here / "r/history.csv").read_bytes() == (whole / "history.csv").read_bytes()
    assert (here / "r/particles.damaged").read_bytes() == b"no HDF5"
    assert len(list(read_frames(here / "r/particles.xdmf"))) >= 1


def test_2_resume_needs_something_to_go_on_from(here):
    assert cramp("run", "plate.yaml", "--resume", "must").returncode == 4
    assert not (here / "plate.run").exists()
    assert cramp("run", "plate.yaml", "--resume", "auto").returncode == 0
    again = cramp("run", "plate.yaml", "--resume", "auto")
    assert (again.returncode, again.stdout) == (0, "plate.run\n")
    assert "is done already" in again.stderr


# ------------------------------------------------------------------ 3 a solution that is none


@pytest.mark.parametrize(
    ("poison", "said"),
    [
        (lambda p: p.F.__setitem__((7, 0), -1.0), "7 of glass .* is turned inside out"),
        (lambda p: p.stress.__setitem__((7, 1), np.nan), "has a (state|position) that is no num"),
        (lambda p: p.velocity.__setitem__((7, 1), np.inf), "has a (state|position) that is no num"),
    ],
)
def test_3_an_ill_particle_ends_the_run_with_a_dump(here, monkeypatch, poison, said):
    """Within fifty steps; and no checkpoint ever holds it."""

    def step(model, state, scratch, watch):
        real_step(model, state, scratch, watch)
        if state.step == 41:
            poison(state.particles)

    real_step = simulation.step
    monkeypatch.setattr(simulation, "step", step)
    with pytest.raises(NumericalFailure) as caught:
        run_in_pieces(here / "plate.yaml", here / "r", checkpoint_every=(7, None))
    text = str(caught.value)
    assert 41 <= int(re.search(r"step (\d+)", text)[1]) <= 91
    for part in (said, r"particle \d+ of glass at \(", r"at first at \(", r"time step \(lower"):
        assert re.search(part, text), text
    assert manifest(here / "r")["exit_code"] == 6
    assert "failure" in caught.value.__notes__[0]
    (dump,) = (here / "r/failure").glob("step_*.h5")
    _, fresh = build(read_deck(here / "plate.yaml"))
    ill = read_state(dump, fresh).state.particles
    (frame,) = read_frames(here / "r/failure/particles.xdmf")
    assert {*FIELDS} <= set(frame.fields)
    finite = np.isfinite(ill.velocity).all() and np.isfinite(ill.stress).all()
    assert not finite or ill.F[7, 0] < 0.0
    for path in checkpoints(here / "r"):
        assert read_state(path, fresh).state.step <= 41


def test_3_a_particle_that_leaves_the_grid_ends_the_run(here):
    thrown = ("-s", "bodies.0.velocity=[0, 2 km/s]", "-s", "solver.energy_error.stop=10")
    done = cramp("run", "plate.yaml", *thrown, "--progress", "none")
    assert done.returncode == 6
    assert re.search(r"step \d+, .* particle \d+ of glass at .* leaves the grid", done.stderr)
    assert len(list((here / "plate.run/failure").glob("step_*.h5"))) == 1


@pytest.mark.parametrize("leaving", ["delete", "clamp"])
def test_3_a_particle_that_leaves_the_grid_may_be_lost_but_not_in_silence(here, leaving):
    """The plate is thrown at the border; the run ends, the log has names, and pieces are equal."""
    settings = ["bodies.0.velocity=[0, 2 km/s]", f"solver.leaving={leaving}"]
    options = {"overrides": [*settings, "solver.energy_error.stop=10", "output.every=2 us"]}
    whole = run_in_pieces(here / "plate.yaml", here / "whole", **options)
    pieces = run_in_pieces(here / "plate.yaml", here / "pieces", (60, 90), **options)
    assert differences(whole, pieces) == []
    said = re.findall(r"step \d+, .* particle (\d+) of glass at .* has left", log_of(whole))
    left = [len(frame.points) for frame in read_frames(whole / "particles.h5")]
    assert len(said) == MOST_REMARKS < left[0] - left[-1] or leaving == "clamp"


def log_of(run):
    return (run / "run.log").read_text(encoding="utf-8")


def test_3_time_steps_without_end_are_a_mistake_of_the_deck(here):
    """A step so small that time would not move."""
    for command in ("run", "check"):
        done = cramp(command, "plate.yaml", "-s", "solver.dt=1e-25")
        assert done.returncode == 3
        assert "solver.dt: needs 2e+20 time steps" in done.stderr


# ------------------------------------------------------------------ 4 energy


def test_4_the_energy_books_of_every_row_close(here):
    """The columns say what energy_error says; the limits are tested in test_failures.py."""
    assert cramp("run", "plate.yaml").returncode == 0
    with (here / "plate.run/history.csv").open() as file:
        rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]
    kinds = ("kinetic", "strain", "fracture", "friction", "plastic", "damping", "cohesive")
    largest = 0.0
    for row in rows:
        held = sum(row[f"{kind}_energy"] for kind in kinds)
        stored = row["kinetic_energy"] + row["strain_energy"]
        largest = max(largest, stored, abs(row["external_work"]), held - stored)
        error = (held - row["external_work"]) / largest if largest else 0.0
        assert row["energy_error"] == pytest.approx(error, abs=1e-12)
    assert abs(rows[-1]["energy_error"]) < 0.01


# ------------------------------------------------------------------ 5 memory and disk


def test_5_a_million_million_particles_are_refused_before_anything_is_loaded(here):
    """Within a second and 300 MB on a free machine; here it is the cause that is tested."""
    program = (
        "import sys; from cramp_cli.__main__ import main;"
        "code = main(['run', 'plate.yaml', '-s', 'grid.cell=80 nm']);"
        "size = open('/proc/self/status').read().split('VmHWM:')[1].split()[0];"
        "print(code, 'numba' in sys.modules, 'h5py' in sys.modules, int(size) < 300000)"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.stdout == "5 False False True\n", done.stderr
    assert re.search(r"needs about \d+ TB of memory \(\d{15} bytes\), .* has free", done.stderr)
    assert not (here / "plate.run").exists()


def test_5_a_disk_that_fills_up_leaves_a_run_that_goes_on(here):
    """A limit on the size of files stands for the disk; it fails in the same calls."""
    often = "output.every=0.5 us"
    whole = run_in_pieces(here / "plate.yaml", here / "whole", overrides=[often])

    def limit():
        resource.setrlimit(resource.RLIMIT_FSIZE, (2_000_000, 2_000_000))

    words = ("run", "plate.yaml", "--checkpoint-every", "40", "-o", "full")
    done = cramp(*words, "-s", often, preexec_fn=limit)
    assert done.returncode == 5, done.stderr
    assert "File too large" in done.stderr
    assert "Traceback" not in done.stderr
    assert len(checkpoints(here / "full")) >= 1
    assert cramp("resume", "full", "--checkpoint-every", STEPS).returncode == 0
    assert differences(whole, here / "full") == []


# ------------------------------------------------------------------ 6 decks of all kinds


@pytest.mark.parametrize("deck", DECKS, ids=lambda deck: deck.stem)
def test_6_decks_that_nobody_would_write_end_with_a_known_code(cramp_here, deck):
    """A few of them; test_soak.py has fifteen hundred."""
    text = deck.read_text(encoding="utf-8")
    for seed in range(12):
        for data in (mutated(text, seed), generated(text, seed)):
            code, told = cramp_here(data)
            assert code in (0, 3, 4, 5), told
            assert "Traceback" not in told


# ------------------------------------------------------------------ 7 any surroundings


@pytest.mark.parametrize("home", [None, "/nowhere"])
def test_7_a_run_needs_no_home_and_no_folder_of_its_own(here, home, tmp_path_factory):
    away = tmp_path_factory.mktemp("away")
    keys = ("HOME", "XDG_CACHE_HOME", "CRAMP_CACHE_DIR")
    settings = {key: value for key, value in os.environ.items() if key not in keys}
    settings |= {"LC_ALL": "de_DE.UTF-8"} | ({"HOME": home} if home else {})
    words = [sys.executable, "-m", "cramp_cli", "check", str(here / "plate.yaml")]
    done = subprocess.run(words, capture_output=True, text=True, env=settings, cwd=away)
    assert (done.returncode, done.stderr) == (0, "")
    assert list(away.iterdir()) == []


def test_7_two_runs_in_one_folder_and_resume(here):
    """The second is refused, whatever it wants, and the first is not disturbed."""
    with begin("run", "plate.yaml", *LONG) as first:
        wait_for(here / "plate.run/cracks.xdmf", first)
        for words in (("resume", "plate.run"), ("run", "plate.yaml", "--resume", "auto")):
            second = cramp(*words)
            assert second.returncode == 4
            assert f"in use by process {first.pid} on" in second.stderr
        first.send_signal(signal.SIGTERM)
        first.communicate(timeout=300)
    assert first.returncode == 75


# ------------------------------------------------------------------ 8 no stale kernels


def test_8_a_kernel_is_kept_under_a_hash_of_all_it_is_made_of(monkeypatch):
    """Edit any module: the kernels that could have changed compile anew, and no others."""
    sources = kernel_cache.read_sources()
    before = kernel_cache.hashes_of(sources)

    def touched(module, old, new):
        assert old in sources[module], module
        after = kernel_cache.hashes_of(sources | {module: sources[module].replace(old, new, 1)})
        return {name.removeprefix("cramp_cli.") for name in before if before[name] != after[name]}

    comment = touched("cramp_cli.cracks.rows", '"""', '"""Again: ')
    assert {"cracks.rows", "cracks.assign", "cracks.followers", "step"} <= comment
    assert not comment & {"transfer.to_grid", "cracks.crossing", "materials.elastic"}
    body = touched("cramp_cli.shapes.ugimp", '"""', '"""Again: ')  # chosen by type, not imported
    assert {"shapes.shape", "transfer.to_grid", "transfer.to_particles"} <= body
    assert "cracks.rows" not in body
    aside = touched("cramp_cli.output.run", '"""', '"""Again: ')
    assert not {name for name in aside if "kernel\ndef " in sources[f"cramp_cli.{name}"]}
    field = touched("cramp_cli.cracks.followers", "    count: np", "    counts: np")
    assert field == {name.removeprefix("cramp_cli.") for name in before}  # handed to any of them

    folder = kernel_cache.kernel_folder(kernel_cache.PACKAGE / "cracks/rows.py")
    assert folder.name == f"cramp_cli.cracks.rows-{before['cramp_cli.cracks.rows']}"
    monkeypatch.setenv("NUMBA_BOUNDSCHECK", "1")
    assert kernel_cache.kernel_folder(kernel_cache.PACKAGE / "cracks/rows.py") != folder


def test_8_numba_keeps_kernels_where_we_say():
    path = Path(double_area.compiled._cache.cache_path)
    assert path == kernel_cache.kernel_folder(kernel_cache.PACKAGE / "cracks/crossing.py")
