"""The promises of docs/reliability.md, each test by the number of its promise.

What takes longer is in test_soak.py.
"""

import json
import signal

import pytest
from plate import PLATE
from promises import STEPS, begin, cramp, differences, run_in_pieces, wait_for
from runs import INPUTS
from support import build_deck, read

from cramp_cli.build.model import time_step
from cramp_cli.deck.deck import read_deck
from cramp_cli.output.checkpoint import checkpoints
from cramp_cli.output.exits import FolderError
from cramp_cli.output.fields import read_frames
from cramp_cli.output.stop import Signs
from cramp_cli.simulation import DUES, Books, _Run

DECKS = sorted(path for path in INPUTS.glob("*.yaml") if not path.name.endswith(".expect.yaml"))
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


@pytest.mark.parametrize("update", ["fmpm(2)", "xpic(2)"])
def test_1_every_update_can_be_run_in_pieces(here, update):
    options = {"overrides": [f"solver.update={update}"]}
    whole = run_in_pieces(here / "plate.yaml", here / "whole", **options)
    pieces = run_in_pieces(here / "plate.yaml", here / "pieces", (50,), **options)
    assert differences(whole, pieces) == []


def test_1_all_that_the_loop_over_time_holds_is_kept_or_follows_from_the_state():
    """A new attribute of the loop belongs into `remember`, or into the list here."""
    model, state, _ = build_deck(PLATE)
    run = _Run(read(PLATE), model, state, None, None, None)
    follows = {"deck", "model", "state", "outputs", "reporter", "keeper", "scratch", "watch"}
    follows |= {"begun_at"}
    kept = set(run.remember())
    assert set(vars(run)) - follows - {*DUES} == kept - {"due"}
    assert set(vars(run.books)) - {"limits", "update"} == {*Books.REMEMBERED}
    assert set(vars(run.history_due)) == {"every", "slack", "count"}


def test_1_the_number_of_threads_does_not_matter(here):
    for threads in (1, 2, 4):
        words = ("-t", threads, "--checkpoint-every", STEPS)
        assert cramp("run", "plate.yaml", "-o", f"{threads}.run", *words).returncode == 0
    assert differences(here / "1.run", here / "2.run") == []
    assert differences(here / "1.run", here / "4.run") == []


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


def test_2_a_second_ctrl_c_ends_at_once(tmp_path):
    with Signs(tmp_path) as signs:
        assert signs() == ""
        signal.raise_signal(signal.SIGINT)
        assert signs() == "Ctrl-C"
        with pytest.raises(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)


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
    words = ("run", "plate.yaml", "-s", "solver.end_time=80 us", "--checkpoint-every", "50")
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


def test_2_resume_needs_something_to_go_on_from(here):
    assert cramp("run", "plate.yaml", "--resume", "must").returncode == 4
    assert not (here / "plate.run").exists()
    assert cramp("run", "plate.yaml", "--resume", "auto").returncode == 0
    again = cramp("run", "plate.yaml", "--resume", "auto")
    assert (again.returncode, again.stdout) == (0, "plate.run\n")
    assert "is done already" in again.stderr
