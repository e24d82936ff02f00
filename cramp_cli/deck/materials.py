"""What a deck says about materials."""

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from cramp_cli.deck.anisotropic import OrthotropicSection, TransverseSection
from cramp_cli.deck.hardening import AnyHardening
from cramp_cli.deck.solids import Elastic, Isotropic
from cramp_cli.schema.section import Section, Wrong, one_of
from cramp_cli.schema.units import Angle, Number, Stress, Time


class ElasticSection(Elastic):
    """An elastic, isotropic solid, given by E and nu or by K and G."""

    law: Literal["elastic"] = Field("elastic", description="kind of material")


class J2PlasticSection(Elastic):
    """A metal: elastic until its von Mises stress reaches the yield stress, which may rise."""

    law: Literal["j2_plastic"] = Field("j2_plastic", description="kind of material")
    hardening: AnyHardening = Field(description="yield stress and how it rises")


class NeoHookeanSection(Elastic):
    """Rubber, for large strains; the constants are those of small strains."""

    law: Literal["neo_hookean"] = Field("neo_hookean", description="kind of material")


class MooneyRivlinSection(Isotropic):
    """Rubber, for large strains, nearly incompressible."""

    law: Literal["mooney_rivlin"] = Field("mooney_rivlin", description="kind of material")
    C10: Stress = Field(gt=0, description="constant of the first invariant")
    C01: Stress = Field(0.0, ge=0, description="constant of the second invariant")
    K: Stress = Field(gt=0, description="bulk modulus")

    @property
    def shear(self) -> float:
        """Shear modulus of small strains (Pa)."""
        return 2.0 * (self.C10 + self.C01)

    @property
    def young(self) -> float:
        """Young's modulus of small strains (Pa)."""
        return 9.0 * self.K * self.shear / (3.0 * self.K + self.shear)

    @property
    def poisson(self) -> float:
        """Poisson's ratio of small strains."""
        return (3.0 * self.K - 2.0 * self.shear) / (6.0 * self.K + 2.0 * self.shear)

    def wrong_values(self) -> Iterator[Wrong]:
        """A solid that thickens when it is pulled is none."""
        if self.poisson <= 0.0:
            least = 2.0 * self.shear / 3.0
            yield ("K",), f"must be above 4 (C10 + C01)/3 = {least:.6g} Pa (got {self.K:g} Pa)"


class PronySection(Section):
    """A part of the shear modulus that relaxes."""

    share: Number = Field(gt=0, le=1, description="part of the shear modulus")
    time: Time = Field(gt=0, description="time in which it falls to 1/e")


Prony = Annotated[tuple[PronySection, ...], Field(min_length=1, max_length=12)]


class ViscoelasticSection(Elastic):
    """A polymer: its shear modulus relaxes in time, its bulk modulus does not.

    The elastic constants are those of a fast strain, before anything has relaxed.
    """

    law: Literal["viscoelastic"] = Field("viscoelastic", description="kind of material")
    prony: Prony = Field(description="parts of the shear modulus that relax")

    def wrong_values(self) -> Iterator[Wrong]:
        """No more than the whole modulus relaxes; without K nothing can grow."""
        if self.toughness is not None:
            yield ("toughness",), "does not go with viscoelastic, where K is not known; remove it"
        total = sum(part.share for part in self.prony)
        if total > 1.0 + 1e-12:
            yield ("prony",), f"the shares must sum to at most 1 (got {total:.6g})"


class DruckerPragerSection(Elastic):
    """Soil, rock or concrete: the shear stress it bears rises with the pressure."""

    law: Literal["drucker_prager"] = Field("drucker_prager", description="kind of material")
    cohesion: Stress = Field(ge=0, description="shear stress borne without pressure")
    friction_angle: Angle = Field(ge=0, lt=90, description="angle of internal friction")
    dilation_angle: Angle = Field(0.0, ge=0, lt=90, description="angle of the plastic flow")
    match: Literal["compression", "tension", "plane_strain"] = Field(
        "compression", description="where the cone meets the surface of Mohr and Coulomb"
    )

    def wrong_values(self) -> Iterator[Wrong]:
        """Flow steeper than the cone would make energy; without both there is no strength."""
        if self.dilation_angle > self.friction_angle:
            got = f"(got {self.dilation_angle:g} and {self.friction_angle:g} degrees)"
            yield ("dilation_angle",), f"must be at most friction_angle {got}"
        if self.cohesion == 0.0 and self.friction_angle == 0.0:
            yield ("cohesion",), "must be above 0 if friction_angle is 0 (got 0)"


AnyMaterial = one_of(
    "law",
    ElasticSection,
    J2PlasticSection,
    NeoHookeanSection,
    MooneyRivlinSection,
    OrthotropicSection,
    TransverseSection,
    ViscoelasticSection,
    DruckerPragerSection,
)
