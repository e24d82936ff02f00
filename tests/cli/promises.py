"""What the tests of promises share: a small deck, runs of it in pieces, and what must be equal."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import h5py
import numpy as np
import pytest

from cramp_cli.commands import RunOptions, run_deck
from cramp_cli.output.checkpoint import checkpoints
from cramp_cli.output.exits import Stopped
from cramp_cli.output.stop import Signs

STEPS = 112  # of the plate, in 20 us
DATED = {"manifest.json", "status.json", "run.log", ".lock"}  # these name times and hosts
PATIENCE = 400.0  # s; kernels may have to be compiled, on a busy machine


def run_in_pieces(deck, folder, stops=(), **options):
    """Run a deck and stop after each step of `stops`; go on after each stop, until it is done."""
    options = {"progress": "none", "verbosity": 0, "checkpoint_every": (STEPS, None)} | options
    for stop in (*stops, None):
        seen = iter(range(sys.maxsize))
        begins = stops[stops.index(stop) - 1] + 1 if stop in stops[1:] else 0

        def asked(signs, stop=stop, begins=begins, seen=seen):
            return "test" if stop is not None and begins + next(seen) >= stop else ""

        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(Signs, "__call__", asked)
            try:
                run_deck(deck, RunOptions(output=folder, resume="auto", **options))
            except Stopped:
                assert stop is not None
    return folder


def differences(one: Path, other: Path) -> list[str]:
    """Return the files of two runs that are not the same; those with the date and host aside."""
    files = [{path.name for path in run.glob("*.*")} - DATED for run in (one, other)]
    found = sorted(files[0] ^ files[1])
    for name in files[0] & files[1]:
        if name.endswith(".h5"):
            found += [f"{name}:{place}" for place in unequal_data(one / name, other / name)]
        elif (one / name).read_bytes() != (other / name).read_bytes():
            found.append(name)
    states = [{path.name for path in checkpoints(run)} for run in (one, other)]
    name = max(states[0] & states[1])  # there has to be one, or the runs tell nothing of states
    pair = (run / "checkpoints" / name for run in (one, other))
    return found + [f"state:{place}" for place in unequal_data(*pair, "state")]


def unequal_data(one: Path, other: Path, group: str = "/") -> list[str]:
    """Return the places in two HDF5 files that are not the same to the bit."""
    with h5py.File(one, "r") as a, h5py.File(other, "r") as b:
        left, right = _contents(a[group]), _contents(b[group])
    names = {*left, *right}
    return sorted(name for name in names if left.get(name) != right.get(name))


def _contents(group) -> dict:
    found = {}

    def keep(name, item):
        found[name] = repr(sorted((k, repr(v)) for k, v in item.attrs.items()))
        if isinstance(item, h5py.Dataset):
            values = np.asarray(item[()])
            found[name] += f"{values.dtype}{values.shape}" + values.tobytes().hex()

    group.visititems(keep)
    keep(".", group)
    return found


def cramp(*words, **settings) -> subprocess.CompletedProcess:
    """Obey a command line in a process of its own."""
    line = [sys.executable, "-m", "cramp_cli", "-q", *map(str, words)]
    environment = {**os.environ, **settings.pop("environment", {})}
    return subprocess.run(
        line, capture_output=True, text=True, timeout=PATIENCE, env=environment, **settings
    )


def begin(*words) -> subprocess.Popen:
    """Start a command line in a process of its own."""
    line = [sys.executable, "-m", "cramp_cli", "-q", *map(str, words)]
    return subprocess.Popen(
        line, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, preexec_fn=_hear_ctrl_c
    )


def _hear_ctrl_c() -> None:
    """Undo what a shell does to commands in the background, in case the tests run there."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def wait_for(path: Path, process: subprocess.Popen) -> None:
    """Wait until a process has made a file, or has ended."""
    deadline = time.monotonic() + PATIENCE
    while not path.exists() and process.poll() is None:
        assert time.monotonic() < deadline
        time.sleep(0.02)
