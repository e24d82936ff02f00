"""Numbers of a deck: a plain number in SI, or a text that carries its unit.

`Length`, `Stress` and the others are types for the fields of a section. Whatever the deck says,
the field then holds a finite float in SI; angles alone are in degrees, as people write them.
"""

import math
from dataclasses import dataclass
from typing import Annotated

from pydantic import Field
from pydantic_core import PydanticCustomError, core_schema

from cramp_cli.schema.unit_text import UnitError, base_units, split

SMALLEST, LARGEST = 1e-30, 1e30  # beyond, squares and ratios would leave the floats


@dataclass(frozen=True)
class Quantity:
    """What a number means: its name, the unit of a plain number, and an example of a text."""

    name: str
    unit: str
    example: str

    def number(self, value: object) -> float:
        """Return `value` in this quantity's own unit, or say what is wrong with it."""
        if isinstance(value, str):
            return self._from_text(value)
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise complaint(f"must be {self.kind}: {self.accepted}", value)
        return _finite(value, value)

    @property
    def kind(self) -> str:
        """The name with its article."""
        return f"{'an' if self.name[0] in 'aeiou' else 'a'} {self.name}"

    @property
    def accepted(self) -> str:
        """The forms a deck may use, in words."""
        if not self.unit:
            return "a plain number"
        return f"a number in {self.unit} or text with a unit such as '{self.example}'"

    def _from_text(self, text: str) -> float:
        try:
            number, unit = split(text)
        except UnitError:
            raise complaint(f"must be {self.kind}: {self.accepted}", text) from None
        if not self.unit:
            rest = "without a unit" if unit else "without quotes"
            raise complaint(f"must be a plain number {rest}", text)
        if not unit:
            raise complaint(
                f"'{text}' has no unit; drop the quotes (a plain number is in {self.unit}) "
                f"or add a unit, as in '{self.example}'"
            )
        try:
            scale, powers = base_units(unit)
        except UnitError as problem:
            raise complaint(f"'{text}' is no {self.name}: {problem}") from None
        except (ArithmeticError, ValueError):
            raise complaint("must be a finite number", text) from None
        own_scale, own_powers = base_units(self.unit)
        if not _same(powers, own_powers):
            raise complaint(f"'{text}' is no {self.name}; give {self.unit} or a unit of that kind")
        return _finite(number * scale / own_scale, text)

    def __get_pydantic_core_schema__(self, source, handler):
        """Convert first, then check the bounds that a field may set."""
        return core_schema.no_info_before_validator_function(self.number, handler(source))

    def __get_pydantic_json_schema__(self, schema, handler):
        """Show editors both forms: number, or text that begins with a number."""
        number = handler(schema)
        if not self.unit:
            return number
        text = {"type": "string", "pattern": r"^\s*[+-]?[0-9.]+([eE][+-]?[0-9]+)?\s*\S.*$"}
        return {"anyOf": [number, text], "title": f"{self.name} (SI: {self.unit})"}


def complaint(message: str, *got: object) -> PydanticCustomError:
    """Return an error whose message is used as it stands, with the value that was found."""
    if got:
        message = f"{message} (got {shown(got[0])})"
    return PydanticCustomError("cramp", "{message}", {"message": message})


def shown(value: object) -> str:
    """Return a value as people read it in a message."""
    if value is None:
        return "nothing"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, dict):
        return "a section of keys"
    if isinstance(value, list | tuple):
        return f"a list of {len(value)}"
    if isinstance(value, int) and abs(value) > 10**30:
        return "a number too large"
    text = f"'{value}'" if isinstance(value, str) else f"{value}"
    text = text.replace("\n", " ")
    return text if len(text) <= 60 else f"{text[:56]}...'"


def _finite(value: object, got: object) -> float:
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if not math.isfinite(number):
        raise complaint("must be a finite number", got)
    if number and not SMALLEST <= abs(number) <= LARGEST:
        raise complaint(f"must be 0 or between {SMALLEST:g} and {LARGEST:g} in size (SI)", got)
    return number


def _same(powers: dict[str, float], others: dict[str, float]) -> bool:
    names = powers.keys() | others.keys()
    return all(abs(powers.get(name, 0.0) - others.get(name, 0.0)) < 1e-9 for name in names)


Number = Annotated[float, Quantity("number", "", "0.3")]
Length = Annotated[float, Quantity("length", "m", "2.4 mm")]
Time = Annotated[float, Quantity("time", "s", "0.5 ms")]
Velocity = Annotated[float, Quantity("velocity", "m/s", "20 mm/s")]
Acceleration = Annotated[float, Quantity("acceleration", "m/s^2", "9.81 m/s^2")]
AngularVelocity = Annotated[float, Quantity("angular velocity", "rad/s", "30 rpm")]
Angle = Annotated[float, Quantity("angle", "deg", "0.5 rad")]
Frequency = Annotated[float, Quantity("frequency", "Hz", "2 kHz")]
Damping = Annotated[float, Quantity("damping rate", "1/s", "25 1/s")]
Force = Annotated[float, Quantity("force", "N", "3 kN")]
Stress = Annotated[float, Quantity("stress", "Pa", "12 GPa")]
StrainRate = Annotated[float, Quantity("strain rate", "1/s", "1 1/s")]
Temperature = Annotated[float, Quantity("temperature", "K", "293 K")]
SpecificHeat = Annotated[float, Quantity("specific heat", "J/kg/K", "385 J/kg/K")]
Density = Annotated[float, Quantity("density", "kg/m^3", "1.2 g/cm^3")]
EnergyToughness = Annotated[float, Quantity("energy per area", "J/m^2", "300 J/m^2")]
InterfaceStiffness = Annotated[float, Quantity("stiffness of faces", "Pa/m", "10 GPa/mm")]
StressIntensity = Annotated[float, Quantity("stress intensity", "Pa*m^0.5", "1.5 MPa*m^0.5")]


def pair(kind: object) -> object:
    """Return the type of a list of two numbers, one for each coordinate."""
    return Annotated[tuple[kind, ...], Field(min_length=2, max_length=2)]


Point = pair(Length)
