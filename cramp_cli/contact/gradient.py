"""Normals from gradients of the volume (Bardenhagen et al. 2001; Lemiale, Nairn, Hurmane 2010).

The gradient of the volume of a body beside a node points into the body, where there is more of
it; with G = dS/dx_p it is the other way round, out of the body. So +g_a and -g_b both point from a
to b.
"""

from cramp_cli.numerics.kernel import kernel
from cramp_cli.numerics.tensor import dot, plus, times, vector


@kernel
def average_gradient(clouds, a, b, strides):
    """Return g_a - g_b, a vector from body a to body b: each counts by its size."""
    return plus(vector(strides, clouds.slope, a), -1.0, vector(strides, clouds.slope, b))


@kernel
def larger_gradient(clouds, a, b, strides):
    """Return g_a or -g_b, whichever is longer: the body that fills the node better decides."""
    ga, gb = vector(strides, clouds.slope, a), vector(strides, clouds.slope, b)
    return ga if dot(ga, ga) >= dot(gb, gb) else times(gb, -1.0)
