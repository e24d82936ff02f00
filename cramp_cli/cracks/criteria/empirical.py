"""A crack grows when (K_I/K_Ic)^p + (K_II/K_IIc)^q reaches 1: a fit to mixed mode tests."""

from dataclasses import dataclass

from cramp_cli.cracks.criteria.load import Load
from cramp_cli.cracks.criteria.max_hoop_stress import hoop_direction


@dataclass(frozen=True)
class Empirical:
    """An ellipse for p = q = 2; closing faces (K_I < 0) add nothing."""

    K_Ic: float  # Pa sqrt(m)
    K_IIc: float  # Pa sqrt(m)
    p: float = 2.0
    q: float = 2.0

    def direction(self, load: Load) -> float:
        """Return the angle of the largest hoop stress (rad)."""
        return hoop_direction(load.K_I, load.K_II)

    def drive(self, load: Load) -> float:
        """Return the number by which K_I and K_II must be divided to lie on the curve."""
        first, second = max(load.K_I, 0.0) / self.K_Ic, abs(load.K_II) / self.K_IIc
        if min(first, second) == 0.0:
            return max(first, second)
        low, high = max(first, second), 2.0 ** (1.0 / min(self.p, self.q)) * max(first, second)
        for _ in range(60):
            middle = 0.5 * (low + high)
            outside = (first / middle) ** self.p + (second / middle) ** self.q > 1.0
            low, high = (middle, high) if outside else (low, middle)
        return 0.5 * (low + high)
