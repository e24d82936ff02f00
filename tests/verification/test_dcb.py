"""The double cantilever beam of Nairn (2003) and Guo and Nairn (2004), against NairnMPM itself.

The numbers are those of NairnMPM R19 for the same beam, grid, particles and time step: 100 mm x 24
mm, cells of 2 mm, E = 1 GPa, nu = 0.33, 1500 kg/m^3, plane stress, crack of 49.25 mm, 3 N at once
on each end, damping 25/s on the grid and 100/s on the particles, uGIMP, USAVG+, FLIP, frictionless
contact. (reference/dcb_J.csv; there the crack lay 1e-6 mm above the row of nodes.)
"""

import csv
from pathlib import Path

import pytest
from runs import INPUTS, run_input
from support import advance

from cramp_cli.build import build
from cramp_cli.cracks.tips import sample_tips
from cramp_cli.deck.deck import read_deck
from cramp_cli.scratch import make_scratch

pytestmark = pytest.mark.verification

K_I_AT_END = 0.579658e6  # Pa m^0.5, step 1491, n = 2, terms 1


def read_reference():
    """Return the rows of the table: step, time (s), J (J/m^2) of both forms of the contour."""
    path = Path(__file__).parent / "reference" / "dcb_J.csv"
    with path.open(encoding="utf-8") as file:
        lines = [line for line in file if not line.startswith("#")]
    return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(lines)]


def test_J_and_K_are_those_of_NairnMPM():
    """One run, sampled with the contour alone and with the inertia inside it."""
    models, found, expected = {}, {}, {}
    for terms in (1, 2):
        deck = read_deck(INPUTS / "dcb.yaml", [f"fracture.contour.terms={terms}"])
        models[terms], state = build(deck)
    scratch = make_scratch(models[2], state)
    for row in read_reference():
        advance(models[1], state, scratch, int(row["step"]) - state.step)
        assert state.time == pytest.approx(row["time"], abs=models[1].dt)
        for terms, model in models.items():
            tip = sample_tips(model, state, scratch)[0]
            found[terms, state.step] = tip["J_contour"]
            expected[terms, state.step] = row[f"J_terms_{terms}"]
            assert abs(tip["K_II_contour"]) < 1e-6 * tip["K_I_contour"]  # the beam is symmetric
            if terms == 1:
                K_I = tip["K_I_contour"]
    assert found == pytest.approx(expected, rel=0.005)
    assert K_I == pytest.approx(K_I_AT_END, rel=0.005)  # noqa: SIM300 (K_I is no constant)


def test_energy_is_kept_without_damping_and_contact():
    run = run_input(
        "dcb",
        "solver.damping={}",
        "cracks.midplane.contact={law: ignore}",
        "fracture.methods=[contour]",
        "output.particles=false",
    )
    assert abs(run.history[-1]["energy_error"]) < 0.005
    assert not run.warnings
