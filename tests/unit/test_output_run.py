"""All files of a run, from its start to a good, a bad and an early end."""

import hashlib
import json

import numpy as np
import pytest

from cramp_cli.output.fields import read_frames
from cramp_cli.output.folder import RunFolder
from cramp_cli.output.look import describe, facts, last_tips
from cramp_cli.output.run import RunOutputs
from cramp_cli.output.summary import Summary
from cramp_cli.state.failure import NumericalFailure

DECK = "title: Balken mit Riß\n"
TIP = {"crack": "mid", "tip": "start", "x": 0.05, "y": 0.0, "J": 336.0, "K_I": 5.8e5, "K_II": 0.0}


def outputs_in(path, **more):
    return RunOutputs(RunFolder(path), DECK, DECK, end_time=2.0, threads=2, **more)


def load(path):
    return json.loads(path.read_text(encoding="utf-8"))


def write_some(outputs):
    outputs.history({"step": 5, "time": 1.0, "energy_error": 1e-4, "reaction_grip_x": 2.5})
    outputs.tips([{"step": 5, "time": 1.0, **TIP, "status": "ok"}])
    outputs.growth([{"step": 5, "time": 1.0, "crack": "mid", "tip": "start", "kind": "growth"}])
    outputs.particle_frame(5, 1.0, np.zeros((4, 2)), {"mass": np.ones(4)})
    outputs.crack_frame(5, 1.0, [np.zeros((2, 2)), np.ones((3, 2))], {"opening": np.zeros(5)})


def test_a_good_end(tmp_path):
    with outputs_in(tmp_path / "run") as outputs:
        write_some(outputs)
        outputs.finish(Summary(9, 2.0, 0.5, [TIP], np.float64(1e-4), float("inf")))
    manifest, status = load(tmp_path / "run/manifest.json"), load(tmp_path / "run/status.json")
    assert (manifest["status"], manifest["exit_code"], manifest["threads"]) == ("done", 0, 2)
    assert manifest["deck_sha256"] == hashlib.sha256(DECK.encode()).hexdigest()
    assert manifest["summary"]["energy_error"] == 1e-4
    assert manifest["summary"]["particle_steps_per_second"] is None  # JSON has no infinity
    assert manifest["end"] >= manifest["start"]
    assert manifest["versions"]["numpy"] == np.__version__
    assert (status["status"], status["step"], status["eta"]) == ("done", 9, 0.0)
    assert status["tips"][0]["K_I"] == 5.8e5


def test_every_file_is_there_and_no_other(tmp_path):
    with outputs_in(tmp_path / "run") as outputs:
        write_some(outputs)
    names = {path.name for path in (tmp_path / "run").iterdir()}
    assert names == {
        *("input.yaml", "resolved.yaml", "manifest.json", "status.json", "columns.json"),
        *("history.csv", "cracks.csv", "growth.csv", "run.log", ".lock"),
        *("particles.h5", "particles.xdmf", "cracks.h5", "cracks.xdmf"),
    }
    frame = next(read_frames(tmp_path / "run/cracks.xdmf"))
    np.testing.assert_array_equal(frame.offsets, [0, 2, 5])
    np.testing.assert_array_equal(frame.fields["crack"], [0, 1])
    assert load(tmp_path / "run/columns.json")["history.csv"]["reaction_grip_x"]["unit"] == "N"


@pytest.mark.parametrize(
    ("error", "status", "code"),
    [
        (NumericalFailure("step 7: NaN in particle 12"), "failed", 6),
        (KeyboardInterrupt(), "interrupted", 130),
        (ZeroDivisionError("a fault"), "failed", 70),
    ],
)
def test_an_early_end_is_recorded(tmp_path, error, status, code):
    outputs = outputs_in(tmp_path / "run")
    write_some(outputs)
    with pytest.raises(type(error)) as caught, outputs:
        raise error
    manifest = load(tmp_path / "run/manifest.json")
    assert (manifest["status"], manifest["exit_code"]) == (status, code)
    assert load(tmp_path / "run/status.json")["status"] == status
    log = (tmp_path / "run/run.log").read_text()
    assert ("Traceback" in log) == (code == 70)
    assert "run.log" in caught.value.__notes__[0]


def test_a_running_simulation_can_be_looked_at(tmp_path):
    outputs = outputs_in(tmp_path / "run")
    write_some(outputs)
    found = describe(tmp_path / "run")
    assert found["frames"] == {"particles": 1, "cracks": 1}
    assert facts(found)["status"] == "running"
    assert last_tips(tmp_path / "run")[0]["K_I"] == 5.8e5


def test_the_last_row_of_every_tip_counts(tmp_path):
    with outputs_in(tmp_path / "run") as outputs:
        for step in range(3):
            both = [{**TIP, "step": step, "J": step}, {**TIP, "step": step, "tip": "end"}]
            outputs.tips(both)
    tips = last_tips(tmp_path / "run")
    assert [(tip["tip"], tip["step"]) for tip in tips] == [("start", 2.0), ("end", 2.0)]
    assert tips[0]["J"] == 2.0
