"""What a deck says about the growth of cracks."""

from collections.abc import Iterator
from math import hypot
from typing import Literal

from pydantic import Field

from cramp_cli.deck.cohesive import AnyTraction
from cramp_cli.schema.section import Name, Section, Wrong, one_of
from cramp_cli.schema.units import EnergyToughness, Length, Number, Time, Velocity, pair, shown

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


Criterion = Literal[
    "max_hoop_stress",
    "max_energy_release_rate",
    "strain_energy_density",
    "empirical",
    "max_ctod",
    "critical_J",
    "steady_state",
]
ONLY_WITH = {"p": "empirical", "q": "empirical", "begin": "steady_state"}


class InterfaceSection(Section):
    """The bond of two materials, where it has a toughness of its own.

    Without one a crack along the interface needs the toughness of the weaker material.
    """

    between: tuple[Name, Name] = Field(description="names of both materials")
    G_Ic: EnergyToughness = Field(gt=0, description="critical energy release rate along it")


class PropagationSection(Section):
    """When cracks grow, where to and how fast; without this section they do not."""

    criterion: Criterion = Field(description="when a crack grows, and where to")
    direction: Literal["own", "self_similar", "normal_to_cod", "initial", "given"] = Field(
        "own",
        description="where to: by the criterion (the last three of them: straight on), straight "
        "on, normal to the opening, as at the start, or `toward`",
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
    traction: AnyTraction | None = Field(
        None,
        description="traction law between the new faces; that of the end of the crack if not given",
    )
    p: Number | None = Field(
        None, gt=0, le=100, description="exponent of K_I/K_Ic in `criterion: empirical`; 2"
    )
    q: Number | None = Field(
        None, gt=0, le=100, description="exponent of K_II/K_IIc in `criterion: empirical`; 2"
    )
    begin: Time | None = Field(
        None,
        ge=0,
        description="with `criterion: steady_state` a crack runs from this time on at the latest",
    )

    def wrong_values(self) -> Iterator[Wrong]:
        """Keys that go with one criterion or direction, and that they need."""
        if self.direction == "given" and self.toward is None:
            yield ("toward",), "is missing; it goes with direction: given"
        if self.toward is not None and self.direction != "given":
            yield ("toward",), f"goes with direction: given only (got {shown(self.direction)})"
        if self.toward is not None and hypot(*self.toward) == 0.0:
            yield ("toward",), "must not be [0, 0]"
        for key, criterion in ONLY_WITH.items():
            if getattr(self, key) is not None and self.criterion != criterion:
                found = f"got {shown(self.criterion)}"
                yield (key,), f"goes with criterion: {criterion} only ({found})"
        if self.criterion == "steady_state" and self.speed.law != "prescribed":
            message = "must be {law: prescribed, value: ...} with criterion: steady_state"
            yield ("speed",), f"{message} (got {shown(self.speed.law)})"
