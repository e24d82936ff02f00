"""From the `propagation` section of a deck to criteria and laws with numbers."""

from math import hypot, inf, isnan

from cramp_cli.cracks.criteria.critical_j import CriticalJ
from cramp_cli.cracks.criteria.directions import DIRECTIONS
from cramp_cli.cracks.criteria.empirical import Empirical
from cramp_cli.cracks.criteria.max_ctod import MaxCtod
from cramp_cli.cracks.criteria.max_energy_release_rate import MaxEnergyReleaseRate
from cramp_cli.cracks.criteria.max_hoop_stress import MaxHoopStress
from cramp_cli.cracks.criteria.steady_state import SteadyState
from cramp_cli.cracks.criteria.strain_energy_density import StrainEnergyDensity
from cramp_cli.cracks.domain import hooke_of
from cramp_cli.cracks.grow import Propagation, Resistance
from cramp_cli.cracks.rayleigh import rayleigh_speed, wave_speeds
from cramp_cli.cracks.speed import EnergyBalance, Prescribed, RisingToughness, ToughnessTable


def build_propagation(deck, blocks, geometry) -> Propagation | None:
    """Return how the cracks of a deck grow; None if they do not."""
    section = deck.propagation
    if section is None:
        return None
    resistance = {b.material: _resistance(deck, b, geometry) for b in blocks if b.law is not None}
    x, y = section.toward or (1.0, 0.0)
    chosen = section.cracks
    return Propagation(
        resistance={name: one for name, one in resistance.items() if one is not None},
        interfaces={frozenset(one.between): one.G_Ic for one in deck.interfaces},
        speed=_speed(section.speed),
        piece=section.piece,
        cracks=tuple(chosen is None or crack.name in chosen for crack in deck.cracks),
        direction=DIRECTIONS[section.direction],
        toward=(x / hypot(x, y), y / hypot(x, y)),
        fastest=section.fastest,
        longest=section.max_length or inf,
        begin=_or_never(section.begin),
        steady=section.criterion == "steady_state",
    )


def _resistance(deck, block, geometry) -> Resistance | None:
    """Return what a material sets against growth; None if it does not break."""
    material, section = deck.materials[block.material], deck.propagation
    hooke = hooke_of(block.law, geometry)
    if isnan(hooke.shear):  # no K, no wave speeds of an isotropic solid
        return None
    criterion = _criterion(deck, section, material, hooke)
    if criterion is None:
        return None
    speeds = wave_speeds(hooke.shear, hooke.kappa, block.density)
    G_Ic = material.G_Ic_of(deck.analysis)
    return Resistance(criterion, inf if G_Ic is None else G_Ic, rayleigh_speed(*speeds))


def _criterion(deck, section, material, hooke):
    """Return the criterion with the numbers of a material; None if it lacks them."""
    tough, kind = material.toughness, section.criterion
    if kind == "steady_state":
        return SteadyState(_or_never(material.G_Ic_of(deck.analysis)))
    if tough is None or tough.lacks(kind):
        return None
    K_Ic, G_Ic = material.K_Ic_of(deck.analysis), material.G_Ic_of(deck.analysis)
    make = {
        "max_hoop_stress": lambda: MaxHoopStress(K_Ic),
        "max_energy_release_rate": lambda: MaxEnergyReleaseRate(K_Ic),
        "strain_energy_density": lambda: StrainEnergyDensity(K_Ic, hooke.kappa),
        "empirical": lambda: Empirical(K_Ic, tough.K_IIc, section.p or 2.0, section.q or 2.0),
        "max_ctod": lambda: MaxCtod(_or_never(tough.delta_Ic), _or_never(tough.delta_IIc)),
        "critical_J": lambda: CriticalJ(G_Ic),
    }
    return make[kind]()


def _speed(section):
    make = {
        "toughness": lambda: RisingToughness(),
        "energy_balance": lambda: EnergyBalance(),
        "table": lambda: ToughnessTable(section.speeds, section.factors),
        "prescribed": lambda: Prescribed(section.value),
    }
    return make[section.law]()


def _or_never(value):
    return inf if value is None else value
