"""A crack that runs at a prescribed speed once J has been reached, or from a given time on."""

from dataclasses import dataclass
from math import inf, sqrt

from cramp_cli.cracks.criteria.load import Load


@dataclass(frozen=True)
class SteadyState:
    """Once begun the crack runs whatever its load, until it is as long as it may become."""

    G_Ic: float = inf  # J/m^2
    begin: float = inf  # s; the crack runs from this time on at the latest

    def direction(self, load: Load) -> float:
        """Straight on."""
        return 0.0

    def drive(self, load: Load) -> float:
        """Return the square root of J over the value that starts it."""
        return sqrt(max(load.J, 0.0) / self.G_Ic)
