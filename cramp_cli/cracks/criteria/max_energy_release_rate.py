"""A crack grows where a short kink releases most energy (Wu 1978; Amestoy and Leblond 1992)."""

from dataclasses import dataclass
from math import hypot

from cramp_cli.cracks.criteria.load import Load
from cramp_cli.cracks.kink import kinked, steepest_release


@dataclass(frozen=True)
class MaxEnergyReleaseRate:
    """Grows when the kink would release as much as mode I at the toughness."""

    K_Ic: float  # Pa sqrt(m)

    def direction(self, load: Load) -> float:
        """Return the angle of the kink (rad)."""
        return steepest_release(load.K_I, load.K_II)

    def drive(self, load: Load) -> float:
        """Return the square root of the kink's energy release rate over that at the toughness."""
        k_I, k_II = kinked(load.K_I, load.K_II, self.direction(load))
        return hypot(k_I, k_II) / self.K_Ic if k_I > 0.0 else 0.0
