"""A foam and a bed of disks, compressed to half their height: nothing lost, forces in balance."""

import numpy as np
import pytest
from runs import INPUTS

from cramp_cli.commands import RunOptions, run_deck
from cramp_cli.deck.deck import read_deck
from cramp_cli.output.fields import read_frames
from cramp_cli.study.results import read_table

pytestmark = [pytest.mark.verification, pytest.mark.slow]
GAPS = {"foam": (0.006, 0.018), "packed_bed": (0.035, 0.105)}  # between the walls in the end (m)
REST = 0.2  # of the run, its end: the walls stand still and damping has taken the waves


@pytest.fixture(scope="module", params=GAPS)
def case(request, tmp_path_factory):
    """Deck, gap between the walls in the end, first and last frame, table of the history."""
    folder = tmp_path_factory.mktemp(request.param) / "run"
    deck = INPUTS / f"{request.param}.yaml"
    run_deck(deck, RunOptions(output=folder, progress="none", verbosity=0))
    frames = list(read_frames(folder / "particles.h5"))
    return read_deck(deck), GAPS[request.param], frames[0], frames[-1], history(folder)


def history(folder):
    return read_table(folder / "history.csv")


def soft(deck, frame):
    """Places of the particles that are not rigid (m)."""
    rigid = [number for number, body in enumerate(deck.bodies) if body.rigid]
    return frame.points[~np.isin(frame.fields["body"], rigid)]


def test_no_particle_is_lost_and_none_is_in_a_wall(case):
    """Half a particle of way into a wall is what contact at nodes allows."""
    deck, (low, high), first, last, _ = case
    before, after = soft(deck, first), soft(deck, last)
    assert after.shape == before.shape
    assert np.isfinite(after).all()
    most = 0.5 * deck.grid.cell / 2
    assert after[:, 1].min() > low - most
    assert after[:, 1].max() < high + most
    assert np.ptp(before[:, 1]) > 1.9 * (high - low)


def test_both_walls_feel_the_same_force(case):
    """At rest the sum of all forces is zero; means over the last fifth of the run."""
    *_, table = case
    late = table["time"] > (1.0 - REST) * table["time"][-1]
    top, bottom = (table[f"contact_{name}_y"][late].mean() for name in ("top", "bottom"))
    assert top > 0.0
    assert top == pytest.approx(-bottom, rel=0.05)


def test_the_solid_rests_in_the_end(case):
    """Work has become strain, friction and damping; what still moves is a small part of it."""
    *_, table = case
    assert table["kinetic_energy"][-1] < 0.02 * table["external_work"][-1]
