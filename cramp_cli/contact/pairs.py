"""Pairs of rows of different bodies at a node: who may touch whom, along which normal."""

from math import sqrt
from typing import NamedTuple

import numpy as np

from cramp_cli.contact.gradient import average_gradient, larger_gradient
from cramp_cli.contact.laws import AVERAGE, LARGER
from cramp_cli.contact.logistic import logistic_normal
from cramp_cli.contact.separation import separation
from cramp_cli.cracks.contact import GLUED, IGNORE, OPEN
from cramp_cli.numerics.kernel import kernel


class Pairs(NamedTuple):
    """Rows a and b of one node that belong to different contact groups."""

    row: np.ndarray  # (pairs, 2) rows a and b
    group: np.ndarray  # (pairs, 2) their contact groups
    node: np.ndarray  # (pairs,)
    normal: np.ndarray  # (pairs, dim) unit vector from a to b
    gap: np.ndarray  # (pairs,) negative where the bodies overlap (m)
    state: np.ndarray  # (pairs,) OPEN, SLIDING or STUCK
    used: np.ndarray  # (1,) pairs in use, or wanted if there are more


def make_pairs(count: int, dim: int) -> Pairs:
    """Return room for a number of pairs."""
    return Pairs(
        row=np.zeros((count, 2), dtype=np.int64),
        group=np.zeros((count, 2), dtype=np.int64),
        node=np.zeros(count, dtype=np.int64),
        normal=np.zeros((count, dim)),
        gap=np.zeros(count),
        state=np.zeros(count, dtype=np.int64),
        used=np.zeros(1, dtype=np.int64),
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


@kernel
def find_normals(pairs, clouds, stencil, particles, half, laws, kind, flat, lattice, strides):
    """Find normal and separation of all pairs; a pair without a normal is left apart.

    kind: of normal; flat: (nodes, dim) 1 along the normals of symmetry planes through a node, along
    which no normal points; lattice: lower corner (m) and width
    """
    lower, width = lattice
    for i in range(pairs.used[0]):
        if laws.kind[pairs.group[i, 0], pairs.group[i, 1]] == GLUED:
            continue
        node, a, b = pairs.node[i], pairs.row[i, 0], pairs.row[i, 1]
        place = (
            lower[0] + width * (node % strides[1]),
            lower[1] + width * (node // strides[1]),
        )
        if kind == AVERAGE:
            nx, ny = average_gradient(clouds, a, b, strides)
        elif kind == LARGER:
            nx, ny = larger_gradient(clouds, a, b, strides)
        else:
            rows = (a, b)
            nx, ny = logistic_normal(clouds, stencil, particles.position, rows, place, width)
        nx, ny = nx * (1 - flat[node, 0]), ny * (1 - flat[node, 1])
        size = sqrt(nx * nx + ny * ny)
        if not size > 0.0:
            pairs.gap[i] = width
            continue
        nx, ny = nx / size, ny / size
        pairs.normal[i, 0], pairs.normal[i, 1] = nx, ny
        pairs.gap[i] = separation(clouds, stencil, particles, half, a, b, nx, ny)
