"""Exponential law: straight up to the peak, then down as an exponential that ends.

Beyond the elastic limit d_e, with x = (d - d_e)/(d_c - d_e) and decay a,

    S = s (exp(-a x) - exp(-a)) / (1 - exp(-a)),   G = s (d_e + f (d_c - d_e))/2,
    f = 2 (1/a - exp(-a)/(1 - exp(-a))).

The exponential is shifted so that it ends at d_c. A small decay is nearly a straight line.
"""

from math import exp
from typing import NamedTuple

from cramp_cli.cohesive.law import strength, work
from cramp_cli.cohesive.modes import Modes, way_peak, way_stiffness, way_toughness
from cramp_cli.cohesive.softening import softens
from cramp_cli.numerics.kernel import kernel


@softens
class Exponential(NamedTuple):
    """A straight line and an exponential."""

    modes: Modes
    decay: float  # a


@kernel
def fullness(decay):
    """Return twice the area under the falling part, for a peak and a length of one."""
    return 2.0 * (1.0 / decay - exp(-decay) / (1.0 - exp(-decay)))


@kernel
def shape(law, share):
    """Return stiffness (Pa/m), peak (Pa), elastic limit and length of the fall (m)."""
    k, s = way_stiffness(law.modes, share), way_peak(law.modes, share)
    limit = s / k
    return k, s, limit, (2.0 * way_toughness(law.modes, share) / s - limit) / fullness(law.decay)


@strength.implement(Exponential)
def _(law, share, opening):
    k, s, limit, fall = shape(law, share)
    if opening <= limit:
        return k * opening
    if opening >= limit + fall:
        return 0.0
    end = exp(-law.decay)
    return s * (exp(-law.decay * (opening - limit) / fall) - end) / (1.0 - end)


@work.implement(Exponential)
def _(law, share, opening):
    k, s, limit, fall = shape(law, share)
    if opening <= limit:
        return 0.5 * k * opening * opening
    if opening >= limit + fall:
        return way_toughness(law.modes, share)
    x, end = (opening - limit) / fall, exp(-law.decay)
    area = ((1.0 - exp(-law.decay * x)) / law.decay - x * end) / (1.0 - end)
    return 0.5 * s * limit + s * fall * area
