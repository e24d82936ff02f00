"""A zone that opens, grows and debonds: the same bytes in pieces and with any number of threads."""

import csv
import hashlib

import numpy as np
import pytest
from promises import differences, run_in_pieces
from support import advance_growing, build_deck

from cramp_cli.numerics import team
from cramp_cli.output.checkpoint import checkpoints
from cramp_cli.output.hdf5 import opened
from cramp_cli.scratch import make_scratch

STRIP = """
cramp: 1
analysis: plane_strain
grid: {cell: 1, lower: [-3, -3], upper: [27, 14]}
materials: {m: {law: elastic, density: 1, E: 1, nu: 0.3, toughness: {K_Ic: 1}}}
bodies: [{name: b, material: m, shape: {type: rectangle, lower: [0, 0], upper: [24, 10]}}]
cracks:
  - name: c
    points: [[0, 5.2], [10, 5.2]]
    start: edge
    traction: {law: triangular, normal: {peak: 0.003, opening: 0.03}, power: 2}
    traction_along: [4, 10]
boundary:
  - {name: foot, where: {y: 0}, fix: [x, y]}
  - {name: head, where: {y: 10}, velocity: {x: 5.0e-4, y: 2.0e-3}}
propagation:
  criterion: steady_state
  begin: 20
  speed: {law: prescribed, value: 0.05}
  traction: {law: exponential, normal: {peak: 0.004, toughness: 4.0e-5}}
solver: {end_time: 86}
fracture: {every: 10}
output: {every: 20, history_every: 2}
"""
STEPS = 200


def rows(run, table):
    with (run / f"{table}.csv").open() as file:
        return list(csv.DictReader(file))


def test_a_run_in_pieces_is_the_same_to_the_byte(tmp_path):
    deck = tmp_path / "strip.yaml"
    deck.write_text(STRIP, encoding="utf-8")
    options = {"checkpoint_every": (STEPS, None)}
    whole = run_in_pieces(deck, tmp_path / "whole", **options)
    events = rows(whole, "growth")
    parted = [int(row["step"]) for row in events if row["kind"] == "debond"]
    assert len(parted) >= 3
    assert any(row["kind"] == "growth" for row in events)
    pieces = run_in_pieces(deck, tmp_path / "pieces", (60, parted[1]), **options)
    assert differences(whole, pieces) == []
    with opened(checkpoints(whole)[0]) as file:
        damage = file["state/paths/damage"][()]
    assert np.sum(damage == 1.0) == len(parted)
    assert np.any((damage > 0.0) & (damage < 1.0))


def test_columns_and_frames_tell_of_the_zone(tmp_path):
    deck = tmp_path / "strip.yaml"
    deck.write_text(STRIP, encoding="utf-8")
    run = run_in_pieces(deck, tmp_path / "run", checkpoint_every=(STEPS, None))
    history, events = rows(run, "history"), rows(run, "growth")
    spent = [float(row["cohesive_energy"]) for row in history]
    assert np.all(np.diff(spent) >= 0.0)
    assert spent[-1] > 0.0
    told = [row for row in events if row["kind"] == "debond"]
    for row in told:  # one law or the other; modes that are mixed take up to sqrt(2) times more
        assert 4.0e-5 <= float(row["J"]) * (1.0 + 1e-6) <= 4.5e-5 * 2.0**0.5
        assert 0.5 < float(row["mode_I"]) <= 1.0
    assert sum(float(row["energy"]) for row in told) <= spent[-1]
    for row in rows(run, "cracks")[1:]:
        parts = float(row["J_tip"]) + float(row["J_zone"])
        assert float(row["J"]) == pytest.approx(parts, rel=1e-12)
    with opened(run / "cracks.h5") as file:
        names = []
        file.visit(names.append)
    assert any(name.endswith("damage") for name in names)
    assert any(name.endswith("traction") for name in names)


def test_threads_do_not_change_a_bit(monkeypatch):
    monkeypatch.setattr(team, "LEAST", 1)
    found = set()
    for threads in (1, 2, 4):
        model, state, _ = build_deck(STRIP)
        scratch = make_scratch(model, state, threads)
        advance_growing(model, state, scratch, STEPS)
        digest = hashlib.sha256()
        for array in (*state.particles, *state.paths, *state.books):
            digest.update(np.ascontiguousarray(array).tobytes())
        found.add(digest.hexdigest())
    assert state.paths.damage.max() == 1.0
    assert len(found) == 1
