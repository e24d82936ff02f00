"""Pairs of rows of different bodies at a node: who may touch whom."""

from typing import NamedTuple

import numpy as np

from cramp_cli.cracks.contact import IGNORE, OPEN
from cramp_cli.numerics.kernel import kernel

MOST = 18  # pairs of a window: two at each of nine nodes, where a crack parts one of the bodies


class Pairs(NamedTuple):
    """Rows a and b of one node that belong to different contact groups."""

    row: np.ndarray  # (pairs, 2) rows a and b
    group: np.ndarray  # (pairs, 2) their contact groups
    node: np.ndarray  # (pairs,)
    window: np.ndarray  # (pairs, MOST) pairs of the same groups here and at the nodes around
    around: np.ndarray  # (pairs,) how many of them
    normal: np.ndarray  # (pairs, dim) unit vector from a to b
    gap: np.ndarray  # (pairs,) negative where the bodies overlap (m)
    least: np.ndarray  # (pairs, 3) beside a rigid body: way to the least gap (cells), it (m), turn
    beside: np.ndarray  # (pairs,) row of the next node that shares what the elastic one gets, or -1
    lean: np.ndarray  # (pairs,) the share of that row
    state: np.ndarray  # (pairs,) OPEN, SLIDING or STUCK
    bond: np.ndarray  # (pairs,) PARTED or JOINED, with the law `adhesive` (contact/adhesion.py)
    used: np.ndarray  # (1,) pairs in use, or wanted if there are more
    of_node: np.ndarray  # (nodes,) first pair of a node, or -1


def make_pairs(count: int, nodes: int, dim: int) -> Pairs:
    """Return room for a number of pairs."""
    return Pairs(
        row=np.zeros((count, 2), dtype=np.int64),
        group=np.zeros((count, 2), dtype=np.int64),
        node=np.zeros(count, dtype=np.int64),
        window=np.zeros((count, MOST), dtype=np.int64),
        around=np.zeros(count, dtype=np.int64),
        normal=np.zeros((count, dim)),
        gap=np.zeros(count),
        least=np.zeros((count, 3)),
        beside=np.full(count, -1, dtype=np.int64),
        lean=np.zeros(count),
        state=np.zeros(count, dtype=np.int64),
        bond=np.zeros(count, dtype=np.int64),
        used=np.zeros(1, dtype=np.int64),
        of_node=np.full(nodes, -1, dtype=np.int64),
    )


@kernel
def group_of(rows, row):
    """Return the contact group of a row."""
    nodes = len(rows.first)
    return rows.lowest[row] if row < nodes else rows.group[row - nodes]


@kernel
def next_row(rows, row):
    """Return the next row of the same node, or -1."""
    nodes = len(rows.first)
    return rows.first[row] if row < nodes else rows.next[row - nodes]


@kernel
def list_pairs(pairs, rows, clouds, laws, rigid):
    """List all pairs of rows that have particles and a law; those too many are counted only.

    rigid: (groups,) 1 for rigid bodies, which do not touch each other
    """
    pairs.used[0] = 0
    for i in range(rows.count[1]):
        a = rows.shared[i]
        while a >= 0:
            b = next_row(rows, a)
            while b >= 0 and clouds.head[a] >= 0:
                ga, gb = group_of(rows, a), group_of(rows, b)
                meet = ga != gb and clouds.head[b] >= 0 and not (rigid[ga] and rigid[gb])
                if meet and laws.kind[ga, gb] != IGNORE:
                    _enter(pairs, a, b, ga, gb, rows.shared[i])
                b = next_row(rows, b)
            a = next_row(rows, a)
    return pairs.used[0]


@kernel
def _enter(pairs, a, b, ga, gb, node):
    n = pairs.used[0]
    pairs.used[0] += 1
    if n < len(pairs.node):
        pairs.row[n, 0], pairs.row[n, 1], pairs.node[n] = a, b, node
        pairs.group[n, 0], pairs.group[n, 1] = ga, gb
        pairs.normal[n, :], pairs.gap[n], pairs.state[n] = 0.0, 0.0, OPEN
        pairs.beside[n], pairs.lean[n] = -1, 0.0
