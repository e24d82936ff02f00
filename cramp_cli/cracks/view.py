"""What the surfaces of a crack see of the grid: the rows of their side, and how much each counts.

With these weights a surface moves (advect.py) and gives the stress on it to the rows (faces.py), so
that the stress works on the motion of the surface and on nothing else.

The rows of a side lie beside the crack, not on it: in a body that turns their mean moves otherwise
than the surface does. So it is carried on to the surface with their spin (carry.py).
"""

from math import inf
from typing import NamedTuple

import numpy as np

from cramp_cli.cracks.branches import off_joint
from cramp_cli.cracks.carry import carry_on
from cramp_cli.cracks.crossing import crossed_cracks
from cramp_cli.cracks.lines import NO_CRACK, of_group
from cramp_cli.cracks.rows import find_row, row_on_side, row_told
from cramp_cli.cracks.segments import HAIR, ON_CRACK
from cramp_cli.numerics.kernel import inlined_kernel, kernel
from cramp_cli.numerics.vector import dot

ALONG = 1e-2  # at a junction it looks from this far along its crack (cells)
OFF_PLANE = 1e-4  # a surface looks at the nodes from this distance off the plane (cells)
LIGHT = 0.1  # rows of less than this share of the heaviest one around count less in even weights


class Seen(NamedTuple):
    """What the point of a surface sees: room for two rows of each of the four nodes around it."""

    row: np.ndarray  # (8,)
    weight: np.ndarray  # (8,) what the row counts, in the end a share of 1
    mass: np.ndarray  # (8,) what it is weighed by (kg), in the end what it counts for the spin
    share: np.ndarray  # (8,) of the side in the motion of the surface, below 1 beside smooth tips
    arm: np.ndarray  # (8, 2) its node, in the end seen from the middle of all (cells)
    lever: np.ndarray  # (2,) from the mean place of the rows to the surface, over the inertia


def make_seen() -> Seen:
    """Return room for what a point sees."""
    row, numbers = np.zeros(8, dtype=np.int64), (np.zeros(8) for _ in range(3))
    return Seen(row, *numbers, np.zeros((8, 2)), np.zeros(2))


@kernel
def side_normal(point, k, first, last):
    """Return the unit normal at crack point k that points above."""
    i, j = max(k - 1, first), min(k + 1, last)
    dx, dy = point[j, 0] - point[i, 0], point[j, 1] - point[i, 1]
    size = np.sqrt(dx * dx + dy * dy)
    return (-dy / size, dx / size) if size > 0.0 else (0.0, 0.0)


@kernel
def look_from(seen, even, paths, k, crack, side, normal, cut, mass, solid, place):
    """Find the rows that a surface (+1 above, -1 below) of point k of a crack sees.

    even: rows count by their linear functions, as a stress on a surface wants it, light rows less;
    else by their masses as well
    cut: share of the crack at the point, as of a particle there (tip_nodes.py)
    solid: rows, segments, contact group of every crack; place: cells, width, lower, strides

    returns: the number of rows and the sum of their weights before they were made shares of 1
    """
    rows, segments, of_crack = solid
    cells, width, lower, strides = place
    surface = paths.above if side > 0 else paths.below
    qx, qy = place_of_surface(paths, k, crack, side, normal, width)
    s = min(k, paths.start[crack + 1] - 2) - crack
    branch, upper = segments.branch[s], side * segments.turn[s]
    cell = dot(cell_of(qx, qy, place), strides)
    i0, j0 = cell_of(surface[k, 0], surface[k, 1], place)
    rx, ry = (surface[k, 0] - lower[0]) / width, (surface[k, 1] - lower[1]) / width
    alone = is_one_branch(segments, cell)
    count, heaviest = 0, 0.0
    for j in range(j0, j0 + 2):
        for i in range(i0, i0 + 2):
            node, n = dot((i, j), strides), (lower[0] + width * i, lower[1] + width * j)
            crossed = NO_CRACK
            if not alone or not is_told_by(rows, node, branch):  # else it is this branch or none
                n = off_joint(segments, n[0], n[1], HAIR * width)
                crossed = crossed_cracks(segments, cell, qx, qy, n[0], n[1], ON_CRACK * width)
                crossed = of_group(segments, crossed, of_crack, of_crack[crack])
            beside = rows.tip[node] // 2 == crack
            group = of_crack[crack]
            mine, facing = rows_of_surface(rows, crossed, group, branch, upper, node, beside)
            S = max(0.0, 1.0 - abs(rx - i)) * max(0.0, 1.0 - abs(ry - j))
            near = mass[mine] if mine >= 0 else 0.0
            far = mass[facing] if facing >= 0 else 0.0
            if near + far <= 0.0:
                continue
            # as a particle there: the share of the side, and of the mean of both sides
            own, felt = near / (near + far), near + (1.0 - cut) * far
            mean, sole = (1.0 - cut) * own, cut * min(own / LIGHT, 1.0)
            for row, share in ((mine, sole + mean), (facing, 1.0 - cut - mean)):
                if row >= 0 and share > 0.0 and mass[row] > 0.0:
                    m = mass[row] if even else felt
                    seen.row[count], seen.weight[count], seen.mass[count] = row, S * share, m
                    seen.share[count], seen.arm[count, 0], seen.arm[count, 1] = share, i, j
                    heaviest = max(heaviest, m)
                    count += 1
    total = weigh(seen, count, LIGHT * heaviest if even else inf)
    if total > 0.0:
        carry_on(seen, count, rx, ry)
    return count, total


