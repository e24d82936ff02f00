"""The ways to end a run early and lose nothing: signals, a limit of time, a file named STOP.

A batch system sends SIGTERM or SIGUSR1 some time before it kills; both only leave a word here, and
the run stops when the step is done.
"""

import os
import signal
from contextlib import suppress
from pathlib import Path
from time import monotonic

STOP = "STOP"
POLITE = (signal.SIGTERM, signal.SIGUSR1, signal.SIGINT)
TOLD = b"\ncramp: stopping after this step, with a checkpoint; Ctrl-C again ends at once\n"


class Signs:
    """Says whether a run has been asked to stop; listens to signals while used with ``with``.

    folder: where a file STOP counts
    max_wall: seconds from now on after which to stop; a change of the date does not matter
    """

    def __init__(self, folder: Path, max_wall: float | None = None) -> None:
        self._file = os.path.join(folder, STOP)
        self._end = None if max_wall is None else monotonic() + max_wall
        self._signal = ""
        self._before: dict = {}

    def __enter__(self) -> "Signs":
        heard = [n for n in POLITE if signal.getsignal(n) != signal.SIG_IGN]  # or a shell's `&`
        with suppress(ValueError):  # not in the main thread: then signals are none of our business
            self._before = {number: signal.signal(number, self._note) for number in heard}
        return self

    def __exit__(self, *error: object) -> None:
        for number, handler in self._before.items():
            signal.signal(number, handler)

    def __call__(self) -> str:
        """Return why to stop, or an empty text."""
        if self._signal:
            return self._signal
        if self._end is not None and monotonic() >= self._end:
            return "--max-wall"
        return f"the file {self._file}" if os.path.exists(self._file) else ""

    def _note(self, number: int, frame: object) -> None:
        if number == signal.SIGINT:
            if self._signal == "Ctrl-C":
                raise KeyboardInterrupt
            with suppress(OSError):
                os.write(2, TOLD)  # print is not safe inside a signal
        self._signal = "Ctrl-C" if number == signal.SIGINT else signal.Signals(number).name
