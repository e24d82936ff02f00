"""Growing cracks in plates small enough for seconds: how far, and what they meet."""

import numpy as np
import pytest
from support import advance, advance_growing, build_deck

from cramp_cli.cracks import grow as grow_module
from cramp_cli.cracks.tips import sample_tips
from cramp_cli.state.failure import NumericalFailure
from cramp_cli.state.paths import EDGE, PLAIN, TIP

pytestmark = pytest.mark.verification

PLATE = """
cramp: 1
analysis: plane_strain
grid: {cell: 1, lower: [-4, -4], upper: [24, 14]}
materials: {m: {law: elastic, density: 1, E: 1, nu: 0.25, toughness: {G_Ic: 1.0e-6}}}
bodies: [{name: b, material: m, shape: {type: rectangle, lower: [0, 0], upper: [20, 10]}}]
cracks: [{name: flat, points: [[0, 5.2], [6, 5.2]], start: edge}]
solver: {end_time: 100}
propagation:
  criterion: steady_state
  begin: 0
  speed: {law: prescribed, value: 0.25}
"""


def run(steps, **overrides):
    """Take steps with growth; return model, state and all events."""
    model, state, scratch = build_deck(PLATE, **overrides)
    events = advance_growing(model, state, scratch, steps)
    return model, state, events


def test_a_prescribed_speed_is_kept():
    model, state, events = run(40)
    assert state.growth.length[1] == pytest.approx(40 * model.dt * 0.25, rel=1e-12)
    assert state.paths.origin[-1] == pytest.approx([6 + 10 * model.dt, 5.2], abs=1e-12)
    assert {row["kind"] for row in events} == {"growth"}
    assert state.particles.velocity.max() == 0.0  # a body at rest stays at rest


def test_pieces_are_half_a_cell():
    _, state, events = run(40)
    added = np.diff(state.paths.origin[12:, 0])
    assert len(added) == len(events)
    assert added[:-1].min() >= 0.5
    assert added[:-1].max() < 0.7


def test_a_crack_ends_at_a_free_surface():
    _, state, events = run(180)
    assert state.paths.ends.tolist() == [[EDGE, EDGE]]
    assert [row["kind"] for row in events[-2:]] == ["growth", "edge"]
    assert 20.0 < events[-1]["x"] < 20.8
    assert state.growth.speed[1] == 0.0


@pytest.mark.parametrize(
    ("steps", "status"),
    [(60, "doubtful: a running tip acts 2.5 cells behind"), (100, "shrunk: a domain of ")],
)
def test_a_tip_says_that_its_domain_is_small(steps, status):
    """Within five cells of the edge at x = 20: some J of the tractions may be left out."""
    model, state, scratch = build_deck(PLATE)
    advance_growing(model, state, scratch, steps)
    (row,) = sample_tips(model, state, scratch)
    assert (row["x"] > 16.0) == status.startswith("shrunk")
    assert row["status"].startswith(status)


def test_a_sharp_tip_that_runs_is_doubtful():
    model, state, scratch = build_deck(PLATE, solver={"tips": "sharp"})
    advance_growing(model, state, scratch, 20)
    assert "sharp tip leaves" in sample_tips(model, state, scratch)[0]["status"]


def test_no_tractions_after_the_end():
    _, state, _ = run(180)
    assert state.growth.running.tolist() == [0, 0]


def test_a_crack_ends_on_another():
    other = {"name": "wall", "points": [[12.3, 2], [12.3, 8]], "start": "plain", "end": "plain"}
    flat = {"name": "flat", "points": [[0, 5.2], [6, 5.2]], "start": "edge"}
    _, state, events = run(100, cracks=[flat, other])
    assert events[-1]["kind"] == "merge"
    assert (events[-1]["x"], events[-1]["y"]) == pytest.approx((12.3, 5.2), abs=1e-9)
    assert state.paths.ends[0].tolist() == [EDGE, PLAIN]
    at = state.paths.point[state.paths.joint == 0]
    assert len(at) == 2  # the end of one, a new point of the other
    assert (at == at[0]).all()
    assert state.paths.start[-1] - state.paths.start[1] == 14


def test_a_crack_goes_past_one_that_is_not_in_its_way():
    other = {"name": "wall", "points": [[12.3, 6.2], [12.3, 9]], "start": "plain", "end": "plain"}
    flat = {"name": "flat", "points": [[0, 5.2], [6, 5.2]], "start": "edge"}
    _, state, _ = run(100, cracks=[flat, other])
    assert state.paths.ends[0, 1] == TIP
    assert state.paths.origin[state.paths.start[1] - 1, 0] > 13.0


