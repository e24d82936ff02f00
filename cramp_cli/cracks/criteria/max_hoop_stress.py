"""A crack grows across the largest hoop stress around its tip (Erdogan and Sih 1963)."""

from dataclasses import dataclass
from math import atan, cos, hypot, sin, sqrt

from cramp_cli.cracks.criteria.load import Load


def hoop_direction(K_I: float, K_II: float) -> float:
    """Return the root of K_I sin(t) + K_II (3 cos(t) - 1) = 0 with the largest hoop stress (rad).

    Written so that nothing cancels for K_I > 0; K_II = 0 is straight on.
    """
    if K_II == 0.0:
        return 0.0
    root = hypot(K_I, sqrt(8.0) * K_II)
    if K_I > 0.0:
        return 2.0 * atan(-2.0 * K_II / (K_I + root))
    return 2.0 * atan((K_I - root) / (4.0 * K_II))


@dataclass(frozen=True)
class MaxHoopStress:
    """Grows when the largest hoop stress equals that of mode I at the toughness."""

    K_Ic: float  # Pa sqrt(m)

    def direction(self, load: Load) -> float:
        """Return the angle of the largest hoop stress (rad)."""
        return hoop_direction(load.K_I, load.K_II)

    def drive(self, load: Load) -> float:
        """Return the hoop stress there over that of mode I at the toughness."""
        angle = self.direction(load)
        half = 0.5 * angle
        hoop = cos(half) * (load.K_I * cos(half) ** 2 - 1.5 * load.K_II * sin(angle))
        return hoop / self.K_Ic
