"""Cubic law: S = k d (1 - d/d_c)^2, smooth from the start to the end, after Needleman (1987).

Peak s = 4 k d_c/27 at a third of d_c, G = k d_c^2/12 = 9 s d_c/16. Damage begins at once. Between
the modes stiffness and toughness are mixed (modes.py); the peak follows from the two.
"""

from typing import NamedTuple

from cramp_cli.cohesive.law import strength, work
from cramp_cli.cohesive.modes import Modes, way_stiffness, way_toughness
from cramp_cli.cohesive.softening import softens


@softens
class Cubic(NamedTuple):
    """One polynomial."""

    modes: Modes


@strength.implement(Cubic)
def _(law, share, opening):
    k, G = way_stiffness(law.modes, share), way_toughness(law.modes, share)
    x = opening / (12.0 * G / k) ** 0.5
    return k * opening * (1.0 - x) ** 2 if x < 1.0 else 0.0


@work.implement(Cubic)
def _(law, share, opening):
    k, G = way_stiffness(law.modes, share), way_toughness(law.modes, share)
    x = opening / (12.0 * G / k) ** 0.5
    return G * x * x * (6.0 - 8.0 * x + 3.0 * x * x) if x < 1.0 else G
