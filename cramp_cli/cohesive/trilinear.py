"""Trilinear law: up to the peak, down to a knee, down to nothing.

Peak s at d_1, knee r s at d_1 + w (d_c - d_1):  G = s (d_1 + (w + r)(d_c - d_1))/2. A steep fall
and a long tail: matrix and bridging fibres. Between the modes r and w change straight with the
share.
"""

from typing import NamedTuple

from cramp_cli.cohesive.law import strength, work
from cramp_cli.cohesive.modes import Modes, way_peak, way_stiffness, way_toughness
from cramp_cli.cohesive.softening import softens
from cramp_cli.numerics.kernel import kernel


@softens
class Trilinear(NamedTuple):
    """Three straight lines; pairs are of opening and sliding."""

    modes: Modes
    knee_stress: tuple  # r, 0 to 1
    knee_place: tuple  # w, above 0, below 1


@kernel
def corners(law, share):
    """Return openings and stresses of peak and knee, and the critical opening (m, Pa)."""
    k, s = way_stiffness(law.modes, share), way_peak(law.modes, share)
    (r_n, r_t), (w_n, w_t) = law.knee_stress, law.knee_place
    r, w = (1.0 - share) * r_n + share * r_t, (1.0 - share) * w_n + share * w_t
    first = s / k
    fall = (2.0 * way_toughness(law.modes, share) / s - first) / (w + r)
    return first, s, first + w * fall, r * s, first + fall


@strength.implement(Trilinear)
def _(law, share, opening):
    first, peak, second, knee, critical = corners(law, share)
    if opening <= first:
        return way_stiffness(law.modes, share) * opening
    if opening >= critical:
        return 0.0
    if opening < second:
        return peak + (knee - peak) * (opening - first) / (second - first)
    return knee * (critical - opening) / (critical - second)


@work.implement(Trilinear)
def _(law, share, opening):
    first, peak, second, knee, critical = corners(law, share)
    if opening <= first:
        return 0.5 * way_stiffness(law.modes, share) * opening * opening
    if opening >= critical:
        return way_toughness(law.modes, share)
    here = strength(law, share, opening)
    if opening < second:
        return 0.5 * (peak * first + (peak + here) * (opening - first))
    return way_toughness(law.modes, share) - 0.5 * here * (critical - opening)
