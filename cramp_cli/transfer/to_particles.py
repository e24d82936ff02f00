"""From the grid to the particles: where they are, motion, strain and stress.

As in to_grid.py: plain MPM for particles far from cracks, rows instead of nodes for those near.

parts: (k, 3) runs of particles, first and last + 1, and the band they belong to (state/bands.py)
"""

from numpy import uint64

from cramp_cli.materials.geometry import rate_across, strained
from cramp_cli.materials.law import Straining
from cramp_cli.numerics.kernel import kernel, particle_kernel
from cramp_cli.numerics.matrix import (
    add_outer,
    from_columns,
    increment,
    matrix,
    product,
    zero_matrix,
)
from cramp_cli.numerics.symmetric import (
    kept,
    six,
    turn,
    work_of,
)
from cramp_cli.numerics.vector import (
    dot,
    in_cells,
    plus,
    scaled,
    store,
    times,
    vector,
    whole,
    within,
)
from cramp_cli.shapes.nodes import give, take, take_both
from cramp_cli.shapes.shape import (
    NOWHERE,
    SHORTENED,
    factors,
    first_nodes,
    gradients,
    lay_out,
    own_shape,
    place_of,
    seen_from,
    store_hoop,
    support,
    weights,
)
from cramp_cli.state.bands import HEIGHT, STRAY
from cramp_cli.state.stencil import AROUND, CLOSE, FAR
from cramp_cli.transfer.rows import add, entry_gradient, first_line
from cramp_cli.transfer.update import moved

AT_A_TIME = 512  # particles


@kernel
def locate(
    stencil, position, F, shape, lower, strides, nodes, width, head, zone, axis, report, parts
):
    """Find the nodes that particles see, and how near to cracks they are.

    nodes: number of grid nodes along each axis; head, zone: of Segments; axis: across the bands
    report: (bands, 4) set to a particle that sees nodes outside the grid (or has no position) or
    -1, the number of particles that have strayed from their band, the number not FAR, and the
    number of those whose domain was shortened
    """
    base, local, near = stencil.base, stencil.local, stencil.near
    seen = support(shape)
    for part in range(len(parts)):
        band = parts[part, 2]
        lowest, highest = HEIGHT * band - STRAY, HEIGHT * (band + 1) + STRAY
        gone, strayed, close, short = -1, 0, 0, 0
        for number in range(parts[part, 0], parts[part, 1]):
            p = uint64(number)
            x = in_cells(vector(strides, position, p), lower, width)
            own = own_shape(shape, stencil, p)
            first, cell = first_nodes(x, own, 0), whole(x)
            near[p] = FAR
            laid = lay_out(own, stencil, F, p)
            if laid == NOWHERE or not within(first, seen, nodes):
                gone = number
                continue
            base[p] = dot(first, strides)
            store(plus(x, -1.0, first), local, p, 0)
            short += laid == SHORTENED
            strayed += not lowest <= cell[axis] < highest
            if zone[dot(cell, strides)]:
                near[p] = CLOSE if head[dot(cell, strides)] >= 0 else AROUND
                close += 1
        report[band, 0], report[band, 1] = gone, strayed
        report[band, 2], report[band, 3] = close, short


@kernel
def gone_and_strayed(report):
    """Return a particle that has left the grid or -1, and whether one has strayed from its band."""
    gone, strayed = -1, False
    for block in range(len(report)):
        for found in report[block]:
            gone = max(gone, found[0])
            strayed = strayed or found[1] > 0
    return gone, strayed


@particle_kernel
def move_particles(
    particles, grid, stencil, update, shape, strides, damping, dt, again, taken, parts
):
    """Move particles and change their velocity; sum the new momenta in `grid.saved` if `again`.

    damping: (grid, particle), 1/s
    again: the second extrapolation, with the weights of the step's start
    taken: (bands,) set to the energy taken by damping, and by the filter of updates but FLIP (J)
    """
    for part in range(len(parts)):
        run = (parts[part, 0], parts[part, 1])
        how = (update, shape, strides, damping, dt, again)
        lost = _move_far(particles, grid, stencil, *how, run)
        taken[parts[part, 2]] = lost + _move_near(particles, grid, stencil, *how, run)


@particle_kernel
def _move_far(particles, grid, stencil, update, shape, strides, damping, dt, again, run):
    velocity, acceleration, momentum = grid.velocity, grid.acceleration, grid.saved
    base, near = stencil.base, stencil.near
    m, lost = particles.mass, 0.0
    for number in range(run[0], run[1]):
        p = uint64(number)
        if near[p] < 0:
            along = factors(place_of(shape, strides, stencil, p), shape)
            u = take(along, strides, base[p], velocity)
            a = take(along, strides, base[p], acceleration)
            lost += _move_one(particles, p, update, u, a, damping, dt)
            if again:
                P = times(vector(strides, particles.velocity, p), m[p])
                give(along, strides, base[p], momentum, P)
    return lost


