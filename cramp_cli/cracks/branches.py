"""Branches: the pieces of cracks between junctions. Branches, not cracks, tell the sides.

At a junction the arms of one or several cracks meet in a point. Which of the sectors between them a
particle and a node lie in must not hang on how the deck writes the arms: one crack that bends and
another that ends there, or three that end. So cracks are cut at junctions, and two arms that meet
end to end are one branch (of which one may run against its crack). Without junctions every crack is
a branch, with the same number.

A line from a particle to a node that passes a junction of n arms on one side crosses some arms, on
the other side all the others: together a circle around the junction, which crosses nothing. Of both
sets of arms the smaller one tells the row (`reduce_crossed`).
"""

import numpy as np

from cramp_cli.numerics.kernel import inlined_kernel, kernel

NEAR = 4.0  # cells from a junction within which a line of a particle and its node may pass it
AT = 0.1  # hairs; a point that is nearer to a junction than this lies on it
TIE = 1e-6  # rad by which a sector must be wider to be the widest


@kernel
def number_branches(segments, paths, count, hair):
    """Fill in branches, junctions and their arms; a hair beside them (m) lies what lies on them."""
    joint, start, n = paths.joint, paths.start, 0
    cracks = len(start) - 1
    free, junctions = cracks, 0
    for c in range(cracks):
        current = c
        for k in range(start[c], start[c + 1] - 1):
            if k > start[c] and joint[k] >= 0:
                current, free = free, free + 1
            segments.branch[n], segments.turn[n] = current, 1
            segments.joint[n, 0], segments.joint[n, 1] = joint[k], joint[k + 1]
            junctions = max(junctions, joint[k] + 1, joint[k + 1] + 1)
            n += 1
    segments.used[3] = junctions
    if junctions:
        _list_arms(segments, count, junctions)
    for j in range(junctions):
        if segments.first_arm[j + 1] - segments.first_arm[j] == 2:
            _make_one(segments, count, j)
    for j in range(junctions):
        _find_down(segments, j, hair)
    for c in range(cracks):
        segments.of_end[2 * c] = segments.branch[start[c] - c]
        segments.of_end[2 * c + 1] = segments.branch[start[c + 1] - 2 - c]


@kernel
def _list_arms(segments, count, junctions):
    """Sort the arms by their junctions, ascending."""
    first, joint = segments.first_arm, segments.joint
    first[: junctions + 1] = 0
    for s in range(count):
        for end in range(2):
            if joint[s, end] >= 0:
                first[joint[s, end]] += 1
    for j in range(1, junctions + 1):
        first[j] += first[j - 1]
    for s in range(count - 1, -1, -1):
        for end in range(1, -1, -1):
            if joint[s, end] >= 0:
                first[joint[s, end]] -= 1
                segments.arms[first[joint[s, end]]] = 2 * s + end


@kernel
def _make_one(segments, count, j):
    """Make one branch, the lower one, of both arms of a junction."""
    branch, turn, arm = segments.branch, segments.turn, segments.first_arm[j]
    s, t = segments.arms[arm] // 2, segments.arms[arm + 1] // 2
    if branch[s] > branch[t]:
        s, t = t, s
    kept, gone = branch[s], branch[t]
    against = segments.arms[arm] % 2 == segments.arms[arm + 1] % 2  # both begin or both end here
    over = turn[s] * turn[t] * (-1 if against else 1)
    for u in range(count):
        if kept != gone and branch[u] == gone:
            branch[u], turn[u] = kept, over * turn[u]


@inlined_kernel
def out_of_joint(segments, arm):
    """Return the unit vector along an arm, away from its junction; arm: 2 * segment + end."""
    ends, s, sign = segments.ends, arm // 2, 1.0 - 2.0 * (arm % 2)
    dx, dy = sign * (ends[s, 2] - ends[s, 0]), sign * (ends[s, 3] - ends[s, 1])
    size = np.hypot(dx, dy)
    return dx / size, dy / size


