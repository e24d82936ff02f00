"""Parts of growth: points are added, ends move, speeds follow laws, tips meet things."""

from types import SimpleNamespace

import numpy as np
import pytest
from support import build_deck

from cramp_cli.cracks.cloud import cloud_around
from cramp_cli.cracks.domain_integral import Hooke
from cramp_cli.cracks.extend import add_point, end_point, make_room, move_end
from cramp_cli.cracks.meeting import first_met, has_left_body, stay_on_grid
from cramp_cli.cracks.rayleigh import rayleigh_speed, release_factors, wave_speeds
from cramp_cli.cracks.segments import make_segments
from cramp_cli.cracks.speed import (
    ALMOST,
    EnergyBalance,
    Prescribed,
    Pull,
    RisingToughness,
    ToughnessTable,
)
from cramp_cli.cracks.tip_load import kink_load
from cramp_cli.cracks.tips import tips_of
from cramp_cli.state.failure import NumericalFailure
from cramp_cli.state.paths import TIP, make_paths

LINES = [[[0, 0], [1, 0], [2, 0]], [[5, 5], [5, 6]]]
DECK = """
cramp: 1
analysis: plane_strain
grid: {cell: 1, lower: [-2, -2], upper: [22, 12]}
materials: {m: {law: elastic, density: 1, E: 1, nu: 0.25, toughness: {K_Ic: 2}}}
bodies: [{name: b, material: m, shape: {type: rectangle, lower: [0, 0], upper: [20, 10]}}]
cracks:
  - {name: flat, points: [[0, 5], [8, 5]], start: edge}
  - {name: upright, points: [[9, 2], [9, 8]]}
solver: {end_time: 1}
propagation: {criterion: max_hoop_stress}
"""


@pytest.fixture
def paths():
    return make_paths(LINES, [(TIP, TIP)] * 2, [0, 0], [(-1, 0)] * 2, 2)


def test_a_crack_gets_longer_at_its_last_point(paths):
    longer = add_point(paths, 0, 1)
    move_end(longer, 0, 1, np.array([0.5, 0.25]), np.array([0.5, 0.3]))
    assert longer.point[longer.crack(0)].tolist() == [[0, 0], [1, 0], [2, 0], [2.5, 0.3]]
    assert longer.origin[longer.crack(0)][-1].tolist() == [2.5, 0.25]
    assert longer.above[longer.crack(0)][-1].tolist() == [2.5, 0.3]
    assert longer.point[longer.crack(1)].tolist() == LINES[1]
    assert paths.point[paths.crack(0)].tolist() == LINES[0]


def test_a_crack_gets_longer_at_its_first_point(paths):
    longer = add_point(paths, 1, 0)
    move_end(longer, 1, 0, np.array([0.0, -1.0]), np.array([0.0, -1.0]))
    assert longer.point[longer.crack(1)].tolist() == [[5, 4], [5, 5], [5, 6]]
    assert longer.point[longer.crack(0)].tolist() == LINES[0]
    assert [end_point(longer, c, e) for c in (0, 1) for e in (0, 1)] == [0, 2, 3, 5]


def test_an_end_is_closed_where_it_arrives(paths):
    paths.above[2] += [0.0, 0.1]
    move_end(paths, 0, 1, np.array([0.5, 0.0]), np.array([0.5, 0.0]))
    assert paths.above[2].tolist() == paths.below[2].tolist() == paths.point[2].tolist()


def test_lists_of_segments_grow_with_the_cracks(paths):
    segments = make_segments(4, 3, 10)
    assert make_room(paths, segments, 4) is segments
    segments.head[2], segments.used[0], segments.ends[0, 1] = 0, 1, 7.0
    more = make_room(add_point(paths, 0, 1), segments, 4)
    assert len(more.crack) >= 4
    assert (more.head[2], more.used[0], more.ends[0, 1]) == (0, 1, 7.0)  # as it was listed


def pull(drive, release=1.0, before=0.0):
    return Pull(drive, release, before, rayleigh=1000.0, dt=1e-7, width=1e-3)


def test_rising_toughness():
    """K_Ic/sqrt(1 - v/c_R) = K at v = 0.75 c_R is twice K_Ic."""
    assert RisingToughness().speed(pull(2.0)) == pytest.approx(750.0)
    assert RisingToughness().speed(pull(1.0)) == RisingToughness().speed(pull(-3.0)) == 0.0


def test_energy_balance():
    law = EnergyBalance()
    assert law.speed(pull(0.9, release=0.81)) == 0.0
    assert law.speed(pull(1.0, release=1.5)) == pytest.approx(0.5 * 1000.0 * 1e-7 / 4e-6)
    assert law.speed(pull(0.9, release=1.0, before=300.0)) == 300.0
    assert law.speed(pull(0.5, release=-9.0, before=1.0)) == 0.0
    assert law.speed(pull(9.0, release=81.0, before=979.9)) == ALMOST * 1000.0


