"""Opening and sliding of one law, and what lies between the two.

On a straight way the faces open by (d cos, d sin). Both components share one damage, so the shares
of opening and sliding in the energy stay what they are on that way: a = 1 - b and
b = k_t sin^2/(k_n cos^2 + k_t sin^2). In these shares everything between the modes is simple:

* stiffness of the way            1/k = a/k_n + b/k_t
* damage begins at the energy     1/e = a/e_n + b/e_t, with e_m = s_m^2/(2 k_m): the quadratic
  criterion (T_n/s_n)^2 + (T_t/s_t)^2 = 1
* the faces part at the energy    (a G/G_n)^p + (b G/G_t)^p = 1

(Camanho and Davila 2002, NASA/TM-2002-211737, for the triangular law with k_n = k_t.)
"""

from typing import NamedTuple

from cramp_cli.numerics.kernel import kernel


class Modes(NamedTuple):
    """Numbers of both modes: opening, sliding."""

    stiffness: tuple  # before damage, or at the very start (Pa/m)
    peak: tuple  # largest stress (Pa)
    toughness: tuple  # energy to part the faces (J/m^2)
    power: float  # p of the criterion above, at least 1


@kernel
def share_of_sliding(modes, normal, sliding):
    """Return the share of sliding in the energy, 0 to 1; normal: at least 0 (m)."""
    opened = modes.stiffness[0] * normal * normal
    slid = modes.stiffness[1] * sliding * sliding
    return slid / (opened + slid) if slid > 0.0 else 0.0


@kernel
def way_stiffness(modes, share):
    """Return the stiffness on a straight way (Pa/m)."""
    k_n, k_t = modes.stiffness
    return 1.0 / ((1.0 - share) / k_n + share / k_t)


@kernel
def way_peak(modes, share):
    """Return the stress at which damage begins on a straight way (Pa)."""
    (k_n, k_t), (s_n, s_t) = modes.stiffness, modes.peak
    inverse = (1.0 - share) * k_n / (s_n * s_n) + share * k_t / (s_t * s_t)
    return (way_stiffness(modes, share) / inverse) ** 0.5


@kernel
def way_toughness(modes, share):
    """Return the energy that parts the faces on a straight way (J/m^2)."""
    p, (G_n, G_t) = modes.power, modes.toughness
    return (((1.0 - share) / G_n) ** p + (share / G_t) ** p) ** (-1.0 / p)
