"""What a running tip releases is taken out of the solid where it is released.

A node that parts lets its forces go within a few steps, and in the discrete body nothing takes the
energy: it would stay in the run as waves as short as a cell. So tractions resist the motion of the
faces just behind a running tip until the next cells have opened (nodal force release of finite
elements: Malluck and King 1980; here in proportion to the momentum that parts the faces;
docs/theory/growth.md).
"""

from math import sqrt

from cramp_cli.cracks.domain import USUAL
from cramp_cli.cracks.domain_integral import inner_radius, weight
from cramp_cli.cracks.followers import sides_beside_tip
from cramp_cli.cracks.tip_nodes import FAR, along_crack
from cramp_cli.numerics.kernel import kernel
from cramp_cli.state.growth import running_tips

HELD, FREE = 2.0, 3.0  # cells behind a tip up to where faces are resisted in full, and at all
RESISTED = 0.6  # share of the momentum that parts two faces, taken in a step


def resist_opening(model, state, scratch) -> None:
    """Let closing tractions act on the faces that running tips have just made.

    Where the domain of the tip is small they end nearer to it: J is to hold what they take.
    """
    lattice, grid, growth = model.lattice, scratch.grid, state.growth
    place = (lattice.width, lattice.lower, model.strides)
    for tip in running_tips(growth):
        length, reach = float(growth.length[tip]), float(growth.reach[tip])
        free = min(length / lattice.width, FREE * min(reach / (USUAL * lattice.width), 1.0))
        solid = (scratch.rows, state.paths, model.groups.of_crack)
        radii = (inner_radius(reach, lattice.width), max(reach, 1e-3 * lattice.width))
        growth.taken[tip] += _resist(grid, *solid, tip, free, *place, model.dt, radii)


@kernel
def _resist(grid, rows, paths, of_crack, tip, free, width, lower, strides, dt, radii):
    """Let both sides of the nodes within `free` cells behind a tip lose relative momentum.

    of_crack: contact group of the bodies that a crack cuts; others may share its nodes
    radii: of the domain of the tip, inner and outer (m)
    returns: the energy taken that this domain does not count (J; sinks.py)
    """
    taken = 0.0
    crack = tip // 2
    first, last = paths.start[crack], paths.start[crack + 1] - 1
    at = first if tip % 2 == 0 else last
    mass = grid.mass
    for i in range(rows.count[4]):
        node = rows.tipped[i]
        if rows.tip[node] != tip:
            continue
        above, below = sides_beside_tip(rows, of_crack, node)
        if min(above, below) < 0 or mass[above] <= 0.0 or mass[below] <= 0.0:
            continue
        x = lower[0] + node % strides[1] * width
        y = lower[1] + node // strides[1] * width
        ahead = along_crack(paths.point, first, last, at, x, y, FAR * width)[0]
        share = RESISTED * min(max((free + ahead / width) / (FREE - HELD), 0.0), 1.0)
        if share > 0.0:
            away = sqrt((x - paths.point[at, 0]) ** 2 + (y - paths.point[at, 1]) ** 2)
            q = weight(min(away, radii[1]), radii[0], radii[1])[0]
            taken += (1.0 - q) * _bring_together(grid, above, below, share, len(strides), dt)
    return taken


@kernel
def _bring_together(grid, a, b, share, dim, dt):
    """Take a share of the momentum that rows a and b have relative to each other; return its work.

    The work (J) is that with the mean slip of the step, as of friction (contact.py).
    """
    mass, momentum, force = grid.mass, grid.momentum, grid.force
    both, work = mass[a] + mass[b], 0.0
    for d in range(dim):
        parting = (mass[a] * momentum[b, d] - mass[b] * momentum[a, d]) / both
        pushed = dt * (mass[a] * force[b, d] - mass[b] * force[a, d]) / both
        slip = (parting - 0.5 * pushed - 0.5 * share * parting) * both / (mass[a] * mass[b])
        work += share * parting * slip
        momentum[a, d] += share * parting
        momentum[b, d] -= share * parting
        force[a, d] += share * parting / dt
        force[b, d] -= share * parting / dt
    return work
