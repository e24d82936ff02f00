"""What a deck says about traction laws: stresses between the faces of a crack that part."""

from collections.abc import Iterator
from math import exp, sqrt
from typing import Annotated, Literal

from pydantic import Field

from cramp_cli.schema.curve import Constant, Curve
from cramp_cli.schema.section import Section, Wrong, listed, one_of
from cramp_cli.schema.units import (
    EnergyToughness,
    InterfaceStiffness,
    Length,
    Number,
    Stress,
)

LAW = "kind of traction law"
LIMIT = 0.2  # elastic limit over critical opening, if no stiffness is given
SECOND = "faces that slide; as `normal` if not given"
POWER = "p in (G_I/G_Ic)^p + (G_II/G_IIc)^p = 1"
Power = Annotated[Number, Field(ge=1, le=100)]


class ModeSection(Section):
    """One mode of a law: two of peak, toughness and opening."""

    peak: Stress | None = Field(None, gt=0, description="largest stress")
    toughness: EnergyToughness | None = Field(None, gt=0, description="energy to part the faces")
    opening: Length | None = Field(None, gt=0, description="opening or sliding at which they part")

    @classmethod
    def wrong_keys(cls, keys: set[str]) -> Iterator[Wrong]:
        """Two of three: the third follows."""
        names = ("peak", "toughness", "opening")
        given = [name for name in names if name in keys]
        if len(given) < 2:
            yield (), f"give two of {listed(names)} (got {listed(given) or 'none'})"
        if len(given) > 2:
            yield (given[2],), f"follows from peak and toughness; give two of {listed(names)}"


class SofteningModeSection(ModeSection):
    """One mode of a law that is elastic at first: two of peak, toughness and opening."""

    stiffness: InterfaceStiffness | None = Field(
        None,
        gt=0,
        description="stress per opening at first; the peak is reached at a fifth of the critical "
        "opening if not given",
    )

    def numbers(self, fullness: float) -> tuple[float, float, float]:
        """Return stiffness (Pa/m), peak (Pa) and toughness (J/m^2).

        fullness: twice the area under the falling part, for a peak and a length of one
        """
        f, s, G, d, k = fullness, self.peak, self.toughness, self.opening, self.stiffness
        if k is None:
            area = 0.5 * (LIMIT + f * (1.0 - LIMIT))  # G = area s d
            s = G / (area * d) if s is None else s
            d = G / (area * s) if d is None else d
            return s / (LIMIT * d), s, area * s * d if G is None else G
        if s is None:  # (1 - f) s^2/k + f d s = 2 G
            s = 4.0 * G / (f * d + sqrt((f * d) ** 2 + 8.0 * (1.0 - f) * G / k))
        return k, s, 0.5 * s * (s / k + f * (d - s / k)) if G is None else G

    def too_soft(self, fullness: float) -> Iterator[Wrong]:
        """Yield a stiffness with which the law would be parted before it reaches its peak."""
        k, s, G = self.numbers(fullness)
        least = s * s / (2.0 * G)
        if k < (1.0 - 1e-9) * least:
            message = f"must be at least peak^2/(2 toughness) = {least:.5g} Pa/m (got {k:.5g} Pa/m)"
            yield ("stiffness",), message


class ElasticTractionSection(Section):
    """Stress in proportion to opening and sliding, for ever: a thin layer of glue."""

    law: Literal["elastic"] = Field("elastic", description=LAW)
    normal: InterfaceStiffness = Field(gt=0, description="stress per opening")
    shear: InterfaceStiffness | None = Field(
        None, gt=0, description="stress per sliding; as `normal` if not given"
    )


class _Softening(Section):
    """A law whose modes are elastic at first."""

    @property
    def fullness(self) -> float:
        """Twice the area under the falling part, for a peak and a length of one."""
        return 1.0

    def wrong_values(self) -> Iterator[Wrong]:
        """The peak comes before the end."""
        for key in ("normal", "shear"):
            mode = getattr(self, key)
            for path, message in mode.too_soft(self.fullness) if mode is not None else ():
                yield (key, *path), message


class TriangularSection(_Softening):
    """Straight up to the peak, straight down to nothing: toughness = peak times opening / 2."""

    law: Literal["triangular"] = Field("triangular", description=LAW)
    normal: SofteningModeSection = Field(description="faces that open")
    shear: SofteningModeSection | None = Field(None, description=SECOND)
    power: Power = Field(1.0, description=POWER)


class ExponentialSection(_Softening):
    """Straight up to the peak, down as an exponential that ends at the critical opening."""

    law: Literal["exponential"] = Field("exponential", description=LAW)
    normal: SofteningModeSection = Field(description="faces that open")
    shear: SofteningModeSection | None = Field(None, description=SECOND)
    decay: Number = Field(
        4.0,
        ge=0.01,
        le=50,
        description="how steep: before its end is shifted to 0 the curve falls by exp(-decay)",
    )
    power: Power = Field(1.0, description=POWER)

    @property
    def fullness(self) -> float:
        """Twice the area under the falling part, for a peak and a length of one."""
        end = exp(-self.decay)
        return 2.0 * (1.0 / self.decay - end / (1.0 - end))


class CubicSection(Section):
    """A smooth curve with its peak at a third of the opening: toughness = 9/16 peak opening."""

    law: Literal["cubic"] = Field("cubic", description=LAW)
    normal: ModeSection = Field(description="faces that open")
    shear: ModeSection | None = Field(None, description=SECOND)
    power: Power = Field(1.0, description=POWER)


class TrilinearModeSection(Section):
    """One mode of a trilinear law: its three corners."""

    openings: tuple[Length, ...] = Field(
        min_length=3, max_length=3, description="opening or sliding at peak, knee and end"
    )
    stresses: tuple[Stress, ...] = Field(
        min_length=2, max_length=2, description="stress at peak and knee"
    )

    def wrong_values(self) -> Iterator[Wrong]:
        """It rises once and falls twice."""
        before = 0.0
        for place, opening in enumerate(self.openings):
            if opening <= before:
                yield ("openings", place), f"must be above {before:g} m (got {opening:g} m)"
            before = opening
        peak, knee = self.stresses
        if peak <= 0.0:
            yield ("stresses", 0), f"must be above 0 (got {peak:g} Pa)"
        elif not 0.0 <= knee <= peak:
            yield ("stresses", 1), f"must be 0 to the peak, {peak:g} Pa (got {knee:g} Pa)"


class TrilinearSection(Section):
    """Up to the peak, down to a knee, down to nothing: a steep fall with a long tail."""

    law: Literal["trilinear"] = Field("trilinear", description=LAW)
    normal: TrilinearModeSection = Field(description="faces that open")
    shear: TrilinearModeSection | None = Field(None, description=SECOND)
    power: Power = Field(1.0, description=POWER)


class PressureSection(Section):
    """A pressure in the crack that pushes its faces apart."""

    law: Literal["pressure"] = Field("pressure", description=LAW)
    value: Stress = Field(description="pressure; negative draws the faces together")
    in_time: Curve = Field(
        default_factory=Constant, description="what it is multiplied by, over time"
    )


AnyTraction = one_of(
    "law",
    ElasticTractionSection,
    TriangularSection,
    ExponentialSection,
    CubicSection,
    TrilinearSection,
    PressureSection,
)
