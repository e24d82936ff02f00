"""Triangular (bilinear) law: straight up to the peak, straight down to nothing.

G = s d_c/2, with the critical opening d_c (Hillerborg 1976; Camanho and Davila 2002).
"""

from typing import NamedTuple

from cramp_cli.cohesive.law import strength, work
from cramp_cli.cohesive.modes import Modes, way_peak, way_stiffness, way_toughness
from cramp_cli.cohesive.softening import softens


@softens
class Triangular(NamedTuple):
    """Two straight lines."""

    modes: Modes


@strength.implement(Triangular)
def _(law, share, opening):
    k, s = way_stiffness(law.modes, share), way_peak(law.modes, share)
    limit, critical = s / k, 2.0 * way_toughness(law.modes, share) / s
    if opening <= limit:
        return k * opening
    if opening >= critical:
        return 0.0
    return s * (critical - opening) / (critical - limit)


@work.implement(Triangular)
def _(law, share, opening):
    k, s = way_stiffness(law.modes, share), way_peak(law.modes, share)
    G = way_toughness(law.modes, share)
    limit, critical = s / k, 2.0 * G / s
    if opening <= limit:
        return 0.5 * k * opening * opening
    if opening >= critical:
        return G
    return G - 0.5 * s * (critical - opening) ** 2 / (critical - limit)