def test_toughness_table_and_prescribed_speed():
    law = ToughnessTable((0.0, 100.0, 300.0), (1.0, 1.5, 2.0))
    assert [law.speed(pull(d)) for d in (0.5, 1.0, 1.25, 1.75, 9.0)] == [0, 0, 50, 200, 300]
    assert Prescribed(400.0).speed(pull(1.0)) == 400.0
    assert Prescribed(400.0).speed(pull(0.99)) == 0.0
    assert Prescribed(4000.0).speed(pull(1.0)) == ALMOST * 1000.0


def flat_tip(place):
    model, state, _ = build_deck(DECK)
    tip = tips_of(state.paths)[0]
    move_end(state.paths, 0, 1, np.array(place) - [8, 5], np.array(place) - [8, 5])
    return model, state, tip


@pytest.mark.parametrize(
    ("place", "step", "found"),
    [
        ((8.0, 5.0), 0.5, None),
        ((8.5, 5.0), 0.1, None),
        ((8.7, 5.0), 0.1, (0.3, 0.0)),
        ((8.95, 5.0), 0.1, (0.05, 0.0)),
        ((8.95, 1.5), 0.1, None),  # half a cell below the end of it
        ((8.95, 1.6), 0.1, (0.05, 0.4)),  # nearer
        ((8.4, 1.9), 0.1, None),  # it is not there yet
        ((9.1, 5.0), 0.1, None),
    ],
)
def test_another_crack_ahead(place, step, found):
    model, state, tip = flat_tip(place)
    met = first_met(model, state, tip, (1.0, 0.0), step)
    if found is None:
        assert met is None
        return
    assert met.now == pytest.approx(found)
    assert met.before == pytest.approx(found)
    assert met.other == (None if found[1] == 0.0 else (1, 0))


@pytest.mark.parametrize(
    ("place", "out"),
    [((8.0, 5.0), False), ((19.99, 5.0), False), ((20.13, 5.0), True), ((10.0, 10.2), True)],
)
def test_free_surface(place, out):
    """Particles are half a cell wide: air begins an eighth of a cell outside at the latest."""
    model, state, scratch = build_deck(DECK)
    cloud = cloud_around(model, state, scratch, place, 3.0)
    assert has_left_body(model, cloud, np.array(place)) is out


def test_border_of_the_grid():
    model, state, tip = flat_tip((21.5, 5.0))
    with pytest.raises(NumericalFailure, match="crack flat has grown to the border of the grid"):
        stay_on_grid(model, state, tip)


STEEL = Hooke(shear=1.0, kappa=1.8, plane_nu=0.3, stiffness=2.0 / 0.7)
WAVES = wave_speeds(1.0, 1.8, 1.0)


def kink_at(speed, load=(0.0, 0.0, 0.0)):
    """Return site and state of a kink, as far as its load asks for them."""
    growth = SimpleNamespace(speed=np.array([speed]), load=np.array([load]))
    site = SimpleNamespace(hooke=STEEL, block=SimpleNamespace(density=1.0))
    return site, SimpleNamespace(growth=growth)


def test_a_short_kink_at_rest_has_the_load_that_statics_gives_it():
    site, state = kink_at(0.0, (9.0, 9.0, 9.0))
    assert kink_load(state, 0, site, 3.0, 4.0) == pytest.approx((25.0 * 0.35, 3.0, 4.0))


@pytest.mark.parametrize("excess", [1.05, 1.3, 2.0, 4.0])
def test_speed_and_load_of_a_short_kink_settle(excess):
    """G(v) = (1 - v/c_R) G(0), with K that belongs to it (Freund 1990, eq. 5.3.10, 7.4.5)."""
    site, state = kink_at(0.0)
    growth, law, rayleigh = state.growth, RisingToughness(), rayleigh_speed(*WAVES)
    speeds = []
    for _ in range(40):
        growth.load[0] = kink_load(state, 0, site, excess, 0.0)
        growth.speed[0] = law.speed(Pull(growth.load[0, 1], 1.0, growth.speed[0], rayleigh, 1, 1))
        speeds.append(float(growth.speed[0]))
    found, K_I, K_II = growth.load[0].tolist()
    speed = speeds[-1]
    assert speeds[-5:] == pytest.approx([speed] * 5, rel=1e-6)
    assert 0.0 < speed < (1.0 - excess**-2) * rayleigh  # what K of a kink at rest would give
    assert found == pytest.approx((1.0 - speed / rayleigh) * excess**2 * 0.35, rel=1e-5)
    assert found == pytest.approx(release_factors(speed, *WAVES)[0] * K_I**2 / 2.0, rel=1e-5)
    assert K_II == 0.0
