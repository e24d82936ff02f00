"""What a deck says about time steps, fracture analysis and output."""

import re
from collections.abc import Iterator
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, BeforeValidator, Discriminator, Field, Tag, WithJsonSchema

from cramp_cli.schema.section import TAG, Count, Flag, Section, Wrong, unknown
from cramp_cli.schema.units import Damping, Length, Number, Time, complaint

STABLE_CFL = 0.1  # bears all orders that were measured, with strain updates without a second sum
METHODS = ("flip", "pic", "fmpm(k)", "xpic(k)")
FORM = re.compile(r"(flip|pic)|(fmpm|xpic)\(([1-9][0-9]?)\)")


def _known_update(text: str) -> str:
    if FORM.fullmatch(text):
        return text
    if re.fullmatch(r"(fmpm|xpic)\b.*", text):
        raise complaint(f"must be written {text[:4]}(k) with a whole number k from 1 to 99", text)
    raise complaint(unknown("update", text, METHODS))


def _as_list(value: Any) -> Any:
    return value if isinstance(value, list | tuple | None.__class__) else [value]


Update = Annotated[str, AfterValidator(_known_update)]
Radii = Annotated[
    tuple[Length, ...],
    Field(min_length=1),
    BeforeValidator(_as_list),
    WithJsonSchema(
        {
            "title": "length (SI: m) or list of lengths",
            "anyOf": [
                {"type": "number"},
                {"type": "string"},
                {"type": "array", "items": {"anyOf": [{"type": "number"}, {"type": "string"}]}},
            ],
        }
    ),
]


class DampingSection(Section):
    """Drag in proportion to velocity."""

    grid: Damping = Field(0.0, ge=0, description="drag on the velocity of grid nodes")
    particle: Damping = Field(0.0, ge=0, description="drag on the velocity of particles")


AUTO = "auto"


def _is_damping(data: Any) -> Any:
    if isinstance(data, str) and data != AUTO:
        raise complaint(f"must be {AUTO}, or a section such as {{particle: 1000 1/s}}", data)
    return data


AnyDamping = Annotated[
    Annotated[Literal["auto"], Tag(TAG + AUTO)] | Annotated[DampingSection, Tag(TAG)],
    Discriminator(lambda data: TAG + AUTO if isinstance(data, str) else TAG),
    BeforeValidator(_is_damping),
]


class EnergySection(Section):
    """How far the energy balance may be off, as a share of the largest energy so far."""

    warn: Number = Field(0.01, gt=0, description="a run warns once above this")
    stop: Number = Field(0.1, gt=0, description="a run ends above this")

    def wrong_values(self) -> Iterator[Wrong]:
        """One warns before one stops."""
        if self.stop < self.warn:
            yield ("stop",), f"must be at least `warn` ({self.warn:g}, got {self.stop:g})"