@pytest.mark.parametrize("offset", [0.0, 0.1, 0.45])
def test_two_tips_that_come_to_meet_each_other_become_one_crack(offset):
    left = {"name": "left", "points": [[0, 5.2], [6, 5.2]], "start": "edge"}
    right = {"name": "right", "points": [[20, 5.2 + offset], [14, 5.2 + offset]], "start": "edge"}
    _, state, events = run(90, cracks=[left, right])
    assert [row["kind"] for row in events[-2:]] == ["merge", "merge"]
    assert state.paths.ends.tolist() == [[EDGE, PLAIN], [EDGE, PLAIN]]
    ends = state.paths.point[[state.paths.start[1] - 1, state.paths.start[2] - 1]]
    assert (ends[0] == ends[1]).all()
    assert (state.paths.joint == 0).sum() == 2
    assert 9.0 < ends[0, 0] < 11.0


def test_a_tip_that_nobody_can_measure_does_not_run_for_ever():
    """Along another crack, one cell beside it: no domain fits, the last load is that of before."""
    wall = {"name": "wall", "points": [[8, 6.3], [19, 6.3]], "start": "plain", "end": "plain"}
    flat = {"name": "flat", "points": [[0, 5.2], [3, 5.2]], "start": "edge"}
    rule = {"speed": {"law": "prescribed", "value": 0.25}}
    _, state, events = run(200, cracks=[flat, wall], propagation=rule)
    assert events[-1]["kind"] == "arrest"
    assert 6.0 < state.growth.unseen[1] < 7.0


def test_no_crack_grows_beyond_its_longest():
    _, state, events = run(100, propagation={"max_length": 8})
    assert 2.0 <= state.growth.length[1] < 2.0 + 0.25 * 0.6
    assert events[-1]["kind"] == "arrest"


def test_a_given_direction():
    _, state, events = run(60, propagation={"direction": "given", "toward": [1, -1]})
    way = state.paths.origin[-1] - [6, 5.2]
    assert way[0] == pytest.approx(-way[1], rel=1e-9)
    assert events[-1]["angle"] == pytest.approx(-np.pi / 4)


def test_the_border_of_the_grid():
    with pytest.raises(NumericalFailure, match="Make the grid larger"):
        run(120, bodies=[big()], grid={"lower": [-4, -4], "upper": [16, 14]})


def big():
    return {
        "name": "b",
        "material": "m",
        "shape": {"type": "rectangle", "lower": [0, 0], "upper": [15, 10]},
    }


def pulled_twice():
    """Tension on both long faces: on, off from 15 s, on again from 70 s."""
    in_time = {"type": "table", "time": [0, 1, 14, 15, 70, 71], "value": [0, 1, 1, 0, 0, 1]}
    faces = ((0, -1e-3), (10, 1e-3))
    return [
        {"type": "traction", "body": "b", "where": {"y": y}, "traction": [0, s], "in_time": in_time}
        for y, s in faces
    ]


def test_arrest_and_restart():
    rule = {"criterion": "critical_J", "begin": None}
    _, state, events = run(
        200,
        loads=pulled_twice(),
        propagation=rule,
        solver={"damping": {"grid": 0.5}},
    )
    kinds = [row["kind"] for row in events]
    arrest = kinds.index("arrest")
    assert kinds[0] == "growth"
    assert "growth" in kinds[arrest:]
    assert state.growth.running[1] == 1


@pytest.mark.parametrize(("J", "runs"), [(2.0e-6, True), (-2.0e-6, False)])
@pytest.mark.parametrize("law", ["{law: prescribed, value: 0.25}", "{law: toughness}"])
def test_a_tip_into_which_no_energy_flows_does_not_run(monkeypatch, law, J, runs):
    """Near an edge or a contact J may be negative beside a K_II above the toughness."""
    plate, _, _ = PLATE.partition("propagation:")
    text = f"{plate}propagation: {{criterion: max_hoop_stress, speed: {law}}}"
    model, state, scratch = build_deck(text)
    advance(model, state, scratch, 1)
    seen = grow_module.load_on
    monkeypatch.setattr(
        grow_module, "load_on", lambda *args: seen(*args)._replace(J=J, K_I=0.0, K_II=0.01)
    )
    grow_module.grow(model, state, scratch)
    assert (state.growth.speed[1] > 0.0) == runs
    assert (state.books.fracture[0] > 0.0) == runs
