"""Writes checkpoints when they are due, and ends a run that is asked to stop."""

from collections.abc import Callable
from time import monotonic
from typing import Any

from cramp_cli.numerics.cache import source_hash
from cramp_cli.output.checkpoint import write_checkpoint
from cramp_cli.output.exits import Stopped
from cramp_cli.output.manifest import sha256
from cramp_cli.output.resume import identity
from cramp_cli.output.stop import Signs


class Keeper:
    """Looks after each step whether a checkpoint is due.

    outputs: the files of the run, which must reach the disk before a checkpoint that counts on them
    signs: whether the run shall stop
    every: steps or seconds from one checkpoint to the next, None for the one that is not given
    deck_text: the resolved deck, which a run that goes on must have too
    """

    def __init__(self, outputs: Any, signs: Signs, every: tuple, deck_text: str) -> None:
        self._outputs, self._signs, self._every = outputs, signs, every
        self._identity = {"deck_sha256": sha256(identity(deck_text)), "source_hash": source_hash()}
        self._written = monotonic()

    def after_step(self, state: Any, remembered: Callable[[], dict]) -> None:
        """Write a checkpoint if one is due; raise Stopped if the run shall end.

        remembered: gives what the loop over time must know to go on; called only if needed
        """
        why = self._signs()
        if why or self._due(state.step):
            self._write(state, remembered())
        if why:
            where = f"step {state.step}, t = {state.time:.6g} s"
            raise Stopped(
                f"stopped by {why} at {where}; go on with: cramp resume {self._outputs.path}"
            )

    def at_end(self, state: Any, remembered: dict) -> None:
        """Write the checkpoint from which a finished run goes on when its end is put off."""
        self._write(state, remembered)

    def _due(self, step: int) -> bool:
        steps, seconds = self._every
        if steps is not None:
            return step > 0 and step % steps == 0
        return seconds is not None and monotonic() - self._written >= seconds

    def _write(self, state: Any, remembered: dict) -> None:
        files = self._outputs.places(state.step, state.time)
        notes = self._identity | {"loop": remembered, "files": files}
        path = write_checkpoint(self._outputs.path, state, notes)
        self._written = monotonic()
        self._outputs.log.write("debug", f"step {state.step}: checkpoint {path.name}")
