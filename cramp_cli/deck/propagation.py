"""What a deck says about the growth of cracks."""

from collections.abc import Iterator
from math import hypot
from typing import Literal

from pydantic import Field

from cramp_cli.schema.section import Name, Section, Wrong, one_of
from cramp_cli.schema.units import Length, Number, Time, Velocity, pair, shown

WHEN = "when and where to a crack grows"
HOW = "how fast a tip runs"


class Toughness(Section):
    """The toughness rises with speed as K_Ic/sqrt(1 - v/c_R)."""

    law: Literal["toughness"] = Field("toughness", description=HOW)


class EnergyBalance(Section):
    """A constant fracture energy; the speed settles while a wave passes four cells."""

    law: Literal["energy_balance"] = Field("energy_balance", description=HOW)


class SpeedTable(Section):
    """The toughness as a table of the speed."""

    law: Literal["table"] = Field("table", description=HOW)
    speeds: tuple[Velocity, ...] = Field(min_length=2, description="rising speeds, the first 0")
    factors: tuple[Number, ...] = Field(
        min_length=2, description="K at these speeds over K_Ic, rising from 1"
    )

    def wrong_values(self) -> Iterator[Wrong]:
        """Both rise, together."""
        if len(self.speeds) != len(self.factors):
            found = f"got {len(self.factors)} for {len(self.speeds)} speeds"
            yield ("factors",), f"must be as many as speeds ({found})"
        for key, values, first in (("speeds", self.speeds, 0.0), ("factors", self.factors, 1.0)):
            if values[0] != first:
                yield (key, 0), f"must be {first:g} (got {values[0]:g})"
            pairs = zip(values, values[1:], strict=False)
            for place, (low, high) in enumerate(pairs, start=1):
                if high <= low:
                    yield (key, place), f"must be above the one before ({low:g}, got {high:g})"


class Prescribed(Section):
    """The same speed whenever the load suffices."""

    law: Literal["prescribed"] = Field("prescribed", description=HOW)
    value: Velocity = Field(gt=0, description="the speed")


AnySpeed = one_of("law", Toughness, EnergyBalance, SpeedTable, Prescribed)


class Propagation(Section):
    """What all criteria have in common."""

    direction: Literal["own", "self_similar", "normal_to_cod", "initial", "given"] = Field(
        "own",
        description="where to: by the criterion, straight on, normal to the opening, as at the "
        "start, or `toward`",
    )
    toward: pair(Number) | None = Field(
        None, description="direction for `direction: given`, in the undeformed body"
    )
    speed: AnySpeed = Field(default_factory=Toughness, description=HOW)
    fastest: Number = Field(
        1.0, gt=0, le=1, description="highest speed, as a share of the Rayleigh wave speed"
    )
    piece: Length | None = Field(
        None, gt=0, description="a tip turns when it has gone this far; half a cell if not given"
    )
    max_length: Length | None = Field(
        None, gt=0, description="a crack that is this long grows no more"
    )
    cracks: tuple[Name, ...] | None = Field(
        None, min_length=1, description="names of the cracks that may grow; all if not given"
    )

    def wrong_values(self) -> Iterator[Wrong]:
        """A direction that is given has a vector, and only that."""
        if self.direction == "given" and self.toward is None:
            yield ("toward",), "is missing; it goes with direction: given"
        if self.toward is not None and self.direction != "given":
            yield ("toward",), f"goes with direction: given only (got {shown(self.direction)})"
        if self.toward is not None and hypot(*self.toward) == 0.0:
            yield ("toward",), "must not be [0, 0]"


class MaxHoopStress(Propagation):
    """Across the largest hoop stress, when it is that of K_Ic."""

    criterion: Literal["max_hoop_stress"] = Field("max_hoop_stress", description=WHEN)


class MaxEnergyReleaseRate(Propagation):
    """Where a short kink releases most energy, when that is G_Ic."""

    criterion: Literal["max_energy_release_rate"] = Field(
        "max_energy_release_rate", description=WHEN
    )


class StrainEnergyDensity(Propagation):
    """Where the strain energy density is smallest, when it is that of K_Ic."""

    criterion: Literal["strain_energy_density"] = Field("strain_energy_density", description=WHEN)


class Empirical(Propagation):
    """By hoop stress, when (K_I/K_Ic)^p + (K_II/K_IIc)^q = 1."""

    criterion: Literal["empirical"] = Field("empirical", description=WHEN)
    p: Number = Field(2.0, gt=0, le=100, description="exponent of K_I/K_Ic")
    q: Number = Field(2.0, gt=0, le=100, description="exponent of K_II/K_IIc")


class MaxCtod(Propagation):
    """Straight on, when the opening near the tip is delta_Ic or the sliding delta_IIc."""

    criterion: Literal["max_ctod"] = Field("max_ctod", description=WHEN)


class CriticalJ(Propagation):
    """Straight on, when J is G_Ic."""

    criterion: Literal["critical_J"] = Field("critical_J", description=WHEN)


class SteadyState(Propagation):
    """Straight on for good at a prescribed speed, from the time when J is G_Ic or from `begin`."""

    criterion: Literal["steady_state"] = Field("steady_state", description=WHEN)
    begin: Time | None = Field(
        None, ge=0, description="the crack runs from this time on at the latest"
    )

    def wrong_values(self) -> Iterator[Wrong]:
        """Its speed is prescribed."""
        yield from super().wrong_values()
        if self.speed.law != "prescribed":
            message = "must be {law: prescribed, value: ...} with criterion: steady_state"
            yield ("speed",), f"{message} (got {shown(self.speed.law)})"


AnyPropagation = one_of(
    "criterion",
    MaxHoopStress,
    MaxEnergyReleaseRate,
    StrainEnergyDensity,
    Empirical,
    MaxCtod,
    CriticalJ,
    SteadyState,
)
