"""How far two bodies are apart along a normal, told by the particles next to each other."""

from math import inf, sqrt

from cramp_cli.contact.clouds import particle_of
from cramp_cli.numerics.kernel import kernel

FLUSH = 1e-9  # cells; bodies this close touch, or round-off would tell which nodes of a face do


@kernel
def radius(F, p, half, nx, ny):
    """Return the radius of a particle along n: of the deformed ellipse inscribed in it (m).

    half: half its side at the start (m). The ellipse is F times a circle, so |F^-1 n| r = half.
    """
    det = F[p, 0] * F[p, 3] - F[p, 1] * F[p, 2]
    x, y = F[p, 3] * nx - F[p, 1] * ny, F[p, 0] * ny - F[p, 2] * nx
    return half[p] * det / sqrt(x * x + y * y)


@kernel
def separation(clouds, stencil, particles, half, a, b, nx, ny):
    """Return min_b (x.n - R) - max_a (x.n + R), negative where the bodies overlap (m).

    a, b: rows, n points from a to b; half: (n,) half sides of the particles (m)
    """
    x, F = particles.position, particles.F
    front, back = -inf, inf
    entry = clouds.head[a]
    while entry >= 0:
        p = particle_of(stencil, entry)
        front = max(front, x[p, 0] * nx + x[p, 1] * ny + radius(F, p, half, nx, ny))
        entry = clouds.link[entry]
    entry = clouds.head[b]
    while entry >= 0:
        p = particle_of(stencil, entry)
        back = min(back, x[p, 0] * nx + x[p, 1] * ny - radius(F, p, half, nx, ny))
        entry = clouds.link[entry]
    return back - front
