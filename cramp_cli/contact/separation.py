"""How far two bodies are apart along a normal, told by the particles next to each other."""

from math import inf, sqrt

from cramp_cli.contact.clouds import particle_of
from cramp_cli.numerics.kernel import kernel

FLUSH = 1e-9  # cells; bodies this close touch, or round-off would tell which nodes of a face do


@kernel
def radius(particles, p, half, nx, ny):
    """Return the radius of a particle along n: of the deformed ellipse inscribed in it (m).

    half: (n, 2) of each number: half axes at the start (m). The ellipse is F times one of half axes
    a and b, a times a circle drawn out by b/a along y, so |(1, a/b) F^-1 n| r = a.
    """
    F, number = particles.F, particles.id[p]
    a, b = half[number, 0], half[number, 1]
    det = F[p, 0] * F[p, 3] - F[p, 1] * F[p, 2]
    x, y = F[p, 3] * nx - F[p, 1] * ny, (F[p, 0] * ny - F[p, 2] * nx) * (a / b)
    return a * det / sqrt(x * x + y * y)


@kernel
def separation(clouds, stencil, particles, half, a, b, nx, ny):
    """Return min_b (x.n - R) - max_a (x.n + R), negative where the bodies overlap (m).

    a, b: rows, n points from a to b; half: (n, 2) of each number (m)
    """
    x = particles.position
    front, back = -inf, inf
    entry = clouds.head[a]
    while entry >= 0:
        p = particle_of(stencil, entry)
        front = max(front, x[p, 0] * nx + x[p, 1] * ny + radius(particles, p, half, nx, ny))
        entry = clouds.link[entry]
    entry = clouds.head[b]
    while entry >= 0:
        p = particle_of(stencil, entry)
        back = min(back, x[p, 0] * nx + x[p, 1] * ny - radius(particles, p, half, nx, ny))
        entry = clouds.link[entry]
    return back - front
