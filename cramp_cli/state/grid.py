"""The scratch paper: sums over particles, in rows.

Row i below the number of nodes is velocity field 0 of node i, the side on which the node itself
lies. Further rows exist only at nodes near cracks, one for every side that particles on the far
side of a crack belong to (Nairn 2003: each node has multiple velocity fields), and at nodes that
bodies in contact share.
"""

from typing import NamedTuple

import numpy as np


class Grid(NamedTuple):
    """Sums per row; a row without particles has mass 0."""

    mass: np.ndarray  # (rows,) kg
    momentum: np.ndarray  # (rows, dim) kg m/s
    saved: np.ndarray  # (rows, dim) momentum before the first boundary conditions
    force: np.ndarray  # (rows, dim) N
    velocity: np.ndarray  # (rows, dim) m/s
    acceleration: np.ndarray  # (rows, dim) m/s^2


class Rows(NamedTuple):
    """Which rows a node has beyond its own, and what lies between them.

    A row is told by the contact group of its particles and by the cracks that the lines from them
    to its node cross: none, one, or two. The node's own row crosses none and belongs to the lowest
    of the groups that see the node. Arrays over extra rows start at row number `nodes`.
    """

    count: np.ndarray  # (6,) extra rows, nodes with them, wrong sides, third cracks, tipped, pairs
    first: np.ndarray  # (nodes,) first extra row of a node, or -1
    next: np.ndarray  # (extra,) next extra row of the same node, or -1; ascending by their labels
    node: np.ndarray  # (extra,) node of an extra row
    shared: np.ndarray  # (extra,) nodes that have extra rows
    lowest: np.ndarray  # (nodes,) the lowest of the contact groups that see a node
    highest: np.ndarray  # (nodes,) the highest of them
    group: np.ndarray  # (extra,) contact group of the particles of a row
    crack: np.ndarray  # (extra, 2) branches of cracks crossed, ascending, -1 for none
    side: np.ndarray  # (extra, 2) side of the row's particles: +1 above, -1 below the branch
    owner: np.ndarray  # (extra, 2) crack whose contact law holds across the branch, or -1
    normal: np.ndarray  # (extra, 2, dim) sum of crossed segments turned from above to below, m
    touching: np.ndarray  # (extra, 2) open, sliding or stuck to the row across each crack
    pair: np.ndarray  # (pairs, 2) rows above and below an arm of a junction: sectors.py
    pair_crack: np.ndarray  # (pairs,) crack of that arm
    pair_normal: np.ndarray  # (pairs, dim) first segment of the arm turned from above to below, m
    pair_touching: np.ndarray  # (pairs,) open, sliding or stuck
    impulse: np.ndarray  # (extra, 2, 5, dim) of contact in a step: cracks/contact.py
    tip: np.ndarray  # (nodes,) tip (2 * crack + end) that is near a node, or -1
    tip_side: np.ndarray  # (nodes,) side of that crack on which the node lies
    tip_branch: np.ndarray  # (nodes,) branch of that crack to which the node is nearest
    tip_turn: np.ndarray  # (nodes,) -1 where the branch runs against the crack, else 1
    tip_segment: np.ndarray  # (nodes,) segment of the crack nearest to the node
    tip_seen: np.ndarray  # (nodes, 2) mass it sees on its own side of that crack, across it; kg
    tip_cut: np.ndarray  # (nodes, 2) the same times the square of the cut share; kg
    tip_split: np.ndarray  # (nodes,) whether it sees a particle that is cut
    tipped: np.ndarray  # (nodes,) nodes that have a tip
    weight: np.ndarray  # (rows,) sum S m at shared nodes, without images, kg
    displacement: np.ndarray  # (rows, dim) the same times displacement, kg m
    place: np.ndarray  # (rows, dim) times position, kg m
    turn: np.ndarray  # (rows, 2) times F_xx + F_yy, F_yx - F_xy, kg


def make_grid(node_count: int, dim: int, extra: int) -> tuple[Grid, Rows]:
    """Return empty arrays for `node_count` nodes and at most `extra` further rows."""
    rows = node_count + extra

    def vectors() -> np.ndarray:
        return np.zeros((rows, dim))

    grid = Grid(np.zeros(rows), vectors(), vectors(), vectors(), vectors(), vectors())
    fields = Rows(
        count=np.zeros(6, dtype=np.int64),
        first=np.full(node_count, -1, dtype=np.int64),
        next=np.full(extra, -1, dtype=np.int64),
        node=np.zeros(extra, dtype=np.int64),
        shared=np.zeros(extra, dtype=np.int64),
        lowest=np.zeros(node_count, dtype=np.int64),
        highest=np.zeros(node_count, dtype=np.int64),
        group=np.zeros(extra, dtype=np.int64),
        crack=np.full((extra, 2), -1, dtype=np.int64),
        side=np.zeros((extra, 2), dtype=np.int64),
        owner=np.full((extra, 2), -1, dtype=np.int64),
        normal=np.zeros((extra, 2, dim)),
        touching=np.zeros((extra, 2), dtype=np.int64),
        pair=np.zeros((extra, 2), dtype=np.int64),
        pair_crack=np.zeros(extra, dtype=np.int64),
        pair_normal=np.zeros((extra, dim)),
        pair_touching=np.zeros(extra, dtype=np.int64),
        impulse=np.zeros((extra, 2, 5, dim)),
        tip=np.full(node_count, -1, dtype=np.int64),
        tip_side=np.zeros(node_count, dtype=np.int64),
        tip_branch=np.zeros(node_count, dtype=np.int64),
        tip_turn=np.ones(node_count, dtype=np.int64),
        tip_segment=np.zeros(node_count, dtype=np.int64),
        tip_seen=np.zeros((node_count, 2)),
        tip_cut=np.zeros((node_count, 2)),
        tip_split=np.zeros(node_count, dtype=np.bool_),
        tipped=np.zeros(node_count, dtype=np.int64),
        weight=np.zeros(rows),
        displacement=vectors(),
        place=vectors(),
        turn=np.zeros((rows, 2)),
    )
    return grid, fields
