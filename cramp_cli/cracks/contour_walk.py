"""The way round a contour: the line integral of J, and what the way meets."""

from cramp_cli.cracks.contour_sums import place_in
from cramp_cli.cracks.crossing import box_around, crosses, double_area, reaches
from cramp_cli.cracks.rows import crossed_row
from cramp_cli.cracks.segments import HAIR, ON_CRACK
from cramp_cli.numerics.kernel import kernel
from cramp_cli.numerics.vector import dot


@kernel
def line_integral(sums, box, rows, segments, branch, lower, width, strides, full):
    """Return the line integrals of q_x and q_y, counter-clockwise, and what the way meets.

    sums: as of `sum_fields`; full: volume that a node within the body sees at least (m^3)

    returns: Jx, Jy; how often it crosses the crack and other cracks, nodes that several bodies see,
    nodes that see too little of one
    """
    nodes = len(rows.first)
    Jx, Jy, own, others, shared, empty = 0.0, 0.0, 0, 0, 0, 0
    for e in range(2 * (box.wide + box.high - 2)):
        here, there = corner(box, e), corner(box, e + 1)
        node, next_node = dot(here, strides), dot(there, strides)
        shared += rows.lowest[node] < rows.highest[node]
        empty += volume_around(sums, box, rows, here, node) < full
        a = means(sums, place_in(box, here[0], here[1], node, nodes))
        b = means(sums, place_in(box, there[0], there[1], next_node, nodes))
        normal = (there[1] - here[1], here[0] - there[0])
        count, f, foreign = cross_edge(segments, branch, here, there, lower, width)
        others += foreign
        if count % 2 == 0:
            q = trapezoid(width, normal, a, b)
            Jx, Jy = Jx + q[0], Jy + q[1]
            continue
        own += 1
        beyond = across(sums, box, rows, there, next_node, branch)
        first = trapezoid(f * width, normal, a, between(f, a, beyond))
        beyond = across(sums, box, rows, here, node, branch)
        second = trapezoid((1 - f) * width, normal, between(f, beyond, b), b)
        Jx, Jy = Jx + first[0] + second[0], Jy + first[1] + second[1]
    return Jx, Jy, own, others, shared, empty


@kernel
def corner(box, e):
    """Return node `e` of the contour, counter-clockwise from its lower left corner."""
    w, h = box.wide - 1, box.high - 1
    e %= 2 * (w + h)
    if e < w:
        return box.i + e, box.j
    if e < w + h:
        return box.i + w, box.j + e - w
    if e < 2 * w + h:
        return box.i + 2 * w + h - e, box.j + h
    return box.i, box.j + 2 * (w + h) - e


@kernel
def means(sums, place):
    """Return the means over all particles in a row; zero where nobody is."""
    m = sums[place, 0]
    s = 1.0 / m if m > 0.0 else 0.0
    gradient = (s * sums[place, 1], s * sums[place, 2], s * sums[place, 3], s * sums[place, 4])
    stress = (s * sums[place, 5], s * sums[place, 6], s * sums[place, 7])
    return gradient, stress, s * (sums[place, 8] + sums[place, 9])


@kernel
def across(sums, box, rows, at, node, branch):
    """Return the means on the other side of the crack at a node; zero where nobody is."""
    row = crossed_row(rows, node, branch)
    if row < 0:
        return (0.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 0.0
    return means(sums, place_in(box, at[0], at[1], row, len(rows.first)))


@kernel
def volume_around(sums, box, rows, at, node):
    """Return what all rows of a node see of the body (m^3)."""
    nodes = len(rows.first)
    volume, row = sums[place_in(box, at[0], at[1], node, nodes), 10], rows.first[node]
    while row >= 0:
        volume += sums[place_in(box, at[0], at[1], row, nodes), 10]
        row = rows.next[row - nodes]
    return volume


@kernel
def between(f, a, b):
    """Return the fields at share `f` of the way from those of a to those of b."""
    (axx, axy, ayx, ayy), (asx, asy, ast), aw = a
    (bxx, bxy, byx, byy), (bsx, bsy, bst), bw = b
    g = 1.0 - f
    gradient = (g * axx + f * bxx, g * axy + f * bxy, g * ayx + f * byx, g * ayy + f * byy)
    return gradient, (g * asx + f * bsx, g * asy + f * bsy, g * ast + f * bst), g * aw + f * bw


@kernel
def trapezoid(length, normal, a, b):
    """Return the integrals of q_x and q_y over a piece of the way with fields at both ends."""
    (ax, ay), (bx, by) = integrand(a, normal), integrand(b, normal)
    return 0.5 * length * (ax + bx), 0.5 * length * (ay + by)


@kernel
def integrand(fields, normal):
    """Return q_x and q_y from the fields at a point: (W + K) n - T . du/dx."""
    (uxx, uxy, uyx, uyy), (sxx, syy, sxy), energy = fields
    nx, ny = normal
    tx, ty = sxx * nx + sxy * ny, sxy * nx + syy * ny
    return energy * nx - (tx * uxx + ty * uyx), energy * ny - (tx * uxy + ty * uyy)


@kernel
def cross_edge(segments, branch, here, there, lower, width):
    """Return how often a crack crosses an edge, how far along the first time, and others do."""
    px, py = lower[0] + width * here[0], lower[1] + width * here[1]
    nx, ny = lower[0] + width * there[0], lower[1] + width * there[1]
    box, count, share, others = box_around(px, py, nx, ny, 4.0 * HAIR * width), 0, 0.0, 0
    for s in range(segments.used[0]):
        if not reaches(segments.real, s, box):
            continue
        if crosses(segments.real, segments.down, s, px, py, nx, ny, ON_CRACK * width) == 0:
            continue
        if segments.branch[s] != branch:
            others += 1
            continue
        share = share if count else share_along(segments.real, s, px, py, nx, ny)
        count += 1
    return count, share, others


@kernel
def share_along(ends, s, px, py, nx, ny):
    """Return where the line p -> n meets that of segment `s`, 0 at p and 1 at n."""
    here = double_area(ends[s, 0], ends[s, 1], ends[s, 2], ends[s, 3], px, py)
    there = double_area(ends[s, 0], ends[s, 1], ends[s, 2], ends[s, 3], nx, ny)
    return min(1.0, max(0.0, here / (here - there)))
