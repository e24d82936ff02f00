"""How a run ends: the one table from exceptions to exit codes.

The table goes by the names of classes, so that a program that ends early imports nothing for it.
"""

import errno

DONE, DIFFERENT, USAGE, DECK, FILES, RESOURCES, NUMERICS, INTERNAL = 0, 1, 2, 3, 4, 5, 6, 70
STOPPED, INTERRUPTED = 75, 130

CODE_OF = {
    "ClickException": USAGE,
    "DeckError": DECK,
    "FolderError": FILES,
    "OutOfResources": RESOURCES,
    "MemoryError": RESOURCES,
    "NumericalFailure": NUMERICS,
    "FloatingPointError": NUMERICS,
    "Stopped": STOPPED,
    "KeyboardInterrupt": INTERRUPTED,
    "OSError": FILES,
}
FULL_DISK = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.ENOMEM}


class FolderError(Exception):
    """A folder or file of results is missing, unreadable, in use or in the way."""


class OutOfResources(Exception):
    """A run would need more memory or disk than allowed or available."""


class Stopped(Exception):
    """A run was asked to end early; a checkpoint holds all of it."""


def exit_code(error: BaseException) -> int:
    """Return the exit code that tells a script what went wrong."""
    if isinstance(error, OSError) and error.errno in FULL_DISK:
        return RESOURCES
    names = (kind.__name__ for kind in type(error).__mro__)
    return next((CODE_OF[name] for name in names if name in CODE_OF), INTERNAL)


def one_line(error: BaseException) -> str:
    """Return what is said on the screen about an error."""
    code, text = exit_code(error), str(error).strip()
    if code == INTERRUPTED:
        return "interrupted"
    if isinstance(error, OSError) and error.strerror:
        place = f"{error.filename}: " if error.filename else ""
        return f"{place}{error.strerror}"
    if code == INTERNAL:
        return f"internal error: {type(error).__name__}: {' '.join(text.split())}"
    return text or type(error).__name__
