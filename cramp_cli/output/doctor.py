"""What `cramp doctor` looks at: is this installation fit to run?"""

import os
from pathlib import Path

from cramp_cli.numerics.cache import cache_root
from cramp_cli.numerics.kernel_cache import kernel_folders
from cramp_cli.output.machine import (
    available_disk,
    available_memory,
    choose_threads,
    human_bytes,
    usable_cpus,
    versions,
)


def examine() -> tuple[dict[str, object], list[str]]:
    """Return facts about the installation, and what is wrong with it."""
    folder, memory = cache_root(), available_memory()
    found = versions()
    faults = [f"{name} is not installed" for name, text in found.items() if text == "missing"]
    if not writable(folder):
        faults.append(f"kernels cannot be cached in {folder}; set CRAMP_CACHE_DIR")
    facts = {
        **found,
        "processors": usable_cpus(),
        "threads": choose_threads(),
        "memory free": "unknown" if memory is None else human_bytes(memory),
        "disk free here": human_bytes(available_disk(Path.cwd())),
        "cache": folder,
        "cached": f"{sum(len(list(f.glob('*.nbc'))) for f in kernel_folders())} kernels",
    }
    return facts, faults


def writable(folder: Path) -> bool:
    """Tell whether files can be made in a folder that need not exist yet."""
    while not folder.exists():
        folder = folder.parent
    return folder.is_dir() and os.access(folder, os.W_OK | os.X_OK)
