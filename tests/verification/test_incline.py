"""A block on a closed crack slides like a rigid block on an incline, or friction holds it.

The way is that of the centre of mass of all that lies above the crack, along the crack. Gravity
comes
within 4 ms: with gravity at once the block bounces (period 1.8 ms) and slides while it is light,
which no rigid block does (measured: 1.6 % too far at mu = 0.4 after 40 ms, and no rest at mu =
0.7).
"""

import numpy as np
import pytest
from runs import INPUTS
from support import advance
from verification.solutions import incline_slide

from cramp_cli.build import build
from cramp_cli.deck.deck import read_deck
from cramp_cli.scratch import make_scratch

pytestmark = pytest.mark.verification

ANGLE = np.radians(30.0)
RAMP = 4e-3  # s, as in the deck
TIMES = (10e-3, 20e-3)  # s


def slide(mu):
    """Return (time, way, velocity) of the upper block down the incline at the two times."""
    deck = read_deck(INPUTS / "closed_crack.yaml", [f"cracks.incline.contact.mu={mu}"])
    model, state = build(deck)
    scratch, p = make_scratch(model, state), state.particles
    down = -np.array([np.cos(ANGLE), np.sin(ANGLE)])
    above = p.origin[:, 1] > deck.cracks[0].points[0][1] + np.tan(ANGLE) * p.origin[:, 0]
    seen = []
    for time in TIMES:
        advance(model, state, scratch, round((time - state.time) / model.dt))
        way = (p.position - p.origin)[above].mean(axis=0) @ down
        seen.append((state.time, way, p.velocity[above].mean(axis=0) @ down))
    assert scratch.rows.count[2] == 0  # no particle saw the crack from its wrong side
    return seen


@pytest.mark.parametrize("mu", [0.0, 0.2, 0.4])  # tan 30 = 0.577
def test_upper_block_slides(mu):
    early, late = slide(mu)
    for time, way, _ in (early, late):
        assert way == pytest.approx(incline_slide(time, ANGLE, mu, RAMP)[0], rel=0.01)
    gained = incline_slide(late[0], ANGLE, mu, 0.0)[1] - incline_slide(early[0], ANGLE, mu, 0.0)[1]
    assert late[2] - early[2] == pytest.approx(gained, rel=0.01)


def test_friction_holds_the_upper_block():
    time, way, _ = slide(0.7)[-1]
    assert abs(way) < 0.01 * incline_slide(time, ANGLE, 0.0, RAMP)[0]
