"""What a deck says about contact: of the two faces of a crack, and between bodies."""

from collections.abc import Iterator
from typing import Literal

from pydantic import Field

from cramp_cli.schema.section import Name, Section, Wrong, one_of
from cramp_cli.schema.units import Number, Stress

LAW = "kind of contact"


class Frictional(Section):
    """Faces that touch slide with Coulomb friction; open ones are free."""

    law: Literal["frictional"] = Field("frictional", description=LAW)
    mu: Number = Field(0.0, ge=0, description="coefficient of sliding friction")
    mu_static: Number | None = Field(
        None, ge=0, description="coefficient before sliding begins; `mu` if not given"
    )

    def wrong_values(self) -> Iterator[Wrong]:
        """Rest holds at least as well as sliding."""
        if self.mu_static is not None and self.mu_static < self.mu:
            yield ("mu_static",), f"must be at least mu ({self.mu:g}) (got {self.mu_static:g})"


class Ignore(Section):
    """Faces pass through each other."""

    law: Literal["ignore"] = Field("ignore", description=LAW)


class Stick(Section):
    """Faces that touch move together; open ones are free."""

    law: Literal["stick"] = Field("stick", description=LAW)


class Glued(Section):
    """Faces always move together, as if there were no crack."""

    law: Literal["glued"] = Field("glued", description=LAW)


class Adhesive(Section):
    """Bodies that have touched move together until that takes more than a strength."""

    law: Literal["adhesive"] = Field("adhesive", description=LAW)
    strength: Stress = Field(gt=0, description="stress normal to the contact that pulls them apart")
    shear_strength: Stress | None = Field(
        None, gt=0, description="stress along it that does; `strength` if not given"
    )
    mu: Number = Field(0.0, ge=0, description="coefficient of friction once they have parted")


AnyContact = one_of("law", Frictional, Ignore, Stick, Glued)
BodyLaw = one_of("law", Frictional, Ignore, Stick, Glued, Adhesive)


class PairContact(Section):
    """Contact of two bodies."""

    bodies: tuple[Name, Name] = Field(description="names of the two bodies")
    contact: BodyLaw = Field(description="their law")


class ContactSection(Section):
    """How faces of cracks and bodies act on each other."""

    cracks: AnyContact = Field(
        default_factory=Frictional, description="the two faces of a crack, unless it says otherwise"
    )
    bodies: BodyLaw | None = Field(
        None, description="any two bodies; if not given, bodies that meet are one solid"
    )
    groups: tuple[tuple[Name, ...], ...] = Field(
        (), description="bodies that stay one solid, such as [[core, shell]]; with `bodies`"
    )
    pairs: tuple[PairContact, ...] = Field(
        (), description="pairs of bodies with a law of their own; with `bodies`"
    )
    normal: Literal["logistic", "average", "larger"] = Field(
        "logistic",
        description="normals between bodies: of the plane that best parts their particles, or "
        "gradients of the volume: the mean of both, the larger one; beside a rigid body, away from "
        "its corners, that of its shape counts",
    )

    def wrong_values(self) -> Iterator[Wrong]:
        """What is said about bodies goes with their contact."""
        for key in ("groups", "pairs", "normal"):
            given = getattr(self, key) != type(self).model_fields[key].default
            if given and self.bodies is None:
                yield (key,), "goes with bodies, such as bodies: {law: frictional, mu: 0.2}"
