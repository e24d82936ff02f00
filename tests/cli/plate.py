"""The deck of the tests of commands."""

PLATE = """\
cramp: 1
title: Plate with an edge crack, pulled
analysis: plane_strain
grid: {lower: [-10 mm, -30 mm], upper: [50 mm, 30 mm], cell: 2 mm}
materials:
  glass: {law: elastic, density: 2500 kg/m^3, E: 70 GPa, nu: 0.2}
bodies:
  - name: plate
    material: glass
    shape: {type: rectangle, lower: [0, -20 mm], upper: [40 mm, 20 mm]}
cracks:
  - {name: notch, points: [[0, 0], [15.3 mm, 0]], start: edge, end: tip}
boundary:
  - {name: grip, where: {y: -20 mm}, fix: [y]}
loads:
  - {type: force, body: plate, where: {y: 20 mm}, total: [0, 10 kN], in_time: step}
solver: {end_time: 20 us}
output: {every: 5 us, fields: [stress, displacement]}
"""

# Its crack begins at 9 us, bends, and leaves the plate at 95 us.
GROWING = (
    PLATE.replace("nu: 0.2}", "nu: 0.2, toughness: {K_Ic: 0.05 MPa*m^0.5}}")
    + "propagation: {criterion: max_hoop_stress}\n"
)