class SolverSection(Section):
    """How the equations are solved in time."""

    end_time: Time = Field(gt=0, description="time at which the run ends, at the latest")
    stop_when: Literal["end_time", "at_rest"] = Field(
        "end_time",
        description="at_rest: the run ends when all loads are there, and K of every tip and the "
        "strain energy have settled to 1 % over a period of the slowest motion",
    )
    shape: Literal["linear", "ugimp", "bspline2", "bspline3", "cpdi"] = Field(
        "ugimp",
        description="shape functions between particles and grid: linear, uniform GIMP, "
        "B-splines of degree 2 or 3, or convected domains (CPDI) for large stretches",
    )
    tips: Literal["smooth", "sharp"] = Field(
        "smooth",
        description="how the grid feels a crack tip: smooth anywhere in its cell, or sharp by the "
        "line test alone, as in the papers and NairnMPM",
    )
    update: Update = Field(
        "flip", description="velocity update: flip, pic, fmpm(k) or xpic(k) of order k"
    )
    strain: Literal["usf", "usl-", "usl+", "usavg-", "usavg+"] = Field(
        "usavg+", description="when strain is updated: before (usf), after (usl), half and half"
    )
    damping: AnyDamping = Field(
        default_factory=DampingSection,
        description="drag; auto: on particles, near critical for the slowest motion, found while "
        "running, for a static answer",
    )
    cfl: Number = Field(0.5, gt=0, le=1, description="share of the longest stable time step")
    dt: Time | None = Field(None, gt=0, description="upper limit of the time step")
    leaving: Literal["error", "delete", "clamp"] = Field(
        "error",
        description="particles that leave the grid: end the run, are deleted, or are held at its "
        "border; the log names them",
    )
    energy_error: EnergySection = Field(
        default_factory=EnergySection, description="how far the energy balance may be off"
    )

    def wrong_values(self) -> Iterator[Wrong]:
        """Linear shape functions need the velocities of the update itself."""
        if self.shape == "linear" and self.strain in ("usl-", "usavg-"):
            better = self.strain.replace("-", "+")
            yield ("strain",), f"'{self.strain}' does not go with shape: linear; use '{better}'"

    @property
    def may_be_unstable(self) -> bool:
        """Whether steps of the usual length may grow: no second sum smooths the strain update.

        Measured in a plate without cracks, 2 particles per cell: pic grows between a cfl of 0.5 and
        0.7 with usl-, fmpm(2) between 0.25 and 0.5 with usl- and 0.5 and 0.7 with usavg-, fmpm(8)
        between 0.1 and 0.25 with usl-.
        """
        filtered = self.update_name in ("pic", "fmpm") and self.strain in ("usl-", "usavg-")
        return filtered and self.cfl > STABLE_CFL

    @property
    def tears_domains(self) -> bool:
        """Whether convected domains are strained otherwise than their centres move.

        Neighbours then lose their common corners. The bar of tests/verification/test_stretched.py,
        drawn in twice the time at a cfl of 0.3, reaches 3 times its length with flip and usavg-; it
        is uneven by a tenth at 2.8 with usl-, at 1.7 with usavg+, usf and usl+, and between 1.2 and
        1.5 with pic, fmpm(2) and xpic(2).
        """
        return self.shape == "cpdi" and (self.update, self.strain) != ("flip", "usavg-")

    @property
    def update_name(self) -> str:
        """One of flip, pic, fmpm, xpic."""
        return self.update.split("(")[0]

    @property
    def update_order(self) -> int:
        """The order k of fmpm(k) and xpic(k); 1 for pic, 0 for flip."""
        order = FORM.fullmatch(self.update)[3]
        return int(order) if order else int(self.update == "pic")


class ContourSection(Section):
    """The J integral along grid lines around a tip."""

    cells: Count = Field(2, ge=1, le=1000, description="cells from the tip to the contour")
    terms: Count = Field(
        1,
        ge=1,
        le=2,
        description="1: the contour alone; 2: and the area inside, for dynamic cracks",
    )


class FractureSection(Section):
    """When and how J, K_I and K_II are found at the tips."""

    every: Time | None = Field(
        None, gt=0, description="time between analyses; that of output if not given"
    )
    methods: tuple[Literal["domain", "contour"], ...] = Field(
        ("domain", "contour"), description="interaction integral over a domain, J on a contour"
    )
    radius: Radii | None = Field(
        None, description="one radius or a list for the domain; chosen if not given"
    )
    contour: ContourSection = Field(default_factory=ContourSection, description="the contour")
    means: bool = Field(
        False,
        description="J_mean, K_I_mean, K_II_mean as well: means over the time that a wave takes "
        "through the domain, for loads that are waves",
    )

    def wrong_values(self) -> Iterator[Wrong]:
        """Radii are positive, methods differ."""
        for place, radius in enumerate(self.radius or ()):
            if radius <= 0.0:
                yield ("radius", place), f"must be above 0 (got {radius:g} m)"
        yield from _twice("methods", self.methods)


OutputField = Literal[
    "stress",
    "strain",
    "displacement",
    "velocity",
    "acceleration",
    "deformation_gradient",
    "energy",
    "dissipated_energy",
    "plastic_strain",
]


class OutputSection(Section):
    """What is written, and how often."""

    every: Time | None = Field(
        None, gt=0, description="time between frames; a hundredth of end_time if not given"
    )
    history_every: Time | None = Field(
        None, gt=0, description="time between rows of the history; a tenth of `every` if not given"
    )
    fields: tuple[OutputField, ...] = Field(
        ("stress", "displacement", "velocity"), description="fields of the particles to write"
    )
    particles: Flag = Field(True, description="whether frames of particles are written")

    def wrong_values(self) -> Iterator[Wrong]:
        """Fields differ."""
        yield from _twice("fields", self.fields)


def _twice(key: str, words: tuple[str, ...]) -> Iterator[Wrong]:
    for place, word in enumerate(words):
        if word in words[:place]:
            yield (key, place), f"'{word}' is given twice"
