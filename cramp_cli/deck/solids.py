"""What all materials of a deck have in common, and what the isotropic ones have."""

from collections.abc import Iterator

from pydantic import Field

from cramp_cli.schema.section import Section, Wrong, only_one
from cramp_cli.schema.units import Density, EnergyToughness, Number, Stress, StressIntensity


class Toughness(Section):
    """What a crack needs to grow: a stress intensity or an energy per area."""

    K_Ic: StressIntensity | None = Field(
        None, gt=0, description="critical stress intensity, mode I"
    )
    G_Ic: EnergyToughness | None = Field(None, gt=0, description="critical energy release rate")

    @classmethod
    def wrong_keys(cls, keys: set[str]) -> Iterator[Wrong]:
        """One of the two is enough; both could contradict each other."""
        yield from only_one(keys, ("K_Ic", "G_Ic"))


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
        """Critical stress intensity in mode I (Pa m^0.5); None without toughness."""
        if self.toughness is None:
            return None
        if self.toughness.K_Ic is not None:
            return self.toughness.K_Ic
        return (self.toughness.G_Ic * self.plane_modulus(analysis)) ** 0.5

    def G_Ic_of(self, analysis: str) -> float | None:  # noqa: N802 (the word of the field)
        """Critical energy release rate in mode I (J/m^2); None without toughness."""
        if self.toughness is None:
            return None
        if self.toughness.G_Ic is not None:
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