@particle_kernel
def _move_near(particles, grid, stencil, update, shape, strides, damping, dt, again, run):
    velocity, acceleration, momentum = grid.velocity, grid.acceleration, grid.saved
    which, table, share = stencil.which, stencil.table, stencil.share
    m, lost = particles.mass, 0.0
    for line in range(first_line(stencil, run[0]), first_line(stencil, run[1])):
        p = stencil.listed[line]
        S = weights(place_of(shape, strides, stencil, p), shape)
        u, a = times(strides, 0.0), times(strides, 0.0)
        for e in range(stencil.entries[line]):
            w, row = share[line, e] * S[which[line, e]], table[line, e]
            u = plus(u, w, vector(strides, velocity, row))
            a = plus(a, w, vector(strides, acceleration, row))
        lost += _move_one(particles, p, update, u, a, damping, dt)
        if again:
            P = times(vector(strides, particles.velocity, p), m[p])
            for e in range(stencil.entries[line]):
                add(momentum, table[line, e], share[line, e] * S[which[line, e]], P)
    return lost


@particle_kernel
def _move_one(particles, p, update, u, a, damping, dt):
    """Move a particle with grid velocity u and acceleration a; return the energy taken (J)."""
    V = vector(u, particles.velocity, p)
    new, mean = moved(update, V, u, a, damping[0], damping[1], dt)
    store(new, particles.velocity, p, 0)
    store(plus(vector(u, particles.position, p), dt, mean), particles.position, p, 0)
    store(a, particles.acceleration, p, 0)
    free = plus(V, dt, a)
    return 0.5 * particles.mass[p] * dot(plus(free, -1.0, new), plus(V, 1.0, new))


@particle_kernel
def update_stress(particles, grid, stencil, law, geometry, shape, strides, width, dt, parts):
    """Strain particles for the time dt with the velocities of the grid; update their stress.

    First the velocity gradients of some particles, then their stresses: two short loops are faster
    than a long one as long as what they share is in the cache.
    """
    for part in range(len(parts)):
        for first in range(parts[part, 0], parts[part, 1], AT_A_TIME):
            run = (first, min(first + AT_A_TIME, parts[part, 1]))
            _gradients_far(particles.L, grid.velocity, stencil, shape, strides, 1.0 / width, run)
            _gradients_near(particles.L, grid.velocity, stencil, shape, strides, 1.0 / width, run)
            _strain(particles, law, geometry, strides, dt, run)


@particle_kernel
def _gradients_far(L, velocity, stencil, shape, strides, per_cell, run):
    base, near = stencil.base, stencil.near
    for number in range(run[0], run[1]):
        p = uint64(number)
        if near[p] < 0:
            place = place_of(shape, strides, stencil, p)
            seen = seen_from(shape, base[p], place)
            v, slopes = take_both(factors(place, seen), strides, base[p], velocity)
            store(scaled(from_columns(slopes), per_cell), L, p, 0)
            store_hoop(seen, v, per_cell, L, p)


@particle_kernel
def _gradients_near(L, velocity, stencil, shape, strides, per_cell, run):
    table, which, share = stencil.table, stencil.which, stencil.share
    for line in range(first_line(stencil, run[0]), first_line(stencil, run[1])):
        p = stencil.listed[line]
        place = place_of(shape, strides, stencil, p)
        seen = seen_from(shape, stencil.base[p], place)
        S, G, gradient = weights(place, seen), gradients(place, seen), zero_matrix(strides)
        v = times(strides, 0.0)
        for e in range(stencil.entries[line]):
            g = entry_gradient(stencil, strides, line, e, S, G)
            v_row = vector(strides, velocity, table[line, e])
            gradient = add_outer(v_row, g, gradient)
            v = plus(v, share[line, e] * S[which[line, e]], v_row)
        store(scaled(gradient, per_cell), L, p, 0)
        store_hoop(seen, v, per_cell, L, p)


@particle_kernel
def _strain(particles, law, geometry, strides, dt, run):
    for number in range(run[0], run[1]):
        strain_one(particles, uint64(number), law, geometry, strides, dt)


@particle_kernel
def strain_one(particles, p, law, geometry, strides, dt):
    """Strain a particle with its velocity gradient for the time dt; strides: as many as axes."""
    F, stress, stretch = particles.F, particles.stress, particles.stretch
    dU = scaled(matrix(zero_matrix(strides), particles.L, p), dt)
    turned = turn(dU, six(dU, stress, p, 0))
    after = product(increment(dU), matrix(dU, F, p))
    across = dt * rate_across(geometry, particles.L, p)
    step = Straining(turned, dU, after, stretch[p], dt, across)
    strain, new, past = strained(geometry, law, step, particles.history, p)
    particles.work[p] += work_of(turned, new, strain)
    stretch[p] *= 1.0 + strain[2] + 0.5 * strain[2] * strain[2]
    store(past, particles.history, p, 0)
    store(kept(dU, new), stress, p, 0)
    store(after, F, p, 0)