@inlined_kernel
def left_of_arm(segments, arm):
    """Return the side of its branch that lies left of an arm, looking away from the junction."""
    return segments.turn[arm // 2] * (1 - 2 * (arm % 2))


@kernel
def _find_down(segments, j, hair):
    """Set the place beside a junction where what lies on it is taken to lie, the same for all arms.

    Below a branch that goes through; else in the widest sector.
    """
    first, last = segments.first_arm[j], segments.first_arm[j + 1]
    best, way = -1.0, (0.0, 0.0)
    for i in range(first, last):
        ax, ay = out_of_joint(segments, segments.arms[i])
        gap = 2.0 * np.pi
        for k in range(first, last):
            bx, by = out_of_joint(segments, segments.arms[k])
            angle = np.arctan2(ax * by - ay * bx, ax * bx + ay * by)
            angle += 2.0 * np.pi if angle <= 0.0 else 0.0
            if k != i and angle < gap:
                gap = angle
        below = last - first == 2 and left_of_arm(segments, segments.arms[i]) < 0
        if gap > best + TIE or below:
            c, s = np.cos(0.5 * gap), np.sin(0.5 * gap)
            best, way = np.inf if below else gap, (c * ax - s * ay, s * ax + c * ay)
    for i in range(first, last):
        s, end = segments.arms[i] // 2, segments.arms[i] % 2
        segments.down[s, 2 * end] = hair * way[0]
        segments.down[s, 2 * end + 1] = hair * way[1]


@inlined_kernel
def off_joint(segments, x, y, hair):
    """Return a point moved a hair (m) into a sector of the junction on which it lies, if any."""
    ends, down = segments.ends, segments.down
    for j in range(segments.used[3]):
        arm = segments.arms[segments.first_arm[j]]
        s, end = arm // 2, arm % 2
        jx, jy = ends[s, 2 * end], ends[s, 2 * end + 1]
        if max(abs(x - jx), abs(y - jy)) < AT * hair:
            return jx + down[s, 2 * end], jy + down[s, 2 * end + 1]
    return x, y


@kernel
def reduce_crossed(segments, count, nx, ny, near):
    """Tell what a line to a node crosses by the smaller set of arms around junctions that are near.

    found: branch, side and segment of `count` crossings; near: distance from a node (m)

    returns: the number of crossings then, their branches ascending
    """
    ends = segments.ends
    for j in range(segments.used[3]):
        arm = segments.arms[segments.first_arm[j]]
        s, end = arm // 2, arm % 2
        if max(abs(ends[s, 2 * end] - nx), abs(ends[s, 2 * end + 1] - ny)) < near:
            count = _reduce_around(segments, count, j)
    return count


@kernel
def _reduce_around(segments, count, j):
    """Replace the arms of a junction that are crossed by the others, if these are fewer."""
    found, arms, branch = segments.found, segments.arms, segments.branch
    first, last = segments.first_arm[j], segments.first_arm[j + 1]
    crossed, sense, lowest, has_lowest = 0, 0, branch[arms[first] // 2], False
    for a in range(first, last):
        lowest = min(lowest, branch[arms[a] // 2])
    for a in range(first, last):
        for i in range(count):
            if found[i, 0] == branch[arms[a] // 2]:
                crossed += 1
                sense = found[i, 1] * left_of_arm(segments, arms[a])
                has_lowest = has_lowest or found[i, 0] == lowest
    others = last - first - crossed
    if last - first < 3 or crossed < others or (crossed == others and has_lowest):
        return count
    for a in range(first, last):
        count = _switch(segments, count, arms[a], -sense)
    return count


@kernel
def _switch(segments, count, arm, sense):
    """Take an arm out of what is found if it is there, put it in if it is not."""
    found, branch = segments.found, segments.branch[arm // 2]
    for i in range(count):
        if found[i, 0] == branch:
            for k in range(i, count - 1):
                found[k, 0], found[k, 1], found[k, 2] = (
                    found[k + 1, 0],
                    found[k + 1, 1],
                    found[k + 1, 2],
                )
            return count - 1
    return add_crossing(found, count, branch, sense * left_of_arm(segments, arm), arm // 2)


@inlined_kernel
def add_crossing(found, count, branch, side, s):
    """Add a crossing to those found, their branches ascending; return how many there are then."""
    if count == len(found):
        return count
    i = count
    while i > 0 and found[i - 1, 0] > branch:
        found[i, 0], found[i, 1], found[i, 2] = found[i - 1, 0], found[i - 1, 1], found[i - 1, 2]
        i -= 1
    found[i, 0], found[i, 1], found[i, 2] = branch, side, s
    return count + 1
