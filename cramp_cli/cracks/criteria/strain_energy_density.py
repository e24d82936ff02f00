"""A crack grows where the strain energy density near its tip is smallest (Sih 1974)."""

from dataclasses import dataclass
from math import copysign, cos, pi, sin, sqrt

from cramp_cli.cracks.criteria.load import Load

STEPS = 180  # in which the first minimum is sought


@dataclass(frozen=True)
class StrainEnergyDensity:
    """Grows when the smallest density equals that of mode I at the toughness."""

    K_Ic: float  # Pa sqrt(m)
    kappa: float  # Kolosov's constant of the analysis

    def direction(self, load: Load) -> float:
        """Return the minimum nearest to straight on, on the side away from the sliding (rad)."""
        if load.K_II == 0.0:
            return 0.0
        away = -copysign(1.0, load.K_II)
        before = 0.0
        for n in range(1, STEPS + 1):
            after = pi * n / STEPS
            falling = away * self._slope(load, away * before) < 0.0
            if falling and away * self._slope(load, away * after) >= 0.0:
                return away * self._minimum(load, away, before, after)
            before = after
        return 0.0

    def drive(self, load: Load) -> float:
        """Return the square root of the density there over that at the toughness."""
        if load.K_II == 0.0:
            return load.K_I / self.K_Ic
        density = self._density(load, self.direction(load))
        return sqrt(max(density, 0.0) / (2.0 * (self.kappa - 1.0))) / self.K_Ic

    def _density(self, load, angle):
        """Return 16 mu r S: a11 K_I^2 + 2 a12 K_I K_II + a22 K_II^2."""
        c, s, k = cos(angle), sin(angle), self.kappa
        a11, a12 = (1.0 + c) * (k - c), s * (2.0 * c - k + 1.0)
        a22 = (k + 1.0) * (1.0 - c) + (1.0 + c) * (3.0 * c - 1.0)
        return a11 * load.K_I**2 + 2.0 * a12 * load.K_I * load.K_II + a22 * load.K_II**2

    def _slope(self, load, angle):
        """Return the derivative of the density by the angle."""
        c, s, k = cos(angle), sin(angle), self.kappa
        a11, a12 = s * (2.0 * c + 1.0 - k), c * (2.0 * c - k + 1.0) - 2.0 * s * s
        a22 = s * (k - 1.0 - 6.0 * c)
        return a11 * load.K_I**2 + 2.0 * a12 * load.K_I * load.K_II + a22 * load.K_II**2

    def _minimum(self, load, away, low, high):
        for _ in range(60):
            middle = 0.5 * (low + high)
            falling = away * self._slope(load, away * middle) < 0.0
            low, high = (middle, high) if falling else (low, middle)
        return 0.5 * (low + high)
