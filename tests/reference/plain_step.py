"""The time step once more: plain loops over particles and nodes, written from the theory.

It follows the papers (Nairn 2003; Bardenhagen and Kober 2004; Guo and Nairn 2004) with the
answers to ties of cracks/crossing.py, and shares no formula with the package: it is slow, and meant
to be read. Plane problems, linear or GIMP functions, FLIP, cracks with sharp tips and contact, held
edges, forces on particles, gravity and damping.
"""

from dataclasses import dataclass, field
from itertools import product
from math import atan, copysign, cos, floor, hypot, sin

AXES = (0, 1)
ON_CRACK = 1e-9  # cells


@dataclass
class Particle:
    """x, X: place now and at first; v, a: velocity, acceleration; m: mass; V: volume at first."""

    x: list
    v: list
    m: float
    V: float
    a: list = field(default_factory=lambda: [0.0, 0.0])
    F: list = field(default_factory=lambda: [[1.0, 0.0], [0.0, 1.0]])
    L: list = field(default_factory=lambda: [[0.0, 0.0], [0.0, 0.0]])
    stretch: float = 1.0
    stress: list = field(default_factory=lambda: [0.0] * 4)  # xx, yy, zz, xy
    work: float = 0.0
    pull: list = field(default_factory=lambda: [0.0, 0.0])  # force on it

    def __post_init__(self):
        self.X = list(self.x)


@dataclass
class Row:
    """Sums of the particles that reach a node across the same cracks from the same sides."""

    node: tuple
    crossed: tuple  # of (crack, side)
    m: float = 0.0
    p: list = field(default_factory=lambda: [0.0, 0.0])
    saved: list = field(default_factory=lambda: [0.0, 0.0])
    f: list = field(default_factory=lambda: [0.0, 0.0])
    moved: list = field(default_factory=lambda: [0.0, 0.0])  # sum S m (x - X)
    place: list = field(default_factory=lambda: [0.0, 0.0])  # sum S m x
    first: list = None  # place at the start of the step
    turn: list = field(default_factory=lambda: [0.0, 0.0])  # sum S m (F_xx + F_yy, F_yx - F_xy)
    met: dict = field(default_factory=dict)  # crack: what contact across it has done in this step
    normals: dict = field(default_factory=dict)  # crack: sum of crossed pieces, turned to below
    v: list = None  # p/m
    a: list = None  # f/m


@dataclass
class Crack:
    """Points of the plane and of both surfaces; `edges` says which ends go on into free space."""

    plane: list
    edges: tuple
    law: str
    mu: float = 0.0
    mu_static: float = 0.0

    def __post_init__(self):
        self.above, self.below = ([list(x) for x in self.plane] for _ in AXES)
        self.above_v, self.below_v = ([[0.0, 0.0] for _ in self.plane] for _ in AXES)

    def pieces(self):
        """Straight pieces, those at an edge made five times as long."""
        points = [list(x) for x in self.plane]
        for end, here, there in ((0, 0, 1), (1, -1, -2)):
            if self.edges[end]:
                a, b = self.plane[here], self.plane[there]
                points[here] = [a[d] + 4.0 * (a[d] - b[d]) for d in AXES]
        return list(zip(points, points[1:], strict=False))


@dataclass
class Hold:
    """Velocity along `axis` of nodes at `at` on axis `plane`, within `span` on the other axis."""

    plane: int
    at: float
    span: tuple
    axis: int
    speed: float


@dataclass
class Problem:
    """Everything a step needs."""

    particles: list
    cracks: list
    holds: list
    h: float  # cell width
    lower: tuple  # corner of the grid
    half: float  # half size of a particle, 0 for linear functions
    lame: float
    shear: float
    plane_stress: bool
    dt: float
    shares: tuple  # of strain before the forces and after the motion
    again: bool  # second sum of momenta
    gravity: tuple
    damping: tuple  # of grid and particle velocity
    pieces: list = None  # of the cracks, at the start of the step
    friction: float = 0.0
    impact: float = 0.0
    reaction: list = field(default_factory=lambda: [0.0, 0.0])


