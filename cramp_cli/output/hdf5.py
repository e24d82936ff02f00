"""HDF5 files on disks that may be full.

The library does not bear a write that fails: it prints, leaves the file half changed and may end
the whole program by a segmentation fault. So the space is claimed from the file system first; where
it is not to be had, OSError comes before anything was written.
"""

import errno
import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

OF_A_DATASET = 16384  # bytes that a data set, a group or its index may take besides its values
NO_SPACE = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG}


def opened(path: Path, mode: str = "r", **options):
    """Open a file without a lock of its own: whoever looks at it must not stop the run."""
    import h5py  # late: keeps `cramp --help` fast

    return h5py.File(path, mode, locking=False, **options)


@contextmanager
def extended(path: Path, mode: str, values: int, parts: int, **options) -> Iterator:
    """Open a file to write (mode w) or to add to it (mode a), with the space for it claimed.

    values, parts: bytes and number of the data sets and groups that will be added
    raises: OSError when the disk does not have the space
    """
    needed = values + OF_A_DATASET * (parts + 1)
    if mode == "w" or not path.exists():
        _claim_new(path, needed)
        mode = "w"
    with opened(path, mode, **options) as file:
        _claim(path, needed)
        yield file
        file.flush()
        size = file.id.get_filesize()
    if os.path.getsize(path) > size:
        os.truncate(path, size)


def _claim_new(path: Path, needed: int) -> None:
    """Find out whether there is room for a new file; the library itself makes it empty again."""
    try:
        path.touch()
        _claim(path, needed)
    except OSError:
        with suppress(OSError):
            path.unlink()
        raise


def _claim(path: Path, needed: int) -> None:
    """Claim space behind the end of a file."""
    handle = os.open(path, os.O_RDWR)
    try:
        if hasattr(os, "posix_fallocate"):
            os.posix_fallocate(handle, os.fstat(handle).st_size, needed)
    except OSError as error:
        if error.errno in NO_SPACE:  # any other: a file system that can not claim
            raise OSError(error.errno, os.strerror(error.errno), str(path)) from None
    finally:
        os.close(handle)
