"""What a deck says about materials with axes: wood, composites."""

from collections.abc import Iterator
from math import sqrt
from typing import ClassVar, Literal

from pydantic import Field

from cramp_cli.deck.solids import Solid
from cramp_cli.schema.section import Wrong
from cramp_cli.schema.units import Angle, Number, Stress


class OrthotropicSection(Solid):
    """An elastic solid with three planes of symmetry.

    Axes 1 and 2 lie in the plane of the analysis, 3 is normal to it. nu12 is the contraction along
    2 of a bar pulled along 1.
    """

    toughness: ClassVar[None] = None  # without K nothing can grow

    law: Literal["orthotropic"] = Field("orthotropic", description="kind of material")
    E1: Stress = Field(gt=0, description="Young's modulus along axis 1")
    E2: Stress = Field(gt=0, description="along axis 2")
    E3: Stress = Field(gt=0, description="along axis 3")
    nu12: Number = Field(description="Poisson's ratio, E1 nu21 = E2 nu12")
    nu13: Number = Field(description="Poisson's ratio, E1 nu31 = E3 nu13")
    nu23: Number = Field(description="Poisson's ratio, E2 nu32 = E3 nu23")
    G12: Stress = Field(gt=0, description="shear modulus in the plane")
    angle: Angle = Field(0.0, description="of axis 1, from the x axis")

    @property
    def shears(self) -> tuple[float, float, float]:
        """Shear moduli G12, G23, G13 (Pa); the last two play no part in a plane."""
        return self.G12, self.G12, self.G12

    def wrong_values(self) -> Iterator[Wrong]:
        """The energy of every strain is positive."""
        scale = sqrt(self.E1), sqrt(self.E2), sqrt(self.E3)
        a, b = self.nu12 * scale[1] / scale[0], self.nu13 * scale[2] / scale[0]
        c = self.nu23 * scale[2] / scale[1]
        for key, size, limit in (
            ("nu12", a, scale[0] / scale[1]),
            ("nu13", b, scale[0] / scale[2]),
            ("nu23", c, scale[1] / scale[2]),
        ):
            if abs(size) >= 1.0:
                got = f"(got {getattr(self, key):g})"
                yield (key,), f"must be below sqrt(E{key[2]}/E{key[3]}) = {limit:.6g} in size {got}"
                return
        left = 1.0 - a * a - b * b - c * c - 2.0 * a * b * c
        if left <= 0.0:
            text = "nu12, nu13 and nu23 are too large together: some strains would have negative"
            yield (), f"{text} energy (1 - a^2 - b^2 - c^2 - 2abc = {left:.3g}); lower one of them"


class TransverseSection(Solid):
    """An elastic solid that is isotropic across its fibres."""

    toughness: ClassVar[None] = None

    law: Literal["transverse"] = Field("transverse", description="kind of material")
    E_axial: Stress = Field(gt=0, description="Young's modulus along the fibres")
    E_transverse: Stress = Field(gt=0, description="Young's modulus across them")
    nu_axial: Number = Field(description="contraction across the fibres of a bar pulled along them")
    nu_transverse: Number = Field(gt=-1, lt=1, description="Poisson's ratio across them")
    G_axial: Stress = Field(gt=0, description="shear modulus along the fibres")
    fibres: Literal["in_plane", "normal"] = Field(
        "in_plane", description="whether they lie in the plane of the analysis or normal to it"
    )
    angle: Angle = Field(0.0, description="of the fibres in the plane, from the x axis")

    def wrong_values(self) -> Iterator[Wrong]:
        """The energy of every strain is positive."""
        most = ((1.0 - self.nu_transverse) * self.E_axial / (2.0 * self.E_transverse)) ** 0.5
        if abs(self.nu_axial) >= most:
            limit = f"sqrt((1 - nu_transverse) E_axial / (2 E_transverse)) = {most:.6g}"
            yield ("nu_axial",), f"must be below {limit} in size (got {self.nu_axial:g})"

    def orthotropic(self) -> OrthotropicSection:
        """Return the same solid as an orthotropic one."""
        fast, slow, nu = self.E_axial, self.E_transverse, self.nu_transverse
        same = {"law": "orthotropic", "density": self.density, "angle": self.angle}
        if self.fibres == "in_plane":
            ratios = {"nu12": self.nu_axial, "nu13": self.nu_axial, "nu23": nu}
            moduli = {"E1": fast, "E2": slow, "E3": slow, "G12": self.G_axial}
        else:
            minor = self.nu_axial * slow / fast
            ratios = {"nu12": nu, "nu13": minor, "nu23": minor}
            moduli = {"E1": slow, "E2": slow, "E3": fast, "G12": 0.5 * slow / (1.0 + nu)}
        return OrthotropicSection(**same, **ratios, **moduli)
