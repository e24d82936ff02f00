"""What a run will take, told before anything is allocated."""

from math import ceil

from cramp_cli.build.laws import law_of
from cramp_cli.build.model import time_step, wave_speed
from cramp_cli.deck.ends import told_ends
from cramp_cli.deck.size import size_of
from cramp_cli.deck.solids import Isotropic
from cramp_cli.materials.law import memory

CHECKPOINT_BYTES = 27 * 8  # of a particle; two are kept while the next is written
FRAME_BYTES = {
    "stress": 36,
    "strain": 36,
    "displacement": 12,
    "velocity": 12,
    "acceleration": 12,
    "deformation_gradient": 36,
    "energy": 4,
    "dissipated_energy": 4,
    "plastic_strain": 4,
}
POINT_BYTES = 16  # position, body and material of a particle in a frame
PACKED = 0.6  # what compression leaves


def estimate(deck) -> dict:
    """Return what a run takes: numbers for people, and `memory_bytes`, `disk_bytes`."""
    size = size_of(deck)
    dt = time_step(deck)
    frames = deck.solver.end_time / deck.output.every + 1 if deck.output.particles else 0
    per_point = POINT_BYTES + sum(FRAME_BYTES[name] for name in deck.output.fields)
    written = frames * per_point * PACKED
    columns = max(memory(law_of(material)) for material in deck.materials.values())
    remembered = 8 * columns
    facts = {
        "cells": " x ".join(str(count) for count in size.cells),
        "particles": round(size.particles),
        "time step": f"{dt:.6g} s",
        "steps": _steps(deck.solver, dt),
    }
    for name, material in deck.materials.items():
        facts |= _material_facts(deck, name, material)
    facts |= told_ends(deck)
    return facts | {
        "memory_bytes": size.memory_bytes + int(size.particles * remembered),
        "disk_bytes": int(size.particles * (written + 3 * (CHECKPOINT_BYTES + remembered))),
    }


def _steps(solver, dt):
    """Return the number of steps; of a run that ends at rest the most it may take."""
    steps = ceil(solver.end_time / dt)
    return steps if solver.stop_when == "end_time" else f"{steps} at most; fewer if at rest before"


def _material_facts(deck, name, material) -> dict:
    if not isinstance(material, Isotropic):
        return {f"{name}: waves": f"{wave_speed(material):.5g} m/s, the fastest of all directions"}
    shear_speed = (material.shear / material.density) ** 0.5
    stiffness = material.plane_modulus(deck.analysis)
    facts = {
        f"{name}: waves": f"{wave_speed(material):.5g} m/s dilational, {shear_speed:.5g} m/s shear",
        f"{name}: K from J": f"K^2 = {stiffness:.5g} Pa * J",
    }
    if material.K_Ic_of(deck.analysis) is not None:
        K, G = material.K_Ic_of(deck.analysis), material.G_Ic_of(deck.analysis)
        facts[f"{name}: toughness"] = f"K_Ic = {K:.5g} Pa*m^0.5, G_Ic = {G:.5g} J/m^2"
    return facts