@inlined_kernel
def place_of_surface(paths, k, crack, side, normal, width):
    """Return a place (m) just off point k of a crack, above (+1) or below (-1) it.

    At a junction a little along the crack: beside its end may be another arm, or what lies behind.
    """
    point, off = paths.point, side * OFF_PLANE * width
    x, y = point[k, 0] + off * normal[0], point[k, 1] + off * normal[1]
    if paths.joint[k] < 0:
        return x, y
    other = k + 1 if k < paths.start[crack + 1] - 1 else k - 1
    dx, dy = point[other, 0] - point[k, 0], point[other, 1] - point[k, 1]
    size = np.sqrt(dx * dx + dy * dy)
    return x + ALONG * width * dx / size, y + ALONG * width * dy / size


@inlined_kernel
def is_one_branch(segments, cell):
    """Return whether all segments about a cell are of one branch of a crack."""
    first = segments.head[cell]
    entry = first
    while entry >= 0:
        if segments.branch[segments.item[entry]] != segments.branch[segments.item[first]]:
            return False
        entry = segments.next[entry]
    return True


@inlined_kernel
def cell_of(x, y, place):
    """Return the cell of a point, or the nearest one: steps along both axes."""
    cells, width, lower, _ = place
    i, j = int(np.floor((x - lower[0]) / width)), int(np.floor((y - lower[1]) / width))
    return min(max(i, 0), cells[0] - 1), min(max(j, 0), cells[1] - 1)


@inlined_kernel
def rows_of_surface(rows, crossed, group, branch, side, node, beside_tip):
    """Return the rows of a node for one side of a branch and for the other, or -1.

    Where rows of the node are told by this branch they decide: the row of the side, else the one
    without the branch. Without such rows the cracks do that the line to the node has crossed.
    Beside a tip the side of the node is known, and a side that it does not see has no row; there
    only the other side counts as well.
    """
    a, side_a, _, b, side_b, _, _ = crossed
    if not beside_tip and not is_told_by(rows, node, branch):
        return find_row(rows, node, group, a, side_a, b, side_b), -1
    other, other_side = (b, side_b) if a == branch else (a, side_a)
    if not beside_tip:
        return row_on_side(rows, node, group, branch, side, other, other_side), -1
    node_side = rows.tip_side[node] * rows.tip_turn[node]
    own = find_row(rows, node, group, other, other_side, -1, 0)
    across = row_told(rows, node, group, branch, -node_side, other, other_side)
    return (own, across) if side == node_side else (across, own)


@inlined_kernel
def is_told_by(rows, node, branch):
    """Return whether a branch tells rows of a node."""
    nodes = len(rows.first)
    row = rows.first[node]
    while row >= 0:
        if rows.crack[row - nodes, 0] == branch or rows.crack[row - nodes, 1] == branch:
            return True
        row = rows.next[row - nodes]
    return False


@inlined_kernel
def weigh(seen, count, enough):
    """Weigh rows by mass up to what is `enough` (kg); by all of it if that is infinite.

    Sets the weights, as shares of 1, and what each row counts for the spin: the same wherever among
    the nodes the surface is.

    returns: the sum of the weights
    """
    total = 0.0
    for e in range(count):
        m = seen.mass[e] if enough == inf else min(seen.mass[e] / enough, 1.0)
        seen.weight[e] *= m
        seen.mass[e] = m * seen.share[e]
        total += seen.weight[e]
    for e in range(count):
        seen.weight[e] /= total if total > 0.0 else 1.0
    return total
