"""A crack grows when its faces near the tip have opened or slid by a critical amount."""

from dataclasses import dataclass
from math import inf

from cramp_cli.cracks.criteria.load import Load


@dataclass(frozen=True)
class MaxCtod:
    """Critical opening and sliding; infinite where one of them does not matter."""

    delta_Ic: float = inf  # m
    delta_IIc: float = inf  # m

    def direction(self, load: Load) -> float:
        """Straight on: an opening alone tells no direction."""
        return 0.0

    def drive(self, load: Load) -> float:
        """Return the larger of both over its critical value."""
        return max(load.opening / self.delta_Ic, abs(load.sliding) / self.delta_IIc)
