"""What a criterion is asked about."""

from typing import NamedTuple


class Load(NamedTuple):
    """The load on a tip, in the axes of the crack there."""

    K_I: float  # Pa sqrt(m)
    K_II: float  # Pa sqrt(m)
    J: float = 0.0  # J/m^2
    opening: float = 0.0  # of the faces near the tip, across the crack (m)
    sliding: float = 0.0  # the same along the crack (m)
