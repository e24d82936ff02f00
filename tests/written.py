"""The folder of a run that was never computed, for tests of what is done with finished runs."""

import numpy as np

from cramp_cli.deck.deck import check_deck, to_yaml
from cramp_cli.output.folder import RunFolder
from cramp_cli.output.run import RunOutputs
from cramp_cli.output.summary import Summary
from cramp_cli.schema.loader import load

PLATE = """\
cramp: 1
title: Plate with a notch
analysis: plane_strain
grid: {cell: 2 mm}
materials:
  glass: {law: elastic, density: 2500 kg/m^3, E: 70 GPa, nu: 0.2}
bodies:
  - name: plate
    material: glass
    shape: {type: rectangle, lower: [0, -8 mm], upper: [20 mm, 8 mm]}
cracks:
  - {name: notch, points: [[0, 0], [10 mm, 0]], start: edge, end: tip}
loads:
  - {type: force, body: plate, where: {y: 8 mm}, total: [0, 10 kN], in_time: step}
solver: {end_time: 2 us}
output: {every: 1 us, fields: [stress, displacement]}
"""
TIMES = (0.0, 1e-6, 2e-6)  # s
STRETCH = 100.0  # 1/s: u_y = STRETCH t y


def write_run(path, K_I=3e5, statuses=("ok", "closed", "ok")):
    """Write a run of PLATE with a frame, a row of the tip and of the history at each of TIMES.

    The plate is stretched along y and its notch opens by a share of its length.
    """
    deck = check_deck(load(PLATE), path.parent)
    texts = deck.source_text, to_yaml(deck.resolved())
    with (
        RunFolder(path, overwrite=True) as folder,
        RunOutputs(folder, *texts, end_time=2e-6) as outputs,
    ):
        for step, time in enumerate(TIMES):
            rows = write_moment(outputs, step, time, K_I * time / TIMES[-1], statuses[step])
        outputs.finish(Summary(2, TIMES[-1], 0.1, rows, 1e-5, 1e6))
    return path


def write_moment(outputs, step, time, K_I, status):
    energies = {"kinetic_energy": time, "strain_energy": 2.0 * time, "external_work": 3.0 * time}
    outputs.history(
        {
            "step": step,
            "time": time,
            "energy_error": 1e-5 * step,
            **dict.fromkeys(
                ("fracture_energy", "friction_energy", "plastic_energy", "damping_energy"), 0.0
            ),
            **dict.fromkeys(("impact_energy", "cohesive_stored", "cohesive_energy"), 0.0),
            **energies,
        }
    )
    tip = {"step": step, "time": time, "crack": "notch", "tip": "end", "x": 0.01, "y": 0.0}
    row = tip | {"J": K_I**2 / 7e10, "K_I": K_I, "K_II": 0.0, "K_I_contour": 1.1 * K_I}
    outputs.tips([row | {"status": status}])
    origin = (
        np.stack(
            [axis.ravel() for axis in np.meshgrid(np.arange(0.5, 20.0), np.arange(-7.5, 8.0))],
            axis=1,
        )
        * 1e-3
    )
    displacement = np.column_stack([np.zeros(len(origin)), STRETCH * time * origin[:, 1]])
    stress = np.zeros((len(origin), 3, 3))
    stress[:, 1, 1] = 1e9 * STRETCH * time
    fields = {"stress": stress, "displacement": displacement, "body": np.zeros(len(origin), int)}
    outputs.particle_frame(step, time, origin + displacement, fields)
    line = np.column_stack([np.linspace(0.0, 0.01, 11), np.zeros(11)])
    opening = np.column_stack([np.zeros(11), 0.1 * time / TIMES[-1] * (0.01 - line[:, 0])])
    outputs.crack_frame(step, time, [line], {"opening": opening})
    return [row | {"status": status}]
