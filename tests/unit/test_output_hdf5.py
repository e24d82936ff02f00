"""A disk that is full is an OSError, and the file is as it was."""

import errno
import os

import numpy as np
import pytest

from cramp_cli.output.checkpoint import write_state
from cramp_cli.output.fields import FrameWriter, read_frames
from cramp_cli.output.hdf5 import extended, opened

NUMBERS = np.random.default_rng(1).random(30000)


@pytest.fixture
def disk(monkeypatch):
    """A file system of so many bytes, or one that can not claim space."""

    def limit(size, number=errno.ENOSPC):
        def claim(handle, offset, length):
            if offset + length > size:
                raise OSError(number, os.strerror(number))

        monkeypatch.setattr(os, "posix_fallocate", claim)

    return limit


def add(path, name):
    with extended(path, "a", NUMBERS.nbytes, 1) as file:
        file[name] = NUMBERS


def test_a_file_that_finds_no_room_is_as_it_was(tmp_path, disk):
    path = tmp_path / "a.h5"
    add(path, "one")
    before = path.read_bytes()
    disk(len(before) + 1000)
    with pytest.raises(OSError, match="No space left") as caught:
        add(path, "two")
    assert caught.value.filename == str(path)
    assert path.read_bytes() == before


def test_a_new_file_that_finds_no_room_is_not_made(tmp_path, disk):
    disk(1000)
    with pytest.raises(OSError, match="No space left"):
        add(tmp_path / "a.h5", "one")
    with pytest.raises(OSError, match="No space left"):
        write_state(tmp_path / "b.h5", {"numbers": NUMBERS}, {})
    assert list(tmp_path.iterdir()) == []


def test_space_that_was_not_needed_is_given_back(tmp_path):
    path = tmp_path / "a.h5"
    with extended(path, "w", 10**7, 1) as file:
        file["one"] = NUMBERS
    assert NUMBERS.nbytes < path.stat().st_size < 1.1 * NUMBERS.nbytes
    add(path, "two")
    assert path.stat().st_size < 2.1 * NUMBERS.nbytes
    with opened(path) as file:
        assert (file["two"][()] == NUMBERS).all()


def test_a_file_system_that_can_not_claim_is_written_to_all_the_same(tmp_path, disk):
    disk(0, errno.EOPNOTSUPP)
    add(tmp_path / "a.h5", "one")
    with opened(tmp_path / "a.h5") as file:
        assert (file["one"][()] == NUMBERS).all()


@pytest.mark.parametrize("count", [1, 100, 3000])
def test_a_frame_never_needs_more_than_was_claimed(tmp_path, monkeypatch, count):
    """Numbers that no compression makes smaller."""
    claimed, claim = [], os.posix_fallocate

    def note(handle, offset, length):
        claimed.append(offset + length)
        claim(handle, offset, length)

    monkeypatch.setattr(os, "posix_fallocate", note)
    writer = FrameWriter(tmp_path, "particles", "f8")
    values = np.random.default_rng(2).integers(0, 2**62, (count, 10)).view(float)
    for step in range(30):
        fields = {f"field {n}": values[:, n] for n in range(10)}
        writer.write(step, 1.0 * step, values[:, :2], fields)
        assert writer.data.stat().st_size <= claimed[-1]
    assert len(list(read_frames(writer.data))) == 30
