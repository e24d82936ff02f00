"""Decks and a stand-in for the solver, for tests of what surrounds it."""

import sys
from types import ModuleType, SimpleNamespace

import numpy as np
import pytest
from plate import PLATE

from cramp_cli.__main__ import main
from cramp_cli.deck.size import Size
from cramp_cli.output.summary import Summary

TIP = {"crack": "notch", "tip": "end", "x": 0.0153, "y": 0.0, "J": 1.5, "K_I": 3e5, "K_II": 0.0}
TIP["status"] = "ok"


@pytest.fixture
def here(tmp_path, monkeypatch):
    """A working folder that holds plate.yaml."""
    (tmp_path / "plate.yaml").write_text(PLATE, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def cramp(here, capsys):
    """Obey a command line: exit code, stdout, stderr."""

    def obey(*words):
        code = main([str(word) for word in words])
        said = capsys.readouterr()
        return code, said.out, said.err

    return obey


@pytest.fixture
def cramp_here(cramp, here):
    """Check a deck given as bytes: exit code and what is said."""

    def check(data):
        (here / "deck.yaml").write_bytes(data)
        code, out, err = cramp("check", "deck.yaml")
        return code, out + err

    return check


@pytest.fixture
def solver(monkeypatch):
    """A solver that takes no time; set `error` and it ends with that error."""
    stub = SimpleNamespace(error=None, built=0, needs={"memory_bytes": 1000, "disk_bytes": 1000})

    def build(deck):
        stub.built += 1
        return "model", "state"

    def simulate(deck, model, state, outputs, reporter, **more):
        reporter.start(deck.solver.end_time, deck.title, {"particles": 3})
        outputs.history({"step": 1, "time": 1e-6, "energy_error": 0.0})
        outputs.tips([{"step": 1, "time": 1e-6, **TIP}])
        outputs.particle_frame(1, 1e-6, np.zeros((3, 2)), {"mass": np.ones(3)})
        if stub.error is not None:
            raise stub.error
        return Summary(1, deck.solver.end_time, 0.1, [TIP], 0.0, 1e6)

    def estimate(deck):
        return {"cells": 900, **stub.needs}

    for name, parts in {
        "cramp_cli.build": {"build": build, "estimate": estimate, "filled": lambda *_: {}},
        "cramp_cli.simulation": {"simulate": simulate},
        "cramp_cli.warm": {"run_small_cases": lambda: None},
    }.items():
        module = ModuleType(name)
        module.__dict__.update(parts)
        monkeypatch.setitem(sys.modules, name, module)
    size = Size((30, 30), 3, stub.needs["memory_bytes"])
    monkeypatch.setattr("cramp_cli.deck.size.size_of", lambda deck: size)
    return stub
