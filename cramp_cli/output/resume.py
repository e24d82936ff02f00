"""Where a run begins: at its start, or at the newest sound checkpoint of the same deck."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

from cramp_cli.numerics.cache import source_hash
from cramp_cli.output.checkpoint import sound_checkpoints
from cramp_cli.output.exits import FolderError
from cramp_cli.output.folder import run_status
from cramp_cli.output.manifest import sha256

NEVER, AUTO, MUST = "never", "auto", "must"
MOST_SHOWN = 3
ANOTHER_PROGRAM = (
    "the program has changed since that checkpoint was written: what follows may differ from an "
    "uninterrupted run"
)


class Start(NamedTuple):
    """What a run begins with."""

    state: Any
    places: dict | None = None  # of the files, see RunOutputs
    remembered: dict | None = None  # by the loop over time
    remarks: tuple = ()  # (level, text) for the log


def is_finished(folder: Path, text: str) -> bool:
    """Tell whether a folder holds a run of this resolved deck that came to its end."""
    if run_status(folder) != "done":
        return False
    refuse_changed(folder, text)
    return True


def find_start(folder: Path, mode: str, text: str, state: Any) -> Start:
    """Return the state to begin with.

    mode: never, auto (go on if there is something to go on from) or must
    text: the resolved deck; state: that of the deck at time zero
    raises: FolderError when the deck was changed, or nothing is there and mode is must
    """
    if mode == NEVER:
        return Start(state)
    remarks = []
    if run_status(folder) is not None and (folder / "resolved.yaml").exists():
        refuse_changed(folder, text)
        for checkpoint, wrong in sound_checkpoints(folder, state):
            if checkpoint is not None:
                return _start(folder, checkpoint, text, remarks)
            remarks.append(("warning", f"{wrong}; an older one is tried"))
    if mode == MUST:
        tried = "".join(f"; {text}" for _, text in remarks)
        raise FolderError(f"{folder}: no checkpoint to go on from{tried}")
    return Start(state, remarks=(*remarks, ("info", "no checkpoint: begins at time zero")))


def refuse_changed(folder: Path, text: str) -> None:
    """Raise FolderError if a run's folder holds another resolved deck than `text`."""
    before = (folder / "resolved.yaml").read_text(encoding="utf-8")
    if before != text:
        raise _changed(folder, before, text)


def _start(folder: Path, checkpoint, text: str, remarks: list) -> Start:
    notes = checkpoint.notes
    if notes["deck_sha256"] != sha256(text):
        raise FolderError(f"{folder}/resolved.yaml: is not the deck of the checkpoints")
    state = checkpoint.state
    where = f"goes on from the checkpoint of step {state.step}, t = {state.time:.6g} s"
    remarks = [*remarks, ("info", where)]
    if notes["source_hash"] != source_hash():
        remarks.append(("warning", ANOTHER_PROGRAM))
    return Start(state, notes["files"], notes["loop"], tuple(remarks))


def _changed(folder: Path, before: str, now: str) -> FolderError:
    import yaml

    old, new = (dict(_leaves(yaml.safe_load(text))) for text in (before, now))
    keys = [key for key in {**old, **new} if old.get(key) != new.get(key)]
    shown = [f"{k}: {old.get(k, 'nothing')} in the run, {new.get(k, 'nothing')} now" for k in keys]
    more = [f"and {len(keys) - MOST_SHOWN} more"] if len(keys) > MOST_SHOWN else []
    return FolderError(
        f"{folder}: the deck has changed ({'; '.join(shown[:MOST_SHOWN] + more)}); go on with the "
        "deck as it was, or begin anew with --overwrite or in another folder"
    )


def _leaves(data: Any, path: str = "") -> Iterator[tuple[str, Any]]:
    """Yield all values of a deck with their paths of keys."""
    if not isinstance(data, dict | list):
        yield path, data
        return
    items = data.items() if isinstance(data, dict) else enumerate(data)
    for key, value in items:
        yield from _leaves(value, f"{path}.{key}".strip("."))
