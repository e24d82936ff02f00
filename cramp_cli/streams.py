"""Standard streams that are closed, full or of another alphabet must not end a command."""

import contextlib
import os
import sys


def mend_streams() -> None:
    """Make stdout and stderr usable, whatever the shell gave.

    A closed stream would leave its number to the next file that is opened: a result file could then
    receive stray messages. So the numbers 0, 1 and 2 are taken first.
    """
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115 - for good
        elif hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="replace")


def mute_stdout() -> None:
    """Forget what stdout still holds: nobody reads it any more."""
    with contextlib.suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
