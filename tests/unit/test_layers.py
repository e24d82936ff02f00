"""Imports point down only, and what computes knows no files, no log and no clock."""

import ast
from pathlib import Path

import pytest

import cramp_cli

PACKAGE = Path(cramp_cli.__file__).parent
LAYERS = (
    ("__init__",),
    ("numerics",),
    ("state", "schema"),
    ("shapes", "materials", "cohesive"),
    ("transfer",),
    ("cracks",),
    ("boundary", "contact"),  # conditions act on the rows that cracks make
    ("grid_velocity", "scratch"),
    ("step",),
    ("deck", "output"),
    ("build",),
    ("warm", "clock", "energy_balance", "settling", "pace"),
    ("simulation",),
    ("study",),
    ("commands", "streams"),
    ("cli",),
    ("__main__",),
)
LAYER = {name: number for number, names in enumerate(LAYERS) for name in names}
OF_THE_TOP = {"logging", "time", "datetime", "io", "os", "shutil", "tempfile", "sys"}
FILE_CALLS = {"print", "input", "open", "read_text", "read_bytes", "write_text", "write_bytes"}
EXCEPT = {
    "numerics/cache.py",
    "numerics/kernel_cache.py",  # names the folder of compiled kernels
    "numerics/start.py",  # says what numba need not import
    "schema/loader.py",  # reads the deck
}
MODULES = sorted(path.relative_to(PACKAGE).as_posix() for path in PACKAGE.rglob("*.py"))


def place(module):
    return module.split("/")[0].removesuffix(".py")


def test_every_module_has_a_layer():
    assert {place(module) for module in MODULES} <= set(LAYER)


def syntax(module):
    return list(ast.walk(ast.parse((PACKAGE / module).read_text(encoding="utf-8"))))


def imported(module):
    for node in syntax(module):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        if isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{module}:{node.lineno}: import by the full name"
            yield node.module


def own_places(module):
    names = (name.split(".") for name in imported(module))
    return {(name + ["__init__"])[1] for name in names if name[0] == "cramp_cli"}


@pytest.mark.parametrize("module", MODULES)
def test_imports_point_down(module):
    here = place(module)
    for other in own_places(module) - {here}:
        assert other in LAYER, f"{other} has no layer"
        assert LAYER[other] < LAYER[here], f"{module} must not import cramp_cli.{other}"


@pytest.mark.parametrize("module", [m for m in MODULES if m not in EXCEPT])
def test_no_files_no_log_no_clock_up_to_the_step(module):
    if LAYER.get(place(module), 0) > LAYER["step"]:
        return
    tops = {name.split(".")[0] for name in imported(module)}
    assert not tops & OF_THE_TOP, f"{module} imports {tops & OF_THE_TOP}"
    calls = [node.func for node in syntax(module) if isinstance(node, ast.Call)]
    names = {getattr(call, "id", getattr(call, "attr", "")) for call in calls}
    assert not names & FILE_CALLS, f"{module} calls {names & FILE_CALLS}"
