"""Checkpoints: the whole state of a run, in a file that is either whole or not there.

Each file is HDF5 behind a block of 512 bytes (a user block, which HDF5 programs skip) that holds
the SHA-256 of the rest. A new one is written beside the old, forced to the disk and renamed; the
two newest stay, so that one is good even if the disk spoils the other.
"""

import hashlib
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

from cramp_cli.output.atomic import replaced, sweep
from cramp_cli.output.exits import FolderError
from cramp_cli.output.hdf5 import extended, opened
from cramp_cli.output.packing import pack, size_of, unpack

FOLDER = "checkpoints"
KEPT = 2
HEAD = 512  # bytes, the smallest user block of HDF5
MARK = b"cramp checkpoint 1\nsha256 "
PIECE = 1 << 20  # bytes read at a time


class Damaged(FolderError):
    """A checkpoint is not what was written."""


class Checkpoint(NamedTuple):
    """A state, and what is not part of it but needed to go on."""

    state: Any  # cramp_cli.state.model.State
    notes: dict  # plain numbers and texts: places in files, what the loop over time remembers


def write_checkpoint(run: Path, state: Any, notes: dict) -> Path:
    """Add a checkpoint to a run's folder, remove those that are too old; return its path."""
    folder = run / FOLDER
    folder.mkdir(exist_ok=True)
    sweep(folder)
    path = folder / f"step_{state.step:012d}.h5"
    write_state(path, state, notes)
    for old in checkpoints(run)[KEPT:]:
        old.unlink(missing_ok=True)
    return path


def write_state(path: Path, state: Any, notes: dict) -> None:
    """Write a state and notes to a file with a checksum, whole or not at all."""
    text = json.dumps(notes, default=lambda number: number.tolist())
    size, parts = size_of(state)
    with replaced(path, durable=True) as beside:
        with extended(beside, "w", size + len(text), parts + 2, userblock_size=HEAD) as file:
            pack(file.create_group("state"), state)
            file["notes"] = text
        head = MARK + _digest(beside).encode() + b"\n"
        with beside.open("r+b") as file:
            file.write(head.ljust(HEAD, b"\0"))


def read_state(path: Path, like: Any) -> Checkpoint:
    """Return what `write_state` has written.

    like: a state of the same model, which gives the types
    raises: Damaged when the file is not as it was written, PackingError when another version of the
    program wrote it
    """
    _refuse_damaged(path)
    with opened(path) as file:
        notes = json.loads(file["notes"][()])
        return Checkpoint(unpack(file["state"], like), notes)


def checkpoints(run: Path) -> list[Path]:
    """Return the checkpoints of a run, the newest first."""
    return sorted((run / FOLDER).glob("step_*.h5"), reverse=True)


def sound_checkpoints(run: Path, like: Any) -> Iterator[tuple[Checkpoint | None, str]]:
    """Yield the checkpoints of a run from the newest on: (it, "") or (None, what is wrong)."""
    for path in checkpoints(run):
        try:
            yield read_state(path, like), ""
        except (Damaged, OSError) as error:
            yield None, str(error)
        except FolderError as error:
            raise FolderError(f"{path}: {error}; another version of cramp wrote it") from None


def _refuse_damaged(path: Path) -> None:
    with path.open("rb") as file:
        head = file.read(HEAD)
    if not head.startswith(MARK):
        raise Damaged(f"{path}: is no checkpoint")
    if head[len(MARK) :].split(b"\n")[0] != _digest(path).encode():
        raise Damaged(f"{path}: is damaged (its checksum is wrong)")


def _digest(path: Path) -> str:
    """Return the SHA-256 of a file behind its head."""
    digest = hashlib.sha256()
    with path.open("rb") as file:
        file.seek(HEAD)
        while piece := file.read(PIECE):
            digest.update(piece)
    return digest.hexdigest()
