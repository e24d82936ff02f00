"""Where a run begins: at its start, or at the newest sound checkpoint of the same deck."""

import re
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
END = re.compile(r"(^solver:.*?\bend_time:) *([^,}\s]+)", re.MULTILINE | re.DOTALL)
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
    """Tell whether a folder holds a run of this resolved deck that came to its end.

    A finished run whose end is put off goes on from there; raises FolderError for another change.
    """
    if run_status(folder) != "done":
        return False
    before = refuse_changed(folder, text)
    return end_of(text) <= end_of(before)


def identity(text: str) -> str:
    """Return a resolved deck without its end time, which changes nothing of what comes before."""
    return END.sub(r"\1", text)


def end_of(text: str) -> float:
    """Return the end time (s) of a resolved deck."""
    return float(END.search(text)[2])


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
        sooner = end_of(text) < end_of(refuse_changed(folder, text))
        for checkpoint, wrong in sound_checkpoints(folder, state):
            if checkpoint is not None:
                if sooner:
                    _refuse_passed(folder, checkpoint.state.time, end_of(text))
                return _start(folder, checkpoint, text, remarks)
            remarks.append(("warning", f"{wrong}; an older one is tried"))
    if mode == MUST:
        tried = "".join(f"; {text}" for _, text in remarks)
        raise FolderError(f"{folder}: no checkpoint to go on from{tried}")
    return Start(state, remarks=(*remarks, ("info", "no checkpoint: begins at time zero")))


def refuse_changed(folder: Path, text: str) -> str:
    """Return the resolved deck of a run's folder; raise FolderError if it is another than `text`.

    The end time may be another one.
    """
    before = (folder / "resolved.yaml").read_text(encoding="utf-8")
    if identity(before) != identity(text):
        raise _changed(folder, before, text)
    return before


def _refuse_passed(folder: Path, time: float, end: float) -> None:
    if time > end:
        raise FolderError(f"{folder}: is at t = {time:.6g} s already, behind the end asked for")


def _start(folder: Path, checkpoint, text: str, remarks: list) -> Start:
    notes = checkpoint.notes
    if notes["deck_sha256"] != sha256(identity(text)):
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
