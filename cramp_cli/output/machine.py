"""What this computer offers: threads, memory, disk; and whether a run fits into it."""

import os
import re
import shutil
import sys
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from cramp_cli.output.exits import OutOfResources

THREAD_VARIABLES = ("CRAMP_NUM_THREADS", "SLURM_CPUS_PER_TASK", "OMP_NUM_THREADS")
LIBRARIES = ("numpy", "numba", "h5py", "meshio", "pydantic", "pyyaml", "scipy", "shapely", "pint")
FACTORS = {"": 1, "K": 1000, "M": 1000**2, "G": 1000**3, "T": 1000**4, "P": 1000**5}
LEAST_MEMORY = 1_000_000_000  # bytes: libraries take 0.4e9, compiling kernels as much again
CGROUP = Path("/sys/fs/cgroup")


def versions() -> dict[str, str]:
    """Return the versions of cramp, Python and the libraries that make numbers or files."""
    from cramp_cli import __version__

    found = {"cramp": __version__, "python": sys.version.split()[0]}
    for name in LIBRARIES:
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            found[name] = "missing"
    return found


def choose_threads(asked: int | None = None) -> int:
    """Return the number of threads of a run and tell numba, which must not be imported yet."""
    count = asked or next(filter(None, map(_from_environment, THREAD_VARIABLES)), usable_cpus())
    if "numba" not in sys.modules:
        os.environ["NUMBA_NUM_THREADS"] = str(count)
    return count


def usable_cpus() -> int:
    """Return how many processors this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def available_memory() -> int | None:
    """Return the bytes this process can still take, or None where nobody tells."""
    sizes = (_memory_of_system(), _memory_of_group(), memory_of_limit())
    return min((size for size in sizes if size is not None), default=None)


def available_disk(path: Path) -> int:
    """Return the bytes free where a folder is, or will be."""
    path = Path(path).absolute()
    while not path.exists():
        path = path.parent
    return shutil.disk_usage(path).free


def parse_bytes(text: str) -> int:
    """Return the bytes of "8 GB", "512 MiB" or "2e9"."""
    found = re.fullmatch(r"\s*([0-9.]+(?:e[0-9]+)?)\s*([KMGTP]?)(i?)B?\s*", text, re.IGNORECASE)
    try:
        number = float(found[1]) if found else -1.0
    except ValueError:
        number = -1.0
    if number <= 0 or found is None:
        raise ValueError(f"'{text}' is no size; write it like '8 GB' or '500 MB'")
    factor = FACTORS[found[2].upper()]
    return int(number * (1024 ** list(FACTORS.values()).index(factor) if found[3] else factor))


def parse_duration(text: str) -> float:
    """Return the seconds of "3h50m", "90s" or "1d"."""
    found = re.fullmatch(r"\s*(?:(\d+)d)?(?:(\d+)h)?(?:(\d+)m)?(?:(\d+)s)?\s*", text)
    parts = [int(part or 0) for part in found.groups()] if found else [0]
    if not any(parts):
        raise ValueError(f"'{text}' is no duration; write it like '3h50m' or '90s'")
    return float(sum(n * s for n, s in zip(parts, (86400, 3600, 60, 1), strict=True)))


def parse_interval(text: str) -> tuple[int | None, float | None]:
    """Return steps or seconds of "500" or "10m", None for the other."""
    if text.strip().isdecimal() and int(text) > 0:
        return int(text), None
    try:
        return None, parse_duration(text)
    except ValueError:
        message = f"'{text}' is no interval; write it like '10m' of time or '500' steps"
        raise ValueError(message) from None


def human_bytes(size: float) -> str:
    """Return a size as people say it."""
    for unit in ("B", "kB", "MB", "GB", "TB"):
        if size < 1000:
            return f"{size:.3g} {unit}"
        size /= 1000
    return f"{size:.4g} PB"


def refuse_too_big(
    needs: dict, folder: Path, max_memory: int | None = None, max_disk: int | None = None
) -> None:
    """Raise before anything is allocated if a run does not fit.

    needs: estimate with memory_bytes and disk_bytes
    max_memory, max_disk: what the user allows, instead of what the computer has free (bytes)
    """
    memory = max_memory if max_memory is not None else available_memory()
    disk = max_disk if max_disk is not None else available_disk(folder)
    _refuse("memory", needs.get("memory_bytes"), memory, max_memory is not None)
    _refuse("disk", needs.get("disk_bytes"), disk, max_disk is not None)


def _refuse(what: str, needed: float | None, limit: int | None, by_user: bool) -> None:
    if needed is None or limit is None or needed <= limit:
        return
    whose = f"--max-{what} allows" if by_user else "this computer has free"
    raise OutOfResources(
        f"this run needs about {human_bytes(needed)} of {what} ({needed:.0f} bytes), "
        f"{whose} {human_bytes(limit)} ({limit} bytes)"
    )


def _from_environment(name: str) -> int | None:
    text = os.environ.get(name, "").split(",")[0].strip()
    return int(text) if text.isascii() and text.isdigit() and int(text) > 0 else None


def _memory_of_system() -> int | None:
    try:
        text = Path("/proc/meminfo").read_text(encoding="ascii")
    except OSError:
        return None
    found = re.search(r"^MemAvailable:\s*(\d+) kB", text, re.MULTILINE)
    return int(found[1]) * 1024 if found else None


def memory_of_limit() -> int | None:
    """Return what `ulimit -v` leaves to this process, None without such a limit."""
    try:
        import resource

        limit = resource.getrlimit(resource.RLIMIT_AS)[0]
        pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
    except (ImportError, OSError):
        return None
    return None if limit == resource.RLIM_INFINITY else limit - pages * resource.getpagesize()


def refuse_little_memory() -> None:
    """Raise OutOfResources where libraries could not even be loaded.

    Some of them end the process, with a code of their own, when they get no memory.
    """
    left = memory_of_limit()
    if left is not None and left < LEAST_MEMORY:
        least = human_bytes(LEAST_MEMORY)
        text = f"the memory limit (ulimit -v) leaves {human_bytes(max(left, 0))}"
        raise OutOfResources(f"{text}; the libraries alone need about {least}")


def _memory_of_group() -> int | None:
    """Return what a container or batch job leaves to this process."""
    try:
        limit = (CGROUP / "memory.max").read_text(encoding="ascii").strip()
        used = (CGROUP / "memory.current").read_text(encoding="ascii").strip()
    except OSError:
        return None
    return int(limit) - int(used) if limit.isdigit() and used.isdigit() else None
