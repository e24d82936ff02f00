"""A plain loop that takes as long on every day as this computer lets it: times are told in it."""

from cramp_cli.numerics.kernel import kernel


@kernel
def triad(a, b, c, s):
    """Set a = b + s c, entry by entry; all (n,)."""
    for i in range(len(a)):
        a[i] = b[i] + s * c[i]


@kernel
def chain(a, s):
    """Return a number that needs every entry of `a` (n,) in turn."""
    total = 0.0
    for i in range(len(a)):
        total = total * s + a[i]
    return total
