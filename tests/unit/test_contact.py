"""Contact of two rows of a node: what the law gives and takes (docs/theory/contact.md)."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cramp_cli.cracks.contact import (
    FIRST,
    FRICTIONAL,
    GLUED,
    IGNORE,
    LAST,
    OPEN,
    SLIDING,
    STICK,
    STUCK,
    UPDATE,
    ContactLaws,
    impulse,
    touch,
    touch_increment,
)
from cramp_cli.cracks.contact_books import BEFORE
from cramp_cli.cracks.rows import add_row
from cramp_cli.state.grid import make_grid

ABOVE, BELOW, DT = 1, 0, 0.1  # the row across the crack is above it; the node lies below
STRIDES = (1, 2)
EVERY_LAW = pytest.mark.parametrize("kind", [IGNORE, FRICTIONAL, STICK, GLUED])
PASSES = pytest.mark.parametrize("stage", [FIRST, UPDATE, LAST])
NONE = -1
ALL = np.ones(1)  # of the sums at the node are the body's own
WHOLE = 0  # the only contact group
DOWN = (0.0, -1.0)  # from above to below a crack along +x


def meeting(mass, momentum, normal=DOWN, gap=-1.0, force=((0.0, 0.0),) * 2):
    """Return grid and rows of one node with particles below (row 0) and above (row 1) a crack.

    gap: opening of the faces (m); negative where they overlap
    """
    grid, rows = make_grid(1, 2, 1)
    assert add_row(rows, 0, WHOLE, 0, 1, NONE, 0) == ABOVE
    rows.normal[0, 0] = 0.3 * np.array(normal)
    grid.mass[:], grid.momentum[:], grid.force[:] = mass, momentum, force
    grid.saved[:] = grid.momentum
    rows.displacement[BELOW] = gap * mass[BELOW] * np.array(normal)
    rows.weight[:], rows.turn[:, 0] = mass, 2.0 * np.array(mass)
    return grid, rows


def laws(kind, mu=0.0, mu_static=None):
    static = mu if mu_static is None else mu_static
    return ContactLaws(np.array([kind]), np.array([mu]), np.array([static]))


def meet(kind, mass, momentum, mu=0.0, mu_static=None, stage=FIRST, **more):
    """Return grid, rows and the work of friction after contact."""
    grid, rows = meeting(mass, momentum, **more)
    rows.impulse[0, 0, BEFORE] = parted(grid, momentum)
    law = laws(kind, mu, mu_static)
    friction, _ = touch(grid, rows, law, ALL, STRIDES, DT, stage, UPDATE)
    return grid, rows, friction


def parted(grid, momentum):
    """Return the velocity of the lower side relative to the upper one."""
    velocity = np.array(momentum) / np.maximum(grid.mass, 1e-9)[:, None]
    return velocity[BELOW] - velocity[ABOVE]


MASS = (2.0, 3.0)
CLOSING = ((0.0, 0.0), (1.0, -3.0))  # the upper side comes down and slides along
PARTING = ((0.0, 0.0), (1.0, 3.0))
# Upper side to the common velocity: dp = (m_a p_b - m_b p_a)/M = -2/5 (1, -3), a = above.
TO_COMMON = np.array([-0.4, 1.2])


def given_to_above(grid, before=CLOSING):
    return grid.momentum[ABOVE] - before[1]


def test_glued_sides_move_together_even_apart():
    for momentum, gap in ((CLOSING, -1.0), (PARTING, 1.0)):
        grid, rows, _ = meet(GLUED, MASS, momentum, gap=gap)
        common = np.sum(momentum, axis=0) / 5.0
        np.testing.assert_allclose(grid.momentum / grid.mass[:, None], [common] * 2, rtol=1e-15)
        assert rows.touching[0, 0] == STUCK


def test_ignored_sides_pass_through_each_other():
    grid, _, _ = meet(IGNORE, MASS, CLOSING)
    assert grid.momentum.tolist() == [list(p) for p in CLOSING]


@pytest.mark.parametrize("kind", [FRICTIONAL, STICK])
@pytest.mark.parametrize(
    ("momentum", "gap"), [(PARTING, -1.0), (CLOSING, 1.0), (CLOSING, 0.0), (PARTING, 1.0)]
)
def test_nothing_happens_to_sides_that_part_or_are_apart(kind, momentum, gap):
    """Contact needs an overlap and an approach."""
    grid, rows, friction = meet(kind, MASS, momentum, mu=0.5, gap=gap)
    assert grid.momentum.tolist() == [list(p) for p in momentum]
    assert rows.touching[0, 0] == OPEN
    assert friction == 0.0


def test_frictionless_sides_share_the_normal_velocity_only():
    grid, rows, _ = meet(FRICTIONAL, MASS, CLOSING)
    np.testing.assert_allclose(given_to_above(grid), [0.0, TO_COMMON[1]], atol=1e-15)
    assert rows.touching[0, 0] == SLIDING


def test_coulomb_friction_is_mu_times_the_pressure():
    """mu = 0.1: 0.12 of the 0.4 that would stop the sliding."""
    grid, rows, _ = meet(FRICTIONAL, MASS, CLOSING, mu=0.1)
    np.testing.assert_allclose(given_to_above(grid), [-0.12, 1.2], rtol=1e-14)
    assert rows.touching[0, 0] == SLIDING


def test_enough_friction_stops_the_sliding():
    """mu = 0.34 could give 0.408 > 0.4."""
    grid, rows, _ = meet(FRICTIONAL, MASS, CLOSING, mu=0.34)
    np.testing.assert_allclose(given_to_above(grid), TO_COMMON, rtol=1e-14)
    assert rows.touching[0, 0] == STUCK


@pytest.mark.parametrize(("static", "slides"), [(0.33, True), (0.34, False)])
def test_static_friction_decides_whether_it_slides_and_mu_how_much(static, slides):
    """The limit is 0.4/1.2 = 1/3."""
    grid, rows, _ = meet(FRICTIONAL, MASS, CLOSING, mu=0.1, mu_static=static)
    wanted = [-0.12, 1.2] if slides else TO_COMMON
    np.testing.assert_allclose(given_to_above(grid), wanted, rtol=1e-14)
    assert rows.touching[0, 0] == (SLIDING if slides else STUCK)


def test_sides_that_stick_in_contact():
    grid, _, _ = meet(STICK, MASS, CLOSING)
    np.testing.assert_allclose(given_to_above(grid), TO_COMMON, rtol=1e-14)


number = st.integers(-1000, 1000).map(lambda n: n / 100)
pair = st.tuples(number, number)
mass_of = st.integers(1, 1000).map(lambda n: n / 100)


@EVERY_LAW
@PASSES
@settings(max_examples=30)
@given(masses=st.tuples(mass_of, mass_of), momenta=st.tuples(pair, pair), angle=number, mu=mass_of)
def test_momentum_is_kept_and_the_pair_only_loses_energy(kind, stage, masses, momenta, angle, mu):
    """What one side gets the other gives; contact is inelastic. Round-off of numbers below 20."""
    normal = (np.cos(angle), np.sin(angle))
    before = np.array(momenta)
    grid, _, friction = meet(kind, masses, before, mu, stage=stage, normal=normal)
    np.testing.assert_allclose(grid.momentum.sum(0), before.sum(0), atol=2e-14)

    def kinetic(p):
        return 0.5 * np.sum(p**2 / np.array(masses)[:, None])

    lost = kinetic(before) - kinetic(grid.momentum)
    assert lost >= -1e-14 * kinetic(before)
    assert -1e-14 * kinetic(before) <= friction <= lost + 1e-14 * kinetic(before)


def test_what_friction_takes_is_the_loss_less_that_of_the_impact():
    """The normal part of the relative motion loses dpn^2/2m_red, m_red = 6/5; friction the rest."""
    grid, _, friction = meet(FRICTIONAL, MASS, CLOSING, mu=0.1, stage=UPDATE)
    energies = [
        0.5 * np.sum(np.square(p) / np.array(MASS)[:, None]) for p in (CLOSING, grid.momentum)
    ]
    impact = 1.2**2 / (2.0 * 1.2)
    assert friction == pytest.approx(energies[0] - energies[1] - impact, rel=1e-13)


def test_friction_is_booked_once_a_step():
    for stage in (FIRST, LAST):
        assert meet(FRICTIONAL, MASS, CLOSING, mu=0.1, stage=stage)[2] == 0.0


@EVERY_LAW
def test_passes_change_what_they_should(kind):
    """A changes the saved momenta too, B the forces, C the momenta only."""
    for stage in (FIRST, UPDATE, LAST):
        grid, _, _ = meet(kind, MASS, CLOSING, mu=0.1, stage=stage)
        change = grid.momentum - CLOSING
        saved, force = (change if stage == s else 0.0 * change for s in (FIRST, UPDATE))
        np.testing.assert_allclose(grid.saved - CLOSING, saved, atol=1e-15)
        np.testing.assert_allclose(grid.force, force / DT, atol=1e-14)


@pytest.mark.parametrize(("gap", "touches"), [(0.124, True), (0.126, False), (-0.1, True)])
def test_in_the_update_the_gap_is_that_at_the_end_of_the_step(gap, touches):
    """With v = -1 at its start and the acceleration -5 of its forces, after 0.1 s: -0.125."""
    force = np.array([[0.0, 0.0], [0.0, -5.0 * 3.0]])
    start = np.array([[0.0, 0.0], [0.0, -1.0 * 3.0]])
    grid, rows = meeting(MASS, start, gap=gap, force=force)
    grid.momentum[:] += force * DT
    touch(grid, rows, laws(STICK), ALL, STRIDES, DT, UPDATE, UPDATE)
    assert rows.touching[0, 0] == (STUCK if touches else OPEN)
    _, rows, _ = meet(STICK, MASS, start, gap=gap, stage=FIRST)
    assert rows.touching[0, 0] == (STUCK if gap < 0.0 else OPEN)


def test_a_row_without_mass_is_left_alone():
    grid, rows, _ = meet(GLUED, (2.0, 0.0), ((1.0, 2.0), (0.0, 0.0)))
    assert grid.momentum.tolist() == [[1.0, 2.0], [0.0, 0.0]]
    assert rows.touching[0, 0] == OPEN


def test_the_law_does_not_ask_which_side_is_called_above():
    """impulse(-dp, -n) = -impulse(dp, n): the sides may change their names."""
    dp, n = np.array([0.3, -0.8]), np.array([0.6, 0.8])
    for kind in (FRICTIONAL, STICK, GLUED):
        there, state = impulse(kind, 0.2, 0.3, tuple(dp), tuple(n), dp @ n, -1.0)
        back, same = impulse(kind, 0.2, 0.3, tuple(-dp), tuple(-n), dp @ n, -1.0)
        np.testing.assert_allclose(back, -np.array(there), rtol=1e-15)
        assert state == same


@pytest.mark.parametrize(("state", "shared"), [(OPEN, []), (SLIDING, [1]), (STUCK, [0, 1])])
def test_higher_orders_of_the_velocity_respect_contact(state, shared):
    """Sides that slide share the normal part of the increment, sides that stick all of it."""
    grid, rows = meeting(MASS, CLOSING)
    rows.touching[0, 0] = state
    before = np.array([[0.4, -0.2], [-0.1, 0.7]])
    after = before.copy()
    touch_increment(after, grid, rows, laws(FRICTIONAL), STRIDES)
    np.testing.assert_allclose(grid.mass @ after, grid.mass @ before, atol=1e-15)
    for axis in (0, 1):
        common = [grid.mass @ before[:, axis] / 5.0] * 2
        wanted = common if axis in shared else before[:, axis]
        np.testing.assert_allclose(after[:, axis], wanted, atol=1e-15)


def met_in_turn(mass, velocity):
    """Velocities of rows 0, a, b, ab after pairs 0-a, 0-b, b-ab, a-ab took their common ones."""
    velocity = np.array(velocity, dtype=float)
    for pair_ in ([1, 0], [2, 0], [3, 2], [3, 1]):
        velocity[pair_] = mass[pair_] @ velocity[pair_] / mass[pair_].sum()
    return velocity


def test_four_rows_of_two_crossing_cracks():
    """Glued twice, rows 0, a, b, ab: pairs 0-a, 0-b, b-ab and a-ab meet once, in this order.

    A row across two cracks first meets the one across its second crack alone.
    """
    grid, rows = make_grid(1, 2, 3)
    for crossed in ((0, 1, NONE, 0), (1, 1, NONE, 0), (0, 1, 1, 1)):
        add_row(rows, 0, WHOLE, *crossed)
    rows.normal[:] = DOWN
    grid.mass[:] = (1.0, 2.0, 3.0, 4.0)
    grid.momentum[:, 0] = (1.0, -2.0, 6.0, 2.0)
    two = ContactLaws(np.array([GLUED] * 2), np.zeros(2), np.zeros(2))
    wanted = met_in_turn(grid.mass, grid.momentum[:, 0] / grid.mass)
    touch(grid, rows, two, ALL, STRIDES, DT, LAST, LAST)
    np.testing.assert_allclose(grid.momentum[:, 0] / grid.mass, wanted, rtol=1e-14)


@pytest.mark.parametrize("order", [(0, 1, 2), (2, 1, 0), (1, 2, 0)])
def test_higher_orders_do_not_depend_on_which_row_was_found_first(order):
    """Rows are found in the order of particles; four glued ones meet in that of their cracks."""
    crossed = ((0, 1, NONE, 0), (1, 1, NONE, 0), (0, 1, 1, 1))
    grid, rows = make_grid(1, 2, 3)
    made = {n: add_row(rows, 0, WHOLE, *crossed[n]) for n in order}
    rows.normal[:], rows.touching[:, 0], rows.touching[made[2] - 1, 1] = DOWN, STUCK, STUCK
    place = [0, *(made[n] for n in range(3))]
    grid.mass[place] = (1.0, 2.0, 3.0, 4.0)
    increment, wanted = np.zeros((4, 2)), (1.0, -2.0, 6.0, 2.0)
    increment[place, 0] = wanted
    touch_increment(increment, grid, rows, laws(GLUED), STRIDES)
    np.testing.assert_allclose(
        increment[place, 0], met_in_turn(grid.mass[place], wanted), rtol=1e-14
    )
