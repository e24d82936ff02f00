"""K and the opening of the faces are right wherever a tip lies and however its crack runs.

Plates under the tractions of an exact field, at rest (equilibrium.py). Two of them:

* a crack of 2 x 10 cells in an infinite plate (Westergaard), of which the plate is a part; K
  changes by 5 % when the crack is a cell longer;
* the field K/sqrt(2 pi r) of a tip in a rectangle whose border the crack meets after 12 cells,
  loaded on that border; K changes by 21 % per cell, as in an edge crack of ten cells, a/W = 0.5.
"""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from verification.equilibrium import NU, SHEAR, load_border, plate, rest

from cramp_cli.cracks.carry import carried
from cramp_cli.cracks.fields import cut_of_points, what_surfaces_see
from cramp_cli.cracks.tips import sample_tips
from cramp_cli.cracks.view import look_from, make_seen, side_normal

pytestmark = pytest.mark.verification

CELL, A, BORDER = 1e-3, 10, 12  # m; half crack, way to the border (cells)
K = 1e6  # Pa sqrt(m)
ACROSS, SHEARED, ALONG = 1e6, 0.5e6, -0.5e6  # far stresses in the frame of the crack (Pa)

in_cell = st.floats(-0.5, 0.5).map(lambda x: round(x, 9))  # a deck knows no 1e-100
# cells above a row of nodes
height = st.one_of(in_cell, st.sampled_from([0.0, 1e-9, -1e-4, 0.01, -0.03]))
angle = st.one_of(
    st.floats(0.0, 90.0).map(lambda x: round(x, 9)),
    st.floats(-3.0, 1.0).map(lambda power: 10.0**power),
)


