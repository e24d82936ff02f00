"""Checkpoints: all of a state, bit for bit, whole or not at all."""

import dataclasses
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from support import advance, build_deck

from cramp_cli.output import checkpoint as checkpoints
from cramp_cli.output.checkpoint import (
    KEPT,
    Damaged,
    read_state,
    sound_checkpoints,
    write_checkpoint,
    write_state,
)
from cramp_cli.output.exits import FolderError
from cramp_cli.output.packing import PackingError, parts_of
from cramp_cli.state.model import State

CRACKED = """
cramp: 1
analysis: plane_strain
grid: {cell: 1}
materials: {m: {law: elastic, density: 1, E: 3, nu: 0.2}}
bodies: [{name: block, material: m, shape: {type: rectangle, lower: [0, 0], upper: [8, 6]}}]
cracks: [{name: c, points: [[0, 3.1], [4.2, 3.1]], start: edge}]
boundary: [{name: foot, where: {y: 0}, fix: [x, y]}]
loads: [{type: force, body: block, where: {y: 6}, total: [0, 1.0e-3]}]
solver: {end_time: 1}
"""


@pytest.fixture(scope="module")
def cracked():
    """A state in which every array of a cracked body has moved, and one at time zero."""
    model, state, scratch = build_deck(CRACKED)
    advance(model, state, scratch, 3)
    return state, build_deck(CRACKED)[1]


def leaves(record, path=""):
    parts = parts_of(record)
    if parts is None:
        yield path, record
        return
    for name, value in parts.items():
        yield from leaves(value, f"{path}.{name}")


def same_bits(one, other):
    if isinstance(one, np.ndarray):
        assert (one.dtype, one.shape) == (other.dtype, other.shape)
        assert one.flags.c_contiguous == other.flags.c_contiguous  # or kernels compile anew
        return one.tobytes() == other.tobytes()
    return type(one) is type(other) and repr(one) == repr(other)


def test_all_of_a_state_comes_back_bit_for_bit(tmp_path, cracked):
    state, fresh = cracked
    state.particles.velocity[0] = np.nan, -0.0
    notes = {"x": 0.1, "nothing": float("nan"), "many": list(range(99999))}
    write_state(tmp_path / "a.h5", state, notes)
    back = read_state(tmp_path / "a.h5", fresh)
    assert type(back.state) is State
    found, kept = dict(leaves(back.state)), dict(leaves(state))
    assert list(found) == list(kept)
    assert len(kept) > 25
    assert [name for name in kept if not same_bits(kept[name], found[name])] == []
    assert repr(back.notes) == repr(notes)


class Sub(NamedTuple):
    values: np.ndarray
    name: str
    none: object


@dataclasses.dataclass
class Whole:
    sub: Sub
    pair: tuple
    table: dict
    flag: bool


def test_any_record_of_records_can_be_kept(tmp_path):
    """The state may get fields that nobody thought of when this was written."""
    record = Whole(Sub(np.arange(3), "ü", None), (1, np.ones((2, 2))), {"a": 0.1}, flag=True)
    record.step = 0
    like = Whole(Sub(np.zeros(0, np.int64), "", None), (), {}, flag=False)
    write_state(tmp_path / "a.h5", record, {})
    back = read_state(tmp_path / "a.h5", like).state
    assert back.sub.values.tolist() == [0, 1, 2]
    assert (back.sub.name, back.sub.none, back.table, back.flag) == ("ü", None, {"a": 0.1}, True)
    assert back.pair[0] == 1
    assert back.pair[1].tolist() == [[1, 1], [1, 1]]


def test_what_can_not_be_kept_is_named(tmp_path):
    with pytest.raises(TypeError, match=r"sub\.none: a object can not be kept"):
        write_state(tmp_path / "a.h5", Whole(Sub(np.ones(1), "", object()), (), {}, True), {})
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("like", "said"),
    [
        (Whole(Sub(np.zeros((1, 2)), "", None), (), {}, True), "in place of float64 of shape"),
        (Whole(Sub(np.zeros(1, int), "", None), (), {}, True), "in place of int64"),
        (Whole({"values": 1}, (), {}, True), ""),
    ],
)
def test_a_checkpoint_of_another_version_is_refused(tmp_path, like, said):
    whole = Whole(Sub(np.ones(1), "", None), (), {}, True)
    write_state(tmp_path / "a.h5", whole, {})
    if said:
        with pytest.raises(PackingError, match=said):
            read_state(tmp_path / "a.h5", like)
    with pytest.raises(PackingError, match=r"lacks field \w+"):
        read_state(tmp_path / "a.h5", build_deck(CRACKED)[1])


def test_the_newest_two_stay(tmp_path, cracked):
    state, _ = cracked
    for step in (5, 10, 1000000000000, 7):
        write_checkpoint(tmp_path, dataclasses.replace(state, step=step), {})
    kept = [path.name for path in checkpoints.checkpoints(tmp_path)]
    assert kept == ["step_1000000000000.h5", "step_000000000010.h5"]
    assert len(kept) == KEPT


@pytest.mark.parametrize("spoil", ["bit", "tail", "head", "empty"])
def test_a_damaged_checkpoint_is_passed_over(tmp_path, cracked, spoil):
    state, fresh = cracked
    for step in (5, 10):
        newest = write_checkpoint(tmp_path, dataclasses.replace(state, step=step), {})
    data = bytearray(newest.read_bytes())
    data[{"bit": len(data) // 2, "head": 40}.get(spoil, 0)] ^= spoil in ("bit", "head")
    newest.write_bytes({"tail": data[:-1], "empty": b""}.get(spoil, data))
    with pytest.raises(Damaged):
        read_state(newest, fresh)
    (none, wrong), (found, well) = sound_checkpoints(tmp_path, fresh)
    assert (none, well, found.state.step) == (None, "", 5)
    assert newest.name in wrong


def test_a_write_that_fails_leaves_the_older_ones(tmp_path, cracked, monkeypatch):
    state, fresh = cracked
    write_checkpoint(tmp_path, dataclasses.replace(state, step=5), {})

    def full(path):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(checkpoints, "_digest", full)
    with pytest.raises(OSError, match="No space left"):
        write_checkpoint(tmp_path, dataclasses.replace(state, step=6), {})
    monkeypatch.undo()
    assert [c.state.step for c, _ in sound_checkpoints(tmp_path, fresh)] == [5]
    assert len(list((tmp_path / "checkpoints").iterdir())) == 1


def test_what_a_killed_process_left_goes_with_the_next_checkpoint(tmp_path, cracked):
    folder = tmp_path / "checkpoints"
    folder.mkdir()
    (folder / ".step_000000000004.h5.123.tmp").write_bytes(b"half")
    path = write_checkpoint(tmp_path, cracked[0], {})
    assert [p.name for p in Path(folder).iterdir()] == [path.name]


def test_a_checkpoint_of_another_version_is_named(tmp_path, cracked):
    path = write_checkpoint(tmp_path, cracked[0], {})
    strange = Whole(cracked[1].books, (), {}, True)
    with pytest.raises(FolderError, match=f"{path.name}: .*another version of cramp"):
        list(sound_checkpoints(tmp_path, strange))
