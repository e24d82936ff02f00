"""What all materials of a deck have in common, and what the isotropic ones have."""

from collections.abc import Iterator

from pydantic import Field

from cramp_cli.schema.section import Section, Wrong, listed
from cramp_cli.schema.units import (
    Density,
    EnergyToughness,
    Length,
    Number,
    Stress,
    StressIntensity,
)

AGREE = 0.01  # K_Ic and G_Ic of one material may differ by this share of G_Ic
NEEDED = {  # by a criterion of growth: one of each group
    "max_hoop_stress": (("K_Ic", "G_Ic"),),
    "max_energy_release_rate": (("K_Ic", "G_Ic"),),
    "strain_energy_density": (("K_Ic", "G_Ic"),),
    "empirical": (("K_Ic", "G_Ic"), ("K_IIc",)),
    "max_ctod": (("delta_Ic", "delta_IIc"),),
    "critical_J": (("K_Ic", "G_Ic"),),
    "steady_state": (("K_Ic", "G_Ic"),),
}


class Toughness(Section):
    """What a crack needs to grow; K_Ic or G_Ic, and what the criterion asks for."""

    K_Ic: StressIntensity | None = Field(
        None, gt=0, description="critical stress intensity, mode I"
    )
    G_Ic: EnergyToughness | None = Field(None, gt=0, description="critical energy release rate")
    K_IIc: StressIntensity | None = Field(
        None, gt=0, description="critical stress intensity, mode II (criterion: empirical)"
    )
    delta_Ic: Length | None = Field(None, gt=0, description="critical opening (max_ctod)")
    delta_IIc: Length | None = Field(None, gt=0, description="critical sliding (max_ctod)")

    @classmethod
    def wrong_keys(cls, keys: set[str]) -> Iterator[Wrong]:
        """It says something."""
        if not keys & set(cls.model_fields):
            yield (), f"give one of {listed(cls.model_fields)}"

    def lacks(self, criterion: str) -> list[str]:
        """Return what a criterion of growth needs and is not given, one text for each."""
        groups = NEEDED[criterion]
        given = self.model_fields_set
        return [" or ".join(group) for group in groups if not given & set(group)]


class Solid(Section):
    """A material."""

    law: str = Field(description="kind of material")  # first of the keys in every law
    density: Density = Field(gt=0, description="mass per volume")


class Isotropic(Solid):
    """A solid with two elastic constants, `young` and `poisson`, of small and fast strains."""

    toughness: Toughness | None = Field(None, description="resistance against crack growth")

    def plane_modulus(self, analysis: str) -> float:
        """E' of K^2 = G E' (Pa): E in plane stress, E / (1 - nu^2) in plane strain."""
        return self.young if analysis == "plane_stress" else self.young / (1.0 - self.poisson**2)

    def K_Ic_of(self, analysis: str) -> float | None:  # noqa: N802 (the word of the field)
        """Critical stress intensity in mode I (Pa m^0.5); None if it is not known."""
        G_Ic = self.G_Ic_of(analysis)
        if self.toughness is not None and self.toughness.K_Ic is not None:
            return self.toughness.K_Ic
        return None if G_Ic is None else (G_Ic * self.plane_modulus(analysis)) ** 0.5

    def G_Ic_of(self, analysis: str) -> float | None:  # noqa: N802 (the word of the field)
        """Critical energy release rate in mode I (J/m^2); None if it is not known."""
        if self.toughness is None:
            return None
        if self.toughness.G_Ic is not None or self.toughness.K_Ic is None:
            return self.toughness.G_Ic
        return self.toughness.K_Ic**2 / self.plane_modulus(analysis)


class Elastic(Isotropic):
    """Two elastic constants, given by E and nu or by K and G."""

    E: Stress | None = Field(None, gt=0, description="Young's modulus")
    nu: Number | None = Field(None, gt=-1, lt=0.5, description="Poisson's ratio")
    K: Stress | None = Field(None, gt=0, description="bulk modulus")
    G: Stress | None = Field(None, gt=0, description="shear modulus")

    @classmethod
    def wrong_keys(cls, keys: set[str]) -> Iterator[Wrong]:
        """Exactly one pair of constants."""
        given = {"E", "nu", "K", "G"} & keys
        if given in ({"E", "nu"}, {"K", "G"}):
            return
        partner = {"E": "nu", "nu": "E", "K": "G", "G": "K"}
        if len(given) == 1:
            yield (partner[min(given)],), f"is missing; it goes with {min(given)}"
        else:
            yield (), "give E and nu, or K and G"

    @property
    def young(self) -> float:
        """Young's modulus (Pa)."""
        return self.E if self.E is not None else 9.0 * self.K * self.G / (3.0 * self.K + self.G)

    @property
    def poisson(self) -> float:
        """Poisson's ratio."""
        if self.nu is not None:
            return self.nu
        return (3.0 * self.K - 2.0 * self.G) / (2.0 * (3.0 * self.K + self.G))

    @property
    def shear(self) -> float:
        """Shear modulus (Pa)."""
        return self.G if self.G is not None else 0.5 * self.E / (1.0 + self.nu)

    @property
    def lame(self) -> float:
        """First Lame constant (Pa)."""
        if self.K is not None:
            return self.K - 2.0 * self.G / 3.0
        return self.E * self.nu / ((1.0 + self.nu) * (1.0 - 2.0 * self.nu))
