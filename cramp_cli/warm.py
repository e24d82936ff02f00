"""Compile every kernel once, so that the next run starts at once."""

from contextlib import nullcontext
from dataclasses import replace
from itertools import cycle
from pathlib import Path

import yaml

from cramp_cli.build import build
from cramp_cli.cracks.cohesion import cohesive_energies
from cramp_cli.cracks.grow import grow
from cramp_cli.cracks.tips import sample_tips
from cramp_cli.deck.deck import check_deck
from cramp_cli.schema.mistake import Source
from cramp_cli.scratch import make_scratch
from cramp_cli.state.health import check_health
from cramp_cli.state.measures import sum_energies
from cramp_cli.step import step

DECK = """
cramp: 1
analysis: plane_strain
grid: {cell: 1}
materials: {m: {law: elastic, density: 1, E: 1, nu: 0.3, toughness: {K_Ic: 1}}}
bodies:
  - {name: b, material: m, shape: {type: rectangle, lower: [0, 0], upper: [20, 10]}}
  - {name: r, rigid: {}, shape: {type: rectangle, lower: [0, 10], upper: [4, 12]}}
contact: {bodies: {law: frictional}}
cracks: [{name: c, points: [[0, 5], [10, 5]], start: edge}]
boundary:
  - {where: {x: 20}, symmetry: true}
  - {where: {y: 0}, fix: [y]}
loads:
  - {type: force, body: b, where: {y: 10}, total: [0, 1]}
  - {type: traction, body: b, where: {y: 10}, traction: [0, 1.0e-3]}
  - {type: gravity, acceleration: [0, 0]}
solver: {end_time: 1}
fracture: {contour: {terms: 2}}
propagation:
  criterion: steady_state
  begin: 0
  speed: {law: prescribed, value: 0.1}
  traction: {law: elastic, normal: 1}
"""
ENDS = {"normal": {"peak": 1.0, "toughness": 1.0}}
KNEE = {"normal": {"openings": [1.0, 2.0, 6.0], "stresses": [4.0, 1.0]}}
TRACTIONS = (  # in turn, one with each of the settings
    {"law": "triangular", **ENDS},
    {"law": "exponential", **ENDS},
    {"law": "cubic", **ENDS},
    {"law": "trilinear", **KNEE},
    {"law": "pressure", "value": 1.0},
)
BETWEEN_LINES = {"type": "rectangle", "lower": [0, -0.2], "upper": [20, 10]}  # sized particles
SETTINGS = (
    ("plane_strain", "ugimp", "flip"),
    ("plane_strain", "ugimp", "flip", BETWEEN_LINES),
    ("plane_strain", "ugimp", "fmpm(2)"),
    ("plane_strain", "ugimp", "xpic(2)"),
    ("plane_strain", "linear", "flip"),
    ("plane_strain", "bspline2", "flip"),
    ("plane_strain", "bspline3", "flip"),
    ("plane_strain", "cpdi", "flip"),
    ("plane_stress", "ugimp", "flip"),
    ("axisymmetric", "ugimp", "flip"),
)


def run_small_cases() -> None:
    """Take a step of a small cracked body with every kind of kernel."""
    for (analysis, shape, update, *bodies), traction in zip(
        SETTINGS, cycle(TRACTIONS), strict=False
    ):
        data = yaml.safe_load(DECK)
        for body, place in zip(data["bodies"], bodies, strict=False):
            body["shape"] = place
        data["cracks"][0]["traction"] = traction
        data["analysis"] = analysis
        data["solver"] |= {"shape": shape, "update": update}
        if analysis == "axisymmetric":
            del data["propagation"]
        model, state = build(check_deck(Source("warm-up", DECK, data), Path()))
        scratch = make_scratch(model, state)
        step(replace(model, dt=1e-3), state, scratch, lambda title: nullcontext())
        for _ in range(2):  # a tip that has moved has a J of its own
            if model.propagation is not None:
                grow(model, state, scratch)
        sample_tips(model, state, scratch)
        sum_energies(state.particles)
        cohesive_energies(model, state)
        check_health(model, state)
