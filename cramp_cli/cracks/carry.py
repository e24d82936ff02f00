"""From the rows beside a crack to its surface: their mean motion, and their spin on the way there.

Rows i move with v_i where their nodes are, x_i: this is the motion that moves particles. With the
weights w_i, which sum to 1, the surface at x moves with

    v = sum w_i v_i + omega x (x - sum w_i x_i),
    omega = sum k_i r_i x v_i / sum k_i r_i^2,   r_i = x_i - sum k_i x_i/sum k_i,

so it follows any rigid motion of the grid, and both surfaces of a closed crack go the same way. A
force F on the surface goes to the rows so that it works on this motion and on nothing else: w_i F,
and a couple k_i r_i that makes up for the lever. So the two forces of a traction neither push nor
turn the body.
"""

from cramp_cli.numerics.kernel import inlined_kernel

LEAST_ARM = 1e-9  # cells^2; less is the round-off of a single row


@inlined_kernel
def carry_on(seen, count, x, y):
    """Set arms and lever for a surface at (x, y), in cells; the weights must be there.

    A single row tells no spin: the lever is zero.
    """
    px, py, cx, cy, counted = 0.0, 0.0, 0.0, 0.0, 0.0
    for e in range(count):
        w, k, ax, ay = seen.weight[e], seen.mass[e], seen.arm[e, 0], seen.arm[e, 1]
        px, py, cx, cy = px + w * ax, py + w * ay, cx + k * ax, cy + k * ay
        counted += k
    inertia = 0.0
    for e in range(count):
        rx, ry = seen.arm[e, 0] - cx / counted, seen.arm[e, 1] - cy / counted
        seen.arm[e, 0], seen.arm[e, 1] = rx, ry
        inertia += seen.mass[e] * (rx * rx + ry * ry)
    over = 1.0 / inertia if inertia > LEAST_ARM * counted else 0.0
    seen.lever[0], seen.lever[1] = (x - px) * over, (y - py) * over


@inlined_kernel
def carried(seen, count, field):
    """Return what a field (rows, 2) of velocities or accelerations is at the surface."""
    x, y, turn = 0.0, 0.0, 0.0
    for e in range(count):
        fx, fy = field[seen.row[e], 0], field[seen.row[e], 1]
        x, y = x + seen.weight[e] * fx, y + seen.weight[e] * fy
        turn += seen.mass[e] * (seen.arm[e, 0] * fy - seen.arm[e, 1] * fx)
    return x - turn * seen.lever[1], y + turn * seen.lever[0]


@inlined_kernel
def give_back(force, seen, count, fx, fy):
    """Add a force on the surface (N) to the forces of the rows."""
    couple = seen.lever[0] * fy - seen.lever[1] * fx
    for e in range(count):
        row, w, k = seen.row[e], seen.weight[e], seen.mass[e] * couple
        force[row, 0] += w * fx - k * seen.arm[e, 1]
        force[row, 1] += w * fy + k * seen.arm[e, 0]
