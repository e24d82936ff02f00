"""Figures of growing cracks, as the page docs/growing.md.

    python tests/verification/growing.py > docs/growing.md

Ten minutes. `test_growth_decks.py` and `test_composite.py` assert what the page shows.
"""

import sys
from math import atan2, degrees, hypot
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import numpy as np
from runs import run_input

from cramp_cli.cracks.criteria.load import Load
from cramp_cli.cracks.criteria.max_hoop_stress import MaxHoopStress

RAYLEIGH = 2803.0  # m/s, steel of Kalthoff's plate
NOTCH = (0.05, 0.025)  # m
GRIDS = {"1 mm": (), "0.5 mm": ("grid.cell=0.5 mm",)}
PIECES = {"0.25 cells": "0.5 mm", "0.5 cells": "1 mm"}
ENERGIES = ("kinetic_energy", "strain_energy", "friction_energy")

HEAD = """# Growing cracks in figures

This page is generated: `python tests/verification/growing.py > docs/growing.md`.

## Kalthoff's plate on two grids

`inputs/denp_growth.yaml`, with cells of 1 mm and of 0.5 mm. Paths are compared as lines in the
undeformed plate.

| way from the notch | the paths are apart | K_eq off its mean over 5 mm: 1 mm | 0.5 mm |
|---|---|---|---|"""
ENERGY = """
Fracture energy $J\\,da$ that is booked, and energy that has been lost (work less strain, kinetic
energy and friction):

| time | booked, 1 mm | lost | | booked, 0.5 mm | lost | |
|---|---|---|---|---|---|---|"""
WINGS = """
## Cracked disk

`inputs/disk_growth.yaml`: how far from the load points the wing cracks leave the disk, in parts of
its radius.

| piece | start | end |
|---|---|---|"""
COMPOSITE = """
## Composite

`inputs/composite.yaml`: the largest error of the energy balance while the crack grows.

| until the tip is before the far edge by | error |
|---|---|"""


def line_of(run):
    """Return the crack of a run in the undeformed body (m), an array (points, 2)."""
    return run.state.paths.origin


def away(point, line) -> float:
    """Return how far a point is from a polyline (m)."""
    a, edge = line[:-1] - point, np.diff(line, axis=0)
    share = np.clip(-np.sum(a * edge, axis=1) / np.sum(edge * edge, axis=1), 0.0, 1.0)
    return np.hypot(*(a + share[:, None] * edge).T).min()


def apart(one, other, low, high) -> float:
    """Return how far the crack of one run is from that of another at most (m).

    Over the points of the first between two distances from the notch (m).
    """
    points, reach = line_of(one), np.hypot(*(line_of(one) - NOTCH).T)
    grown = (points[:, 1] > NOTCH[1]) & (low <= reach) & (reach < high)
    return max(away(point, line_of(other)) for point in points[grown])


def unsteadiness(run, low, high) -> float:
    """Return by what share K_eq is off its mean over 5 mm at most, between two distances (m)."""
    rows = np.array([[row[n] for n in ("x", "y", "K_I", "K_II")] for row in run.growth])
    reach = np.hypot(*(rows[:, :2] - NOTCH).T)
    K = np.array([MaxHoopStress(1.0).drive(Load(*pair)) for pair in rows[:, 2:]])
    chosen = np.flatnonzero((reach > low) & (reach < high))
    return max(abs(K[i] / K[np.abs(reach - reach[i]) < 2.5e-3].mean() - 1.0) for i in chosen)


def booked_and_lost(run, time) -> tuple[float, float]:
    """Return the fracture energy of the books and the energy that is gone at a time (J)."""
    start, row = run.history[0], min(run.history, key=lambda one: abs(one["time"] - time))
    held = sum(row[name] - start[name] for name in ENERGIES)
    return row["fracture_energy"], row["external_work"] - held


def fastest(run) -> float:
    """Return the largest speed of the tip in a run, in Rayleigh speeds."""
    return max(row["speed"] for row in run.tip("end")) / RAYLEIGH


def chord(run) -> float:
    """Return the direction from the notch to the end of the crack (degrees)."""
    last = run.growth[-1]
    return degrees(atan2(last["y"] - NOTCH[1], last["x"] - NOTCH[0]))


def ends_of_wings(run) -> dict[str, float]:
    """Return how far from its load point each wing leaves the disk, in parts of the radius."""
    ends = {row["tip"]: row for row in run.growth if row["kind"] == "edge"}
    loads = {"start": -0.05, "end": 0.05}
    return {tip: hypot(row["x"], row["y"] - loads[tip]) / 0.05 for tip, row in ends.items()}


def error_until(run, before) -> float:
    """Return the largest error of the balance until the tip is before the far edge by some m."""
    (left,) = [row for row in run.growth if row["kind"] == "edge"]
    near = [row["time"] for row in run.growth if left["x"] - row["x"] <= before]
    return max(abs(row["energy_error"]) for row in run.history if row["time"] <= near[0])


def plates() -> None:
    """Print the tables of Kalthoff's plate."""
    one, half = (run_input("denp_growth", *settings) for settings in GRIDS.values())
    print(HEAD)
    for low, high in ((5, 20), (20, 35), (35, 50), (50, 65), (65, 75)):
        span = low * 1e-3, high * 1e-3
        off = f"{1e3 * apart(one, half, *span):.2f} mm"
        shares = " | ".join(f"{100 * unsteadiness(run, *span):.1f} %" for run in (one, half))
        print(f"| {low} to {high} mm | {off} | {shares} |")
    print(ENERGY)
    for time in (30, 40, 50, 60, 80):
        cells = []
        for run in (one, half):
            booked, lost = booked_and_lost(run, time * 1e-6)
            cells.append(f"{booked:.2f} J | {lost:.2f} J | {100 * (booked / lost - 1):+.1f} %")
        print(f"| {time} us | {' | '.join(cells)} |")
    first, chords, speeds = zip(
        *((degrees(r.growth[0]["angle"]), chord(r), fastest(r)) for r in (one, half)), strict=True
    )
    print(f"\nFirst kink {first[0]:.1f} and {first[1]:.1f} degrees, ", end="")
    print(f"chord {chords[0]:.1f} and {chords[1]:.1f} degrees, ", end="")
    print(f"largest speed {speeds[0]:.2f} and {speeds[1]:.2f} of the Rayleigh speed.")


def wings() -> None:
    """Print the table of the cracked disk."""
    print(WINGS)
    for name, piece in PIECES.items():
        ends = ends_of_wings(run_input("disk_growth", f"propagation.piece={piece}"))
        print(f"| {name} | {100 * ends['start']:.2f} % | {100 * ends['end']:.2f} % |")


def composite() -> None:
    """Print the table of the composite."""
    print(COMPOSITE)
    run = run_input("composite")
    for before in (2.0, 1.0, 0.5, 0.0):
        print(f"| {before} mm | {100 * error_until(run, before * 1e-3):.1f} % |")


if __name__ == "__main__":
    plates()
    wings()
    composite()
