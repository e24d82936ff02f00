"""Normals from gradients of the volume (Bardenhagen et al. 2001; Lemiale, Nairn, Hurmane 2010).

The gradient of the volume of a body beside a node points into the body, where there is more of
it; with G = dS/dx_p it is the other way round, out of the body. So +g_a and -g_b both point from a
to b.
"""

from cramp_cli.numerics.kernel import kernel
from cramp_cli.numerics.vector import (
    dot,
    plus,
    times,
    vector,
)


@kernel
def gradients_around(clouds, pairs, i, strides):
    """Return the sums of g_a and of g_b over the window of pair i."""
    none = times(vector(strides, clouds.slope, 0), 0.0)
    ga, gb = none, none
    for w in range(pairs.around[i]):
        j = pairs.window[i, w]
        ga = plus(ga, 1.0, vector(strides, clouds.slope, pairs.row[j, 0]))
        gb = plus(gb, 1.0, vector(strides, clouds.slope, pairs.row[j, 1]))
    return ga, gb


@kernel
def average_gradient(clouds, pairs, i, strides):
    """Return g_a - g_b, a vector from body a to body b: each counts by its size."""
    ga, gb = gradients_around(clouds, pairs, i, strides)
    return plus(ga, -1.0, gb)


@kernel
def larger_gradient(clouds, pairs, i, strides):
    """Return g_a or -g_b, whichever is longer: the body that fills the nodes better decides."""
    ga, gb = gradients_around(clouds, pairs, i, strides)
    return ga if dot(ga, ga) >= dot(gb, gb) else times(gb, -1.0)