def turned(degrees):
    """Return the matrix whose columns are the way of the crack and its normal."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array([[c, -s], [s, c]])


def on_grid(xx, yy, xy, turn):
    """Return stresses (n,) of the frame of the crack as tensors (n, 2, 2) of the grid."""
    own = np.stack([np.stack([xx, xy], axis=-1), np.stack([xy, yy], axis=-1)], axis=-1)
    return turn @ own @ turn.T


def around_a_tip(tip, turn):
    """Return the stress of K_I alone; on the line of the crack, of the side of the particle."""

    def stress(x, particle):
        ahead, above = ((x - tip) @ turn).T
        side = ((particle - tip) @ turn)[:, 1]
        above = np.where((ahead < 0.0) & (above * side < 0.0), 0.0, above)
        t = np.arctan2(np.copysign(above, np.where(ahead < 0.0, side, above)), ahead)
        c, s, c3, s3 = np.cos(0.5 * t), np.sin(0.5 * t), np.cos(1.5 * t), np.sin(1.5 * t)
        f = K * c / np.sqrt(2.0 * np.pi * np.hypot(ahead, above))
        return on_grid(f * (1.0 - s * s3), f * (1.0 + s * s3), f * s * c3, turn)

    return stress


def around_a_crack(centre, turn):
    """Return the stress around a straight crack in an infinite plate under far stresses."""

    def stress(x, particle):
        along, above = ((x - centre) @ turn).T
        z, a = along + 1j * above, A * CELL
        root = np.sqrt(z - a) * np.sqrt(z + a)
        Z, dZ = z / root, 1.0 / root - z * z / root**3
        y = above
        xx = ACROSS * (Z.real - y * dZ.imag) + SHEARED * (2.0 * Z.imag + y * dZ.real) + ALONG
        yy = ACROSS * (Z.real + y * dZ.imag) - SHEARED * y * dZ.real
        xy = -ACROSS * y * dZ.real + SHEARED * (Z.real - y * dZ.imag)
        return on_grid(xx, yy, xy, turn)

    return stress


def with_border_crack(tip, degrees, noise=()):
    """Return a plate at rest, u of its rows, and K_I, K_II over the exact K_I.

    tip: from a node (cells); noise: offsets of points of the line, evenly spread (n, 2), cells
    """
    turn, tip = turned(degrees), np.array(tip)
    way, long = turn[:, 0], 8 * BORDER // 5
    size = np.array([BORDER, long] if degrees < 45.0 else [long, BORDER])  # no mouth at a corner
    mouth = tip - min((tip + size)[d] / way[d] for d in range(2) if way[d] > 1e-12) * way
    shares = np.arange(1, len(noise) + 1)[:, None] / (len(noise) + 1)
    line = np.concatenate(
        [[mouth], mouth + shares * (tip - mouth) + np.reshape(noise, (-1, 2)), [tip]]
    )
    at_rest = plate(size, line, ("edge", "tip"), CELL)
    force = load_border(*at_rest, around_a_tip(CELL * tip, turn))
    return at_rest, rest(*at_rest, force), intensities(at_rest) / K


def intensities(at_rest):
    """Return K_I and K_II of all tips (tips, 2)."""
    return np.array([[row["K_I"], row["K_II"]] for row in sample_tips(*at_rest)])


@given(in_cell, height, angle)
@settings(max_examples=8)
@example(0.0, 0.0, 1.0)
@example(0.0, 0.0, 0.1)
@example(-0.033, 0.0, 2.2)  # 8 % too low when the nodes of one side alone led
@example(-0.4, 0.3, 56.0)  # with faint nodes of their own jump 2.5 % too high
def test_K_of_a_crack_from_the_border(x, y, degrees):
    """Measured: -1.5 to +1.6 % in K_I (rms 0.7 %), K_II up to 1.1 %, 500 places and angles."""
    _, _, ((K_I, K_II),) = with_border_crack((x, y), degrees)
    assert abs(K_I - 1.0) < 0.017
    assert abs(K_II) < 0.015


@given(in_cell, height, angle)
@settings(max_examples=8)
@example(0.0, 0.0, 1.0)
def test_K_of_a_crack_inside(x, y, degrees):
    """Both tips, one `height` above a row of nodes; both modes and a stress along the crack.

    Measured: -0.6 to +0.8 % in K_I, up to 1.5 % in K_II, 100 places and angles.
    """
    turn = turned(degrees)
    centre = np.array([x, y - A * turn[1, 0] + round(A * turn[1, 0])])
    line = centre + np.outer([-A, A], turn[:, 0])
    at_rest = plate((25, 25), line, ("tip", "tip"), CELL)
    rest(*at_rest, load_border(*at_rest, around_a_crack(CELL * centre, turn)))
    exact = np.sqrt(np.pi * A * CELL) * np.array([ACROSS, SHEARED])
    assert np.abs(intensities(at_rest) - exact).max() < 0.015 * np.hypot(*exact)


@given(in_cell, height, angle, st.integers(0, 2**32 - 1))
@settings(max_examples=8)
def test_K_does_not_mind_noise_of_the_points(x, y, degrees, seed):
    """A digitised line: a point per 1.5 cells, up to 0.05 cells off. Measured: -1.4 to +0.8 %."""
    noise = np.random.default_rng(seed).uniform(-0.05, 0.05, (7, 2))
    _, _, ((K_I, _),) = with_border_crack((x, y), degrees, noise)
    assert abs(K_I - 1.0) < 0.015


def openings(at_rest, u):
    """Return the way from the tip (m) and the opening (m) of the points of a straight crack."""
    model, state, scratch = at_rest
    paths, seen, found = state.paths, make_seen(), []
    cut, where = cut_of_points(model, paths, scratch.at_tips), what_surfaces_see(model, scratch)
    for k in range(len(paths.point)):
        normal, face = side_normal(paths.point, k, 0, len(paths.point) - 1), []
        for side in (1, -1):
            who = (seen, False, paths, k, 0, side, normal, cut[k])
            n, total = look_from(*who, scratch.grid.mass, *where)
            assert total > 0.0
            face.append(np.array(carried(seen, n, u)))
        found.append((face[0] - face[1]) @ np.array(normal))
    return np.hypot(*(paths.point - paths.point[-1]).T), np.array(found)


@given(in_cell, height)
@settings(max_examples=8)
@example(0.276, -0.182)  # 0.67 when a face took a node that sees the other side alone for its own
@example(0.0, -0.25)
@example(0.0, -0.25 + 1e-12)  # a row that holds next to nothing
def test_faces_open_as_the_field_around_the_tip(x, y):
    """4 (1 - nu) K/G sqrt(r/2 pi) with the K found, from one cell to five.

    Measured: 0.949 to 1.049 of it at one cell and a half, 0.994 to 1.005 from three on.
    """
    at_rest, u, ((K_I, _),) = with_border_crack((x, y), 0.0)
    r, opened = openings(at_rest, u)
    near = (r > 0.99 * CELL) & (r < 5.0 * CELL)
    exact = 4.0 * (1.0 - NU) * K * K_I / SHEAR * np.sqrt(r[near] / (2.0 * np.pi))
    assert near.sum() >= 7
    np.testing.assert_allclose(opened[near], exact, rtol=0.052)
