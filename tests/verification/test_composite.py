"""A crack crosses a composite: through the matrix, round every inclusion; mirrored if it is."""

import numpy as np
import pytest
import yaml
from runs import INPUTS, Rows
from support import read
from verification.growing import away

from cramp_cli.build import build
from cramp_cli.simulation import simulate

pytestmark = [pytest.mark.verification, pytest.mark.slow]


def composite(sign):
    """Return the deck, mirrored at y = 0 with sign -1."""
    data = yaml.safe_load((INPUTS / "composite.yaml").read_text(encoding="utf-8"))
    for disk in data["bodies"][1]["shape"]["of"]:
        disk["center"][1] = _times(sign, disk["center"][1])
    for point in data["cracks"][0]["points"]:
        point[1] = _times(sign, point[1])
    return data


def _times(sign, text):
    value, unit = text.split()
    return f"{sign * float(value)} {unit}"


class Quiet:
    """Stands in for the terminal."""

    def __getattr__(self, name):
        return lambda *args, **kwargs: None


def run(sign, **sections):
    """Return places (m) of the last crack in the undeformed body, events, and the history."""
    deck = read(composite(sign), **sections)
    model, state = build(deck)
    rows = Rows()
    simulate(deck, model, state, rows, Quiet())
    path = np.array([[row["X"], row["Y"]] for row in rows.tables["path"]])
    return path, rows.tables["growth"], rows.tables["history"]


@pytest.fixture(scope="module")
def plain():
    return run(1)


def disks():
    return [
        [float(text.split()[0]) * 1e-3 for text in disk["center"]]
        for disk in composite(1)["bodies"][1]["shape"]["of"]
    ]


def test_the_crack_leaves_at_the_far_edge(plain):
    last = plain[1][-1]
    assert last["kind"] == "edge"
    assert last["x"] > 0.0099


def test_no_point_of_the_crack_lies_in_an_inclusion(plain):
    assert len(disks()) >= 14
    for center in disks():
        assert np.hypot(*(plain[0] - center).T).min() > 1.4e-3


def test_it_meets_one_head_on(plain):
    """Within half a millimetre of the line of the notch, and closer than a cell."""
    away = np.hypot(*(plain[0] - disks()[0]).T).min() - 1.4e-3
    assert away < 0.25e-3
    assert abs(disks()[0][1] - 0.125e-3) < 0.5e-3


def test_the_balance_holds_while_it_grows(plain):
    """Reached on 2026-11-22: 1.8 %."""
    end = plain[1][-1]["time"]
    assert max(abs(row["energy_error"]) for row in plain[2] if row["time"] < end) < 0.03


def coarse(sign):
    """The same with larger cells; the notch in the middle of one, where a mirror finds it too."""
    notch = composite(sign)["cracks"][0]
    notch["points"] = [[x, f"{0.25 * sign} mm"] for x, _ in notch["points"]]
    return run(sign, grid={"cell": 0.5e-3}, solver={"end_time": 90e-6}, cracks=[notch])


def test_the_mirrored_specimen_has_the_mirrored_crack():
    """Lines within a hundredth of a cell, round the first one and on; reached: 1e-4 of it."""
    (path, _, _), (other, _, _) = coarse(1), coarse(-1)
    assert path[-1, 0] > -1e-3
    mirrored = path[path[:, 0] < other[-1, 0]] * [1, -1]
    assert max(away(point, other) for point in mirrored) < 5e-6
