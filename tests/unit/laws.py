"""One of every law, and a particle that is strained by the step's own code without compiling."""

import numpy as np

from cramp_cli.build.laws import cone, law_of
from cramp_cli.deck.anisotropic import OrthotropicSection
from cramp_cli.materials.drucker_prager import DruckerPrager
from cramp_cli.materials.elastic import Elastic
from cramp_cli.materials.geometry import PlaneStrain, PlaneStress
from cramp_cli.materials.hardening import (
    JohnsonCook,
    LinearHardening,
    PowerHardening,
    VoceHardening,
)
from cramp_cli.materials.j2_plastic import J2Plastic
from cramp_cli.materials.law import memory
from cramp_cli.materials.mooney_rivlin import MooneyRivlin
from cramp_cli.materials.neo_hookean import NeoHookean
from cramp_cli.materials.viscoelastic import Viscoelastic
from cramp_cli.state.particles import particles_at
from cramp_cli.transfer.to_particles import strain_one

E, NU = 200.0, 0.3  # the unit of stress is that of E; yield at 1 % of it or less
G, K = E / (2 * (1 + NU)), E / (3 * (1 - 2 * NU))
STEEL = Elastic(K - 2 * G / 3, G)
WOOD = OrthotropicSection(
    law="orthotropic", density=1, E1=200.0, E2=40.0, E3=20.0, nu12=0.3, nu13=0.35, nu23=0.25,
    G12=30.0, angle=25.0,
)  # fmt: skip
HARDENING = {
    "linear": LinearHardening(0.5, 4.0),
    "power": PowerHardening(0.5, 0.002, 0.2),
    "voce": VoceHardening(0.5, 1.2, 0.01),
    "johnson_cook": JohnsonCook(0.5, 1.0, 0.3, 0.02, 1.0, 1.1, 0.1, 0.05),
}
METALS = {f"j2_{name}": J2Plastic(STEEL, hardening) for name, hardening in HARDENING.items()}
RUBBERS = {
    "neo_hookean": NeoHookean(STEEL.lame, STEEL.shear),
    "mooney_rivlin": MooneyRivlin(0.3 * G, 0.2 * G, K),
}
POLYMER = Viscoelastic(STEEL, (0.3, 0.4), (0.5, 4.0))
SOIL = DruckerPrager(STEEL, cone("compression", 0.5)[0], cone("compression", 0.2)[0], 0.3)
LAWS = METALS | RUBBERS | {
    "elastic": STEEL,
    "orthotropic": law_of(WOOD),
    "viscoelastic": POLYMER,
    "drucker_prager": SOIL,
}  # fmt: skip
STRAIN, STRESS = PlaneStrain(1.0), PlaneStress(1.0)
AXES = (1, 1)  # a plane
PLAIN = getattr(strain_one, "py_func", strain_one)


def particle_of(law, F=(1.0, 0.0, 0.0, 1.0)):
    """Return one unstressed particle with room for what the law remembers."""
    particle = particles_at(np.zeros((1, 2)), [0], [1.0], [1.0], memory(law))
    particle.F[0] = F
    return particle


def strain(particle, law, geometry, dU, dt=1.0):
    """Strain a particle by the step dU (2 x 2) of the displacement gradient."""
    particle.L[0] = np.ravel(dU) / dt
    PLAIN(particle, 0, law, geometry, AXES, dt)


def stress_of(particle):
    """Return the Kirchhoff stress, shape (3, 3)."""
    xx, yy, zz, xy = particle.stress[0]
    return np.array([[xx, xy, 0.0], [xy, yy, 0.0], [0.0, 0.0, zz]])


def rotation(angle):
    """Return the rotation about z, shape (3, 3)."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def pull(particle, law, strains, dt=1.0, geometry=STRESS):
    """Strain along x with no stress along y; return stress and strain along y after each step.

    The strain along y is found with secants; the step is then taken.
    """
    found = []
    for change in strains:
        lateral = settle(particle, law, change, dt, geometry)
        strain(particle, law, geometry, [[change, 0.0], [0.0, lateral]], dt)
        found.append((particle.stress[0, 0], lateral))
    return np.array(found).T


def settle(particle, law, change, dt, geometry):
    """Return the strain along y that leaves no stress along y."""

    def rest(lateral):
        copy = particle._replace(
            **{name: array.copy() for name, array in particle._asdict().items()}
        )
        strain(copy, law, geometry, [[change, 0.0], [0.0, lateral]], dt)
        return copy.stress[0, 1]

    x0, x1 = 0.0, -0.3 * change if change else 1e-9
    f0, f1 = rest(x0), rest(x1)
    for _ in range(100):
        if abs(f1) < 1e-12 * E or f1 == f0:
            break
        x0, x1, f0 = x1, x1 - f1 * (x1 - x0) / (f1 - f0), f1
        f1 = rest(x1)
    return x1
