"""A crack grows straight on when J reaches the critical energy release rate."""

from dataclasses import dataclass
from math import sqrt

from cramp_cli.cracks.criteria.load import Load


@dataclass(frozen=True)
class CriticalJ:
    """Griffith's criterion, for a crack whose way is known."""

    G_Ic: float  # J/m^2

    def direction(self, load: Load) -> float:
        """Straight on."""
        return 0.0

    def drive(self, load: Load) -> float:
        """Return the square root of J over the toughness."""
        return sqrt(max(load.J, 0.0) / self.G_Ic)
