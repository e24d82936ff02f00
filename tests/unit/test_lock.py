"""The lock holds all that `make test` installs: exact versions with hashes, for every Python."""

import re
import tomllib
from pathlib import Path

import pytest
from packaging.markers import Marker
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).resolve().parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
EXTRAS = PROJECT["project"]["optional-dependencies"]
PIN = re.compile(r"^(\S+)==(\S+)(?: ; (.+?))? \\$", re.MULTILINE)
HASH = re.compile(r"--hash=sha256:[0-9a-f]{64}")
BLOCK = re.compile(r"^\S.*?(?=^\S|\Z)", re.MULTILINE | re.DOTALL)
TOLD = "the lock is older than pyproject.toml: make lock"


def pins(name):
    """Return (name, version, marker) of every pin of a lock, and how many blocks it has."""
    text = (ROOT / "locks" / name).read_text(encoding="utf-8")
    blocks = [block for block in BLOCK.findall(text) if not block.startswith("#")]
    assert all(HASH.search(block) for block in blocks)
    found = [
        (name, version, Marker(marker) if marker else None)
        for name, version, marker in PIN.findall(text)
    ]
    assert len(found) == len(blocks)
    return found


def asked():
    """Return what pyproject.toml asks for, its extras among it, and what builds it."""
    texts = [*PROJECT["project"]["dependencies"], *PROJECT["build-system"]["requires"]]
    texts += [text for extra in EXTRAS.values() for text in extra]
    return [one for one in map(Requirement, texts) if one.name != "cramp"]


@pytest.mark.parametrize("python", ["3.11", "3.12", "3.13"])
def test_all_that_is_asked_for_is_pinned_within_its_range(python):
    here = {"python_version": python, "python_full_version": f"{python}.9"}
    pinned = {}
    for name, version, marker in pins("dev.txt"):
        if marker is None or marker.evaluate(here):
            assert name not in pinned
            pinned[name] = version
    for one in asked():
        assert one.specifier.contains(pinned[canonicalize_name(one.name)]), TOLD


def test_what_builds_the_project_is_among_what_is_locked():
    """Or pip would fetch it anew, unlocked, to install the project."""
    assert set(PROJECT["build-system"]["requires"]) <= set(EXTRAS["dev"])


def test_the_tool_that_makes_the_lock_is_locked_too():
    assert [name for name, _, _ in pins("tools.txt")] == ["uv"]


def test_every_lower_bound_is_given():
    """`make test-oldest` tests it."""
    assert all(any(s.operator == ">=" for s in one.specifier) for one in asked())
