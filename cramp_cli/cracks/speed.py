"""How fast a tip runs under the load it has: one record per law."""

from dataclasses import dataclass

import numpy as np

SETTLE = 4.0  # cells a Rayleigh wave travels while the speed settles
ALMOST = 0.98  # share of the Rayleigh speed that nothing passes


@dataclass(frozen=True)
class Pull:
    """What a speed law is asked about."""

    drive: float  # load over the load at the onset
    release: float  # J over the toughness at rest
    before: float  # speed so far (m/s)
    rayleigh: float  # Rayleigh wave speed (m/s)
    dt: float  # s
    width: float  # of a cell (m)


@dataclass(frozen=True)
class RisingToughness:
    """The toughness rises with speed as K_Ic/sqrt(1 - v/c_R): v = c_R (1 - 1/drive^2).

    With the intensity of a tip at rest this is Freund's equation of motion for a constant fracture
    energy (1990, eq. 7.4.5 with g = 1 - v/c_R).
    """

    def speed(self, pull: Pull) -> float:
        """Return the speed (m/s); 0 below the onset."""
        return pull.rayleigh * (1.0 - 1.0 / pull.drive**2) if pull.drive > 1.0 else 0.0


@dataclass(frozen=True)
class EnergyBalance:
    """A constant fracture energy: the tip is faster while more than it needs flows in.

    dv/dt = (J/G_Ic - 1) c_R/tau, with tau the time in which a Rayleigh wave passes four cells: what
    happens faster the grid does not show.
    """

    def speed(self, pull: Pull) -> float:
        """Return the speed (m/s) after a step."""
        if pull.before <= 0.0 and pull.drive < 1.0:
            return 0.0
        tau = SETTLE * pull.width / pull.rayleigh
        excess = min(max(pull.release - 1.0, -1.0), 1.0)
        after = pull.before + excess * pull.rayleigh * pull.dt / tau
        return min(max(after, 0.0), ALMOST * pull.rayleigh)


@dataclass(frozen=True)
class ToughnessTable:
    """Toughness over K_Ic as a rising table of the speed; past its end the tip keeps the last."""

    speeds: tuple  # m/s, the first is 0
    factors: tuple  # K at that speed over K_Ic, rising from 1

    def speed(self, pull: Pull) -> float:
        """Return the speed (m/s) at which the toughness equals the load."""
        found = float(np.interp(pull.drive, self.factors, self.speeds))
        return min(found, ALMOST * pull.rayleigh)


@dataclass(frozen=True)
class Prescribed:
    """The same speed whenever the load suffices."""

    value: float  # m/s

    def speed(self, pull: Pull) -> float:
        """Return the speed (m/s)."""
        return min(self.value, ALMOST * pull.rayleigh) if pull.drive >= 1.0 else 0.0
