"""What a deck says about the yield stress of a metal."""

from collections.abc import Iterator
from typing import Literal

from pydantic import Field

from cramp_cli.schema.section import Section, Wrong, one_of
from cramp_cli.schema.units import Number, SpecificHeat, StrainRate, Stress, Temperature


class LinearHardeningSection(Section):
    """Yield stress Y + H times the plastic strain."""

    type: Literal["linear"] = Field("linear", description="kind of hardening")
    yield_stress: Stress = Field(gt=0, description="Y")
    modulus: Stress = Field(0.0, ge=0, description="H; 0 is perfect plasticity")


class PowerHardeningSection(Section):
    """Yield stress Y (1 + plastic strain / eps0)^n, after Swift."""

    type: Literal["power"] = Field("power", description="kind of hardening")
    yield_stress: Stress = Field(gt=0, description="Y")
    strain: Number = Field(gt=0, description="eps0")
    exponent: Number = Field(ge=0, le=1, description="n")


class VoceHardeningSection(Section):
    """Yield stress Y + (S - Y) (1 - exp(-plastic strain / eps0)), after Voce."""

    type: Literal["voce"] = Field("voce", description="kind of hardening")
    yield_stress: Stress = Field(gt=0, description="Y")
    saturation: Stress = Field(gt=0, description="S, reached after large strain")
    strain: Number = Field(gt=0, description="eps0")

    def wrong_values(self) -> Iterator[Wrong]:
        """A solid that softens has no unique answer on a grid."""
        if self.saturation < self.yield_stress:
            got = f"(got {self.saturation:g} Pa)"
            yield ("saturation",), f"must be at least yield_stress, {self.yield_stress:g} Pa {got}"


class JohnsonCookSection(Section):
    """Yield stress (A + B eps^n) (1 + C ln(rate/rate0)) (1 - T*^m), after Johnson and Cook.

    T* = (T - T_room)/(T_melt - T_room). With a specific heat each particle keeps the heat of its
    plastic work; without one the temperature stays. Below rate0 the rate does nothing.
    """

    type: Literal["johnson_cook"] = Field("johnson_cook", description="kind of hardening")
    A: Stress = Field(gt=0, description="A")
    B: Stress = Field(0.0, ge=0, description="B")
    n: Number = Field(1.0, gt=0, le=1, description="n")
    C: Number = Field(0.0, ge=0, description="C")
    rate: StrainRate = Field(1.0, gt=0, description="rate0")
    m: Number = Field(1.0, gt=0, description="m")
    room: Temperature = Field(293.0, gt=0, description="T_room")
    melt: Temperature | None = Field(None, gt=0, description="T_melt; cold without it")
    temperature: Temperature | None = Field(None, gt=0, description="T at the start")
    specific_heat: SpecificHeat | None = Field(None, gt=0, description="heat capacity per mass")
    heated: Number = Field(0.9, ge=0, le=1, description="part of plastic work that becomes heat")

    @classmethod
    def wrong_keys(cls, keys: set[str]) -> Iterator[Wrong]:
        """Heat has an effect only below a melting point."""
        for key in ("temperature", "specific_heat", "heated"):
            if key in keys and "melt" not in keys:
                yield (key,), "has no effect without melt; give T_melt too"

    def wrong_values(self) -> Iterator[Wrong]:
        """Room, start and melting point in this order."""
        if self.melt is None:
            return
        if self.melt <= self.room:
            yield ("melt",), f"must be above room, {self.room:g} K (got {self.melt:g} K)"
        elif not self.room <= self.started < self.melt:
            limits = f"{self.room:g} K and {self.melt:g} K"
            yield (
                ("temperature",),
                f"must lie between room and melt, {limits} (got {self.started:g} K)",
            )

    @property
    def started(self) -> float:
        """Temperature at the start (K)."""
        return self.room if self.temperature is None else self.temperature


AnyHardening = one_of(
    "type",
    LinearHardeningSection,
    PowerHardeningSection,
    VoceHardeningSection,
    JohnsonCookSection,
)