# Shape functions along one axis --------------------------------------------------


def S(r, h, l):  # noqa: E741 - the letter of the paper
    a = abs(r)
    if l > 0.0 and a < l:
        return 1.0 - (a * a + l * l) / (2.0 * h * l)
    if a <= h - l:
        return 1.0 - a / h
    return (h + l - a) ** 2 / (4.0 * h * l) if a < h + l else 0.0


def dS(r, h, l):  # noqa: E741
    a, s = abs(r), copysign(1.0, r)
    if l > 0.0 and a < l:
        return -r / (h * l)
    if a <= h - l:
        return -s / h
    return -s * (h + l - a) / (2.0 * h * l) if a < h + l else 0.0


def nodes_along(x, half, h, low):
    """Two nodes around a point, three around a box."""
    first = floor((x - half - low) / h)
    return range(first, first + (3 if half else 2))


# Cracks --------------------------------------------------------------------------


def area(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def crosses(piece, p, n, h):
    """Side of p (+1 above, -1 below) if the way p -> n crosses the piece, else 0."""
    a, b = piece
    for d in AXES:  # nowhere near each other
        if (
            max(p[d], n[d]) < min(a[d], b[d]) - 0.1 * h
            or min(p[d], n[d]) > max(a[d], b[d]) + 0.1 * h
        ):
            return 0
    near = ON_CRACK * h * (abs(b[0] - a[0]) + abs(b[1] - a[1]))
    p_above, n_above = area(a, b, p) > near, area(a, b, n) > near
    if p_above == n_above or (area(n, p, a) >= 0.0) == (area(n, p, b) >= 0.0):
        return 0
    return 1 if p_above else -1


def crossed(problem, p, n):
    """Cracks between p and n: {crack: (side of p, crossed piece)}."""
    found = {}
    for c, pieces in enumerate(problem.pieces):
        hits = [(side, piece) for piece in pieces if (side := crosses(piece, p, n, problem.h))]
        if len(hits) % 2:
            found[c] = hits[0]
    return found


class Grid:
    """Rows by node and crossed cracks, and what every particle sees."""

    def __init__(self, problem):
        self.rows, self.at, self.seen = {}, {}, []  # by node and cracks; by node; of every particle
        h, lower = problem.h, problem.lower
        for q in problem.particles:
            sees = []
            axes = [nodes_along(q.x[d], problem.half, h, lower[d]) for d in AXES]
            for j, i in product(axes[1], axes[0]):
                n = (lower[0] + i * h, lower[1] + j * h)
                r = (q.x[0] - n[0], q.x[1] - n[1])
                sx, sy = (S(r[d], h, problem.half) for d in AXES)
                gx, gy = (dS(r[d], h, problem.half) for d in AXES)
                if sx * sy == 0.0 and gx * sy == 0.0 and sx * gy == 0.0:
                    continue
                row = self.row_for((i, j), crossed(problem, q.x, n))
                sees.append((sx * sy, (gx * sy, sx * gy), row))
            self.seen.append(sees)

    def row_for(self, node, crossings):
        key = tuple((c, side) for c, (side, _) in sorted(crossings.items()))
        assert len(key) <= 2, "the package knows two cracks between a particle and a node"
        if (node, key) not in self.rows:
            for other in self.at.setdefault(node, []):
                assert not any((c, -side) in other.crossed for c, side in key), "mixed-up sides"
            self.rows[node, key] = Row(node, key)
            self.at[node].append(self.rows[node, key])
        row = self.rows[node, key]
        for c, (_, (a, b)) in crossings.items():
            sum_ = row.normals.setdefault(c, [0.0, 0.0])
            sum_[0] += b[1] - a[1]
            sum_[1] += a[0] - b[0]
        return row

    def rows_at(self, node):
        """Rows of a node: its own, those across one crack, those across two."""
        return sorted(self.at.get(node, []), key=lambda row: (len(row.crossed), row.crossed))

    def shared(self):
        """Nodes with more than their own row."""
        return sorted({node for node, key in self.rows if key}, key=lambda n: (n[1], n[0]))

    def sum_openings(self, problem):
        for row in self.rows.values():
            row.moved, row.place, row.turn = ([0.0, 0.0] for _ in range(3))
        for q, sees in zip(problem.particles, self.seen, strict=True):
            for s, _, row in sees:
                for d in AXES:
                    row.moved[d] += s * q.m * (q.x[d] - q.X[d])
                    row.place[d] += s * q.m * q.x[d]
                row.turn[0] += s * q.m * (q.F[0][0] + q.F[1][1])
                row.turn[1] += s * q.m * (q.F[1][0] - q.F[0][1])

    def sum_momenta(self, problem):
        for row in self.rows.values():
            row.p = [0.0, 0.0]
        for q, sees in zip(problem.particles, self.seen, strict=True):
            for s, _, row in sees:
                for d in AXES:
                    row.p[d] += s * q.m * q.v[d]

    def sum_forces(self, problem):
        for row in self.rows.values():
            row.f = [problem.gravity[d] * row.m for d in AXES]
        for q, sees in zip(problem.particles, self.seen, strict=True):
            xx, yy, _, xy = q.stress
            for s, (gx, gy), row in sees:
                row.f[0] += s * q.pull[0] - q.V * (xx * gx + xy * gy)
                row.f[1] += s * q.pull[1] - q.V * (xy * gx + yy * gy)

    def divide_by_mass(self):
        """Velocity and acceleration; a row without mass has none."""
        for row in self.rows.values():
            over = 1.0 / row.m if row.m > 0.0 else 0.0
            row.v, row.a = ([x * over for x in sums] for sums in (row.p, row.f))


# Contact -------------------------------------------------------------------------


def touch(problem, grid, when):
    """Pass A (first), B (update) or C (last) over all pairs of rows that differ by one crack."""
    for row, c, a, b in pairs_of(grid):
        touch_pair(problem, problem.cracks[c], a, b, row.normals[c], when, row.met[c])


def pairs_of(grid):
    """Rows a above and b below crack c, with the row that knows it."""
    for node in grid.shared():
        for row in grid.rows_at(node):
            for c, side in row.crossed:
                rest = tuple(one for one in row.crossed if one[0] != c)
                partner = grid.rows.get((node, rest))
                if partner is None or row.m <= 0.0 or partner.m <= 0.0:
                    continue
                yield row, c, *((row, partner) if side > 0 else (partner, row))


def note(grid, name):
    """Keep the relative velocity of all pairs at start or end, or the force that pushes them."""
    for row, c, a, b in pairs_of(grid):
        kept = row.met.setdefault(c, {"halted": [0.0, 0.0]})
        if name == "pushed":
            kept[name] = [(a.m * b.f[d] - b.m * a.f[d]) / (a.m + b.m) for d in AXES]
        else:
            kept[name] = [b.p[d] / b.m - a.p[d] / a.m for d in AXES]


def opened(a, b):
    """How far b is apart from a: the mean of both rotations is taken off. And what is nothing."""
    moved = [b.moved[d] / b.m - a.moved[d] / a.m for d in AXES]
    X, Y = (b.place[d] / b.m - a.place[d] / a.m - moved[d] for d in AXES)
    sizes = [hypot(*row.turn) for row in (a, b)]
    c, s = (0.5 * (a.turn[d] / sizes[0] + b.turn[d] / sizes[1]) for d in AXES)
    return [moved[0] - (c - 1.0) * X + s * Y, moved[1] - s * X - (c - 1.0) * Y], 1e-9 * hypot(X, Y)


def touch_pair(problem, crack, a, b, normal, when, met):
    dt = problem.dt
    n = [component / hypot(*normal) for component in normal]
    total = a.m + b.m
    dp = [(a.m * b.p[d] - b.m * a.p[d]) / total for d in AXES]
    dpn = dp[0] * n[0] + dp[1] * n[1]
    apart, flush = opened(a, b)
    gap = sum(x * n[d] for d, x in enumerate(apart)) - flush
    if when == "update":
        felt = 0.5 * dt * min(min(a.m, b.m) / total / 0.05, 1.0)
        ahead = [(r.saved[d] + felt * r.f[d]) / r.m for r in (a, b) for d in AXES]
        gap += dt * sum((ahead[2 + d] - ahead[d]) * n[d] for d in AXES)
    fast = [b.p[d] / b.m - a.p[d] / a.m for d in AXES]
    along = [dp[d] - dpn * n[d] for d in AXES]
    slip = hypot(*along)
    if crack.law == "ignore":
        return
    given = dp
    if crack.law != "glued" and not (gap < 0.0 and dpn < 0.0):
        given = [0.0, 0.0]
    elif crack.law == "frictional" and slip > crack.mu_static * -dpn:
        given = [dpn * n[d] + crack.mu * -dpn * along[d] / slip for d in AXES]
    for row, sign in ((a, 1.0), (b, -1.0)):
        for d in AXES:
            row.p[d] += sign * given[d]
            if when == "first":
                row.saved[d] = row.p[d]
            elif when == "update":
                row.f[d] += sign * given[d] / dt
    slow = [b.p[d] / b.m - a.p[d] / a.m for d in AXES]
    if when == "update":
        met["given"] = given
    else:
        met["halted"] = [met["halted"][d] + fast[d] - slow[d] for d in AXES]
    if when == ("last" if problem.again else "update") and min(a.m, b.m) >= 1e-4 * total:
        book(problem, crack, met, met["end"] if problem.again else slow, n)


def book(problem, crack, met, end, n):
    """Work of what was given on the mean velocity, less that of the forces on what was halted.

    Without second sums the strain feels what the update has left.
    """
    given, pushed = met["given"], [x * problem.dt for x in met["pushed"]]
    if not problem.again:
        pushed = given
    along, across = 0.0, 0.0
    normal = [
        sum(x[d] * n[d] for d in AXES) for x in (given, met["start"], end, pushed, met["halted"])
    ]
    across = normal[0] * 0.5 * (normal[1] + normal[2]) - normal[3] * 0.5 * normal[4]
    for d in AXES:
        along += given[d] * 0.5 * (met["start"][d] + end[d]) - pushed[d] * 0.5 * met["halted"][d]
    if crack.law == "frictional":
        problem.friction += along - across
        problem.impact += across
    else:
        problem.impact += along


# Held edges --------------------------------------------------------------------


def held_rows(problem, grid, hold):
    """Rows of nodes on the plane; where a crack meets it, those whose particles lie in the span."""
    h, low, other = problem.h, problem.lower, 1 - hold.plane
    shared = set(grid.shared())
    for row in grid.rows.values():
        x = [low[d] + row.node[d] * h for d in AXES]
        if abs(x[hold.plane] - hold.at) > 1e-6 * h:
            continue
        if row.node in shared:
            inside = row.m > 0.0 and hold.span[0] <= row.first[other] / row.m <= hold.span[1]
        else:
            inside = hold.span[0] - 1e-6 * h <= x[other] <= hold.span[1] + 1e-6 * h
        if inside:
            yield row


def hold_momenta(problem, grid):
    for hold in problem.holds:
        for row in held_rows(problem, grid, hold):
            row.p[hold.axis] = row.m * hold.speed


def hold_forces(problem, grid):
    """Forces that make p + f dt = m v."""
    for hold in problem.holds:
        d = hold.axis
        for row in held_rows(problem, grid, hold):
            if row.m > 0.0:
                wanted = (row.m * hold.speed - row.p[d]) / problem.dt
                problem.reaction[d] += wanted - row.f[d]
                row.f[d] = wanted


def hold_again(problem, grid):
    for hold in problem.holds:
        d = hold.axis
        for row in held_rows(problem, grid, hold):
            change = row.m * hold.speed - row.p[d]
            row.p[d] += change
            row.f[d] += change / problem.dt
            problem.reaction[d] += change / problem.dt


# Strain and stress -------------------------------------------------------------


def strain(problem, grid, share):
    grid.divide_by_mass()
    for q, sees in zip(problem.particles, grid.seen, strict=True):
        L = [[0.0, 0.0], [0.0, 0.0]]
        for _, (gx, gy), row in sees:
            for i in AXES:
                L[i][0] += row.v[i] * gx
                L[i][1] += row.v[i] * gy
        U = [[L[i][j] * share * problem.dt for j in AXES] for i in AXES]
        stress_step(problem, q, U)
        dF = [
            [float(i == j) + U[i][j] + 0.5 * sum(U[i][k] * U[k][j] for k in AXES) for j in AXES]
            for i in AXES
        ]
        q.F = [[sum(dF[i][k] * q.F[k][j] for k in AXES) for j in AXES] for i in AXES]
        for i, j in product(AXES, AXES):
            q.L[i][j] = L[i][j]


def stress_step(problem, q, U):
    """Turn the stress by the spin, then add Hooke's stress of the strain."""
    angle = 2.0 * atan(0.25 * (U[1][0] - U[0][1]))
    c, s = cos(angle), sin(angle)
    xx, yy, zz, xy = q.stress
    before = [
        c * c * xx + s * s * yy - 2.0 * c * s * xy,
        s * s * xx + c * c * yy + 2.0 * c * s * xy,
        zz,
        c * s * (xx - yy) + (c * c - s * s) * xy,
    ]
    exx, eyy, exy = U[0][0], U[1][1], 0.5 * (U[0][1] + U[1][0])
    lame, shear = problem.lame, problem.shear
    ezz = -lame / (lame + 2.0 * shear) * (exx + eyy) if problem.plane_stress else 0.0
    trace = exx + eyy + ezz
    strains = (exx, eyy, ezz, exy)
    for k, e in enumerate(strains):
        q.stress[k] = before[k] + 2.0 * shear * e + (lame * trace if k < 3 else 0.0)
    if problem.plane_stress:
        q.stress[2] = 0.0
    for k, times in enumerate((1.0, 1.0, 1.0, 2.0)):
        q.work += times * 0.5 * (before[k] + q.stress[k]) * strains[k]
    q.stretch *= 1.0 + ezz + 0.5 * ezz * ezz


# Motion ------------------------------------------------------------------


def move_particles(problem, grid):
    grid.divide_by_mass()
    dt, (ag, ap) = problem.dt, problem.damping
    for q, sees in zip(problem.particles, grid.seen, strict=True):
        for d in AXES:
            v = sum(s * row.v[d] for s, _, row in sees)
            a = sum(s * row.a[d] for s, _, row in sees)
            vm = v - a * dt
            dv = (a - ag * vm - ap * q.v[d]) * dt
            q.x[d] += dt * (vm + 0.5 * dv)
            q.v[d] += dv
            q.a[d] = a


def move_cracks(problem, grid):
    """All surfaces with the rows of their side, planes with the mean of both; then all at once."""
    steps = []
    for c, crack in enumerate(problem.cracks):
        for k in range(len(crack.plane)):
            up = surface_step(problem, grid, c, k, +1)
            down = surface_step(problem, grid, c, k, -1)
            steps.append((crack, k, up or down or [0.0, 0.0], down or up or [0.0, 0.0]))
    for crack, k, up, down in steps:
        for d in AXES:
            crack.above[k][d] += up[d]
            crack.below[k][d] += down[d]
            crack.plane[k][d] += 0.5 * (up[d] + down[d])


def surface_step(problem, grid, c, k, side):
    """Way of a surface point in this step, None where it sees no solid."""
    crack, h, low, dt = problem.cracks[c], problem.h, problem.lower, problem.dt
    x = (crack.above if side > 0 else crack.below)[k]
    old = (crack.above_v if side > 0 else crack.below_v)[k]
    i, j = crack.plane[max(k - 1, 0)], crack.plane[min(k + 1, len(crack.plane) - 1)]
    length = hypot(j[0] - i[0], j[1] - i[1])
    off = side * 1e-4 * h / length
    q = (crack.plane[k][0] - off * (j[1] - i[1]), crack.plane[k][1] + off * (j[0] - i[0]))
    cell = [floor((x[d] - low[d]) / h) for d in AXES]
    seen = []  # row, weight, mass
    for node in product(*((first, first + 1) for first in cell)):
        row = surface_row(problem, grid, c, side, node, q)
        if row is None or row.m <= 0.0:
            continue
        w = row.m
        for d in AXES:
            w *= 1.0 - abs((x[d] - low[d]) / h - node[d])
        seen.append((row, w))
    mass = sum(w for _, w in seen)
    if mass <= 0.0:
        old[:] = [0.0, 0.0]
        return None
    at = [(x[d] - low[d]) / h for d in AXES]
    v, a = (carried(at, seen, name) for name in "va")
    step = [dt * (1.5 * v[d] - 0.5 * old[d] - a[d] * dt) for d in AXES]
    old[:] = v
    return step


def carried(at, seen, name):
    """Mean of a field over rows, carried on to a place (cells) with the spin of the rows."""
    mass, total = sum(w for _, w in seen), sum(row.m for row, _ in seen)
    mean, place, middle = ([0.0, 0.0] for _ in range(3))
    for row, w in seen:
        for d in AXES:
            mean[d] += w / mass * getattr(row, name)[d]
            place[d] += w / mass * row.node[d]
            middle[d] += row.m / total * row.node[d]
    turn, inertia = 0.0, 0.0
    for row, _ in seen:
        r, u = [row.node[d] - middle[d] for d in AXES], getattr(row, name)
        turn += row.m * (r[0] * u[1] - r[1] * u[0])
        inertia += row.m * (r[0] ** 2 + r[1] ** 2)
    spin = turn / inertia if inertia > 1e-9 * total else 0.0
    return [mean[0] - spin * (at[1] - place[1]), mean[1] + spin * (at[0] - place[0])]


def surface_row(problem, grid, c, side, node, q):
    """Row of a node on one side of crack c, seen from q just off that side.

    Where rows of the node are told by this crack, that of the side, else the one without it; other
    nodes by the way from q. Another crack between q and the node counts in both.
    """
    n = tuple(problem.lower[d] + node[d] * problem.h for d in AXES)
    between = {crack: side_ for crack, (side_, _) in crossed(problem, q, n).items()}
    others = {crack: side_ for crack, side_ in between.items() if crack != c}
    if any(c == crack for row in grid.rows_at(node) for crack, _ in row.crossed):
        mine = grid.rows.get((node, tuple(sorted((others | {c: side}).items()))))
        return mine or grid.rows.get((node, tuple(sorted(others.items()))))
    return grid.rows.get((node, tuple(sorted(between.items()))))


# The step ----------------------------------------------------------------------


def plain_step(problem):
    """Advance the problem by one time step."""
    before, after = problem.shares
    problem.reaction = [0.0, 0.0]
    problem.pieces = [crack.pieces() for crack in problem.cracks]
    grid = Grid(problem)
    for q, sees in zip(problem.particles, grid.seen, strict=True):
        for s, _, row in sees:
            row.m += s * q.m
    rows = grid.rows.values()
    grid.sum_openings(problem)
    grid.sum_momenta(problem)
    for row in rows:
        row.saved = list(row.p)
    for row in rows:
        row.first = list(row.place)  # held rows are found once a step
    note(grid, "start")
    touch(problem, grid, "first")
    if before:
        hold_momenta(problem, grid)
        strain(problem, grid, before)
    for row in rows:
        row.p = list(row.saved)
    grid.sum_forces(problem)
    note(grid, "pushed")
    hold_forces(problem, grid)
    for row in rows:
        row.p = [row.p[d] + row.f[d] * problem.dt for d in AXES]
    touch(problem, grid, "update")
    hold_again(problem, grid)
    move_particles(problem, grid)
    move_cracks(problem, grid)
    if problem.again:
        grid.sum_openings(problem)
        grid.sum_momenta(problem)
        note(grid, "end")
        touch(problem, grid, "last")
        hold_momenta(problem, grid)
    if after:
        strain(problem, grid, after)
