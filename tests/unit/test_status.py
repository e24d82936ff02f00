"""Every word of `status` in docs/theory/fracture.md, and something that makes it appear.

The bodies are at rest; where a word is about the fields, the particles are given fields.
"""

import re
from pathlib import Path

import numpy as np
import pytest
from support import build_deck, locate
from unit.test_tips import PLATE, inner, pieces, rectangle, sampled

from cramp_cli.cracks.contact import SLIDING
from cramp_cli.cracks.doubts import of_mode
from cramp_cli.cracks.tips import sample_tips
from cramp_cli.settling import Settling
from cramp_cli.state.growth import BLEND, HELD, KINK, MIXED, OWN
from cramp_cli.state.particles import DISSIPATED

PAGE = Path(__file__).resolve().parents[2] / "docs/theory/fracture.md"
EDGE = inner((0, 10), (15, 10), start="edge")
DOMAIN, CONTOUR = {"methods": ["domain"]}, {"methods": ["contour"]}
WIDE = {"methods": ["contour"], "contour": {"cells": 15}}
DAMPED = {"damping": {"particle": 1.0}}
OVER_TIME = {"K": "moving: K still changes by"}
ROW_OF_BODIES = {"bodies": pieces("soft", "soft"), "contact": {"bodies": {"law": "stick"}}}
LOADED = {"type": "traction", "body": "plate", "where": {"y": 20}, "traction": [0, 1]}
SPRINGS = {"law": "triangular", "normal": {"peak": 2, "toughness": 3}}
RING = rectangle(40, 0, 70, 20)
FIBRES = {
    "law": "transverse", "density": 1, "E_axial": 3, "E_transverse": 1, "nu_axial": 0.3,
    "nu_transverse": 0.3, "G_axial": 1,
}  # fmt: skip


# What lies around a tip: its crack, more cracks, sections of the deck, and the word.
AROUND = {
    "nothing": ([EDGE], {}, "ok"),
    "a boundary load": (
        [inner((0, 16.5), (15, 16.5), start="edge")], {"loads": [LOADED], "fracture": DOMAIN},
        "shrunk: a loaded face within 5 cells"),
    "a held boundary": (
        [inner((0, 3.5), (15, 3.5), start="edge")],
        {"boundary": [{"where": {"y": 0}, "fix": ["y"]}], "fracture": DOMAIN},
        "shrunk: a held boundary within 5 cells"),
    "a second crack": (
        [EDGE, inner((18, 2), (18, 18))], {"fracture": DOMAIN}, "shrunk: crack c1 within 5 cells"),
    "no room in one material": (
        [inner((0, 10), (14, 10), start="edge")],
        {"bodies": pieces("soft", "hard"), "fracture": DOMAIN},
        "corrected: the domain holds another material"),
    "an interface, at the tip": (
        [EDGE], {"bodies": pieces("soft", "hard"), "fracture": DOMAIN},
        "invalid: another material is nearer than"),
    "the edge of the body": (
        [inner((0, 1), (15, 1), start="edge")], {"fracture": DOMAIN},
        "invalid: the edge of the body is nearer than"),
    "a radius": (
        [EDGE], {"fracture": DOMAIN | {"radius": [2.0]}}, "invalid: the radius is below 2.5 cells"),
    "a contour beyond the grid": (
        [EDGE], {"fracture": WIDE}, "contour invalid: the contour does not fit in the grid"),
    "a contour around a whole crack": (
        [inner((14.3, 10.2), (15.5, 10.2))], {"fracture": CONTOUR},
        "contour invalid: the crack does not cross its contour"),
    "a contour and a folded crack": (
        [inner((0, 10.2), (18, 10.2), (18, 11.2), (14.2, 11.2), start="edge")],
        {"fracture": CONTOUR}, "contour invalid: the crack crosses its contour more than once"),
    "a contour and a second crack": (
        [EDGE, inner((16.2, 2), (16.2, 18))], {"fracture": CONTOUR},
        "contour invalid: another crack crosses the contour"),
    "a contour that leaves the body": (
        [inner((0, 1), (15, 1), start="edge")], {"fracture": CONTOUR},
        "contour invalid: the contour leaves the body"),
    "a contour with an interface": (
        [inner((0, 10), (14, 10), start="edge")],
        {"bodies": pieces("soft", "hard"), "fracture": CONTOUR},
        "contour invalid: another material lies within the contour"),
    "a contour with another body": (
        [inner((0, 10), (14, 10), start="edge")], ROW_OF_BODIES | {"fracture": CONTOUR},
        "contour invalid: another body is at the contour"),
    "a contour and stressed faces": (
        [EDGE | {"traction": SPRINGS}], {"fracture": CONTOUR},
        "contour invalid: stresses act on the faces"),
    "half a body": (
        [inner((0, 0), (15, 0), start="edge", contact={"law": "ignore"})],
        {"bodies": [{"name": "half", "material": "soft", "shape": rectangle(0, 0, 30, 20)}],
         "boundary": [{"where": {"y": 0}, "symmetry": True}], "fracture": CONTOUR},
        "contour invalid: the crack lies on a symmetry plane"),
    "a body of revolution": (
        [inner((40, 10), (55, 10), start="edge")],
        {"analysis": "axisymmetric", "fracture": CONTOUR,
         "bodies": [{"name": "ring", "material": "soft", "shape": RING}]},
        "contour invalid: it is made for plane bodies"),
    "glued faces": ([EDGE | {"contact": {"law": "glued"}}], {"fracture": DOMAIN}, "closed"),
    "fibres": (
        [EDGE],
        {"fracture": DOMAIN, "materials": {"wood": FIBRES}, "bodies": pieces("wood", "wood")},
        "K invalid: the stiffness of the material depends on direction or time"),
    "a solid that hardly changes its volume": (
        [EDGE],
        {"fracture": DOMAIN, "analysis": "plane_strain", "materials": {"soft": {"nu": 0.48}}},
        "doubtful: nearly incompressible (nu = 0.48): stresses lock, J is low"),
    "few particles": (
        [EDGE],
        {"fracture": DOMAIN, "bodies": [
            {"name": "plate", "material": "soft", "shape": rectangle(0, 0, 30, 20),
             "particles_per_cell": 1}]},
        "doubtful: fewer than 2 particles along each side of a cell: J is low"),
}  # fmt: skip


@pytest.mark.parametrize("case", AROUND)
def test_what_lies_around_a_tip_is_told(case):
    cracks, sections, word = AROUND[case]
    status = sampled(*cracks, **sections)["c0", "end"]["status"]
    assert word in status.split("; ") or (word.endswith(" than") and status.startswith(word))


def works(p, growth):
    p.work[:] = 1e-3 * p.origin[:, 0]


def gives(p, growth):
    p.work[:] = 1e-3 * (30.0 - p.origin[:, 0])


def flies_apart(p, growth):
    p.work[:] = 1e-9
    p.velocity[:, 0] = 0.01 * p.origin[:, 0]


def yields(p, growth):
    p.work[:] = 1e-3
    p.history[:, DISSIPATED] = 1e-4


def spins(p, growth):
    p.L[:] = [0.0, -0.1, 0.1, 0.0]


def both_modes(p, growth):
    p.stress[:, 1] = p.stress[:, 3] = 1e-3
    works(p, growth)


def grows_to_the_right(p, growth):
    p.stress[:, 1] = 1e-6 * p.origin[:, 0] ** 3


def grown(stage, J=1.0, wall=0.0, speed=0.0, reach=5.0, way=1.0):
    """Return what marks the tip as one that has grown, with the load found at that stage."""

    def mark(p, growth):
        growth.length[1], growth.stage[1], growth.wall[1], growth.speed[1] = way, stage, wall, speed
        growth.load[1], growth.reach[1] = (J, 1.0, 0.0), reach

    return mark


def drawn_along(p, growth):
    grown(OWN, speed=0.1)(p, growth)
    p.stress[:, 0] = 1.0


def pressed(p, growth):
    grown(OWN)(p, growth)
    growth.load[1, 1] = -1.0


METAL = {"law": "j2_plastic", "density": 1, "E": 2, "nu": 0.25,
         "hardening": {"type": "linear", "yield_stress": 100}}  # fmt: skip
OTHER_MODE = "contour doubtful: its mode is 10 % of K from that of the domain"
# What the particles, or the growth so far, say of a tip; sections of the deck; the word.
FIELDS = {
    "work without stress": (works, {}, "doubtful: J and that of K differ by 100 %"),
    "kinetic energy": (flies_apart, {}, "contour doubtful: 100 % from the domain"),
    "plastic work": (
        yields, {"materials": {"metal": METAL}, "bodies": pieces("metal", "metal")},
        "doubtful: plastic or viscous strain took 10 % of the work around the tip"),
    "rotation": (spins, {}, "doubtful: the solid turns by 0.1 rad/s"),
    "both modes in a ring": (
        both_modes,
        {"analysis": "axisymmetric", "bodies": [{"name": "r", "material": "soft", "shape": RING}],
         "cracks": [{"name": "c", **inner((40, 10), (55, 10), start="edge")}]},
        "doubtful: K_II/K_I is off by about 9 % where a ring has both modes; J stands"),
    "another material and a load that varies": (
        grows_to_the_right,
        {"bodies": pieces("soft", "hard"), "fracture": DOMAIN,
         "cracks": [{"name": "c", **inner((0, 10), (12, 10), start="edge")}]},
        "doubtful: domains of several radii differ by"),
    "a short kink": (grown(KINK), {}, "kink: from the field around the corner"),
    "a longer kink": (grown(BLEND), {}, "kink: partly from the field around the corner"),
    "no room for a domain": (
        grown(HELD), {}, "held: no room for a domain, the last load found"),
    "growth in two materials": (
        grown(MIXED), {}, "corrected: the domain holds another material"),
    "growth along an interface": (grown(MIXED, wall=1.0), {}, "along an interface"),
    "a tip near an edge": (grown(OWN, reach=2.5), {}, "shrunk: a domain of 2.5 cells"),
    "a sharp tip that runs": (
        grown(OWN, speed=0.1), {"solver": {"end_time": 1, "tips": "sharp"}},
        "doubtful: a sharp tip leaves in the solid what it releases"),
    "a short crack that runs": (
        grown(OWN, speed=0.1, way=3.0), {},
        "doubtful: a running tip acts 2.5 cells behind its place"),
    "energy out of a tip": (grown(HELD, J=-1.0, speed=0.1), {}, "doubtful: J is negative"),
    "a stress along a tip that runs": (drawn_along, {}, "doubtful: the way is unstable, a turn"),
    "faces that ignore each other": (
        pressed, {"contact": {"cracks": {"law": "ignore"}}},
        "doubtful: the faces overlap at the tip"),
}  # fmt: skip


def told(fields, sections, touching=None):
    model, state, scratch = build_deck(PLATE, **({"cracks": [{"name": "c", **EDGE}]} | sections))
    locate(model, state, scratch)
    fields(state.particles, state.growth)
    if touching is not None:
        scratch.rows.touching[:] = touching
    return sample_tips(model, state, scratch)[0]["status"]


@pytest.mark.parametrize("case", FIELDS)
def test_what_the_fields_say_is_told(case):
    fields, sections, word = FIELDS[case]
    assert word in told(fields, sections)


def test_closed_faces_that_give_energy_are_told():
    """J below zero, of faces that slide on each other."""
    status = told(gives, {}, touching=SLIDING)
    assert status.startswith("closed; doubtful: J is -")


def test_an_opening_of_another_mode_is_told():
    """A tenth of K off in K_II is 10 %; a hundredth is nothing, and so is all where J is noise."""
    row = {"K_I": 1.0, "K_II": 0.0, "K_I_contour": 2.0}
    assert of_mode(row | {"K_II_contour": 0.2}, 1.0, 0.5) == [OTHER_MODE]
    assert of_mode(row | {"K_II_contour": 0.02}, 1.0, 0.5) == []
    assert of_mode(row | {"K_II_contour": 0.2}, 1.0, 2.0) == []
    assert of_mode(row | {"K_I_contour": np.nan, "K_II_contour": np.nan}, 1.0, 0.5) == []


def test_what_changes_over_time_is_told():
    """A tip that was at rest until now; more in test_settling.py."""
    model, _, _ = build_deck(PLATE, cracks=[{"name": "c", **EDGE}], solver=DAMPED)
    watch = Settling(model)
    watch.samples = [[0.1 * n, {"K c end": [1.0, 0.0]}] for n in range(10)]
    watch.stretch = 0.5
    row = {"crack": "c", "tip": "end", "time": 1.0, "speed": 0.0, "K_I": 2.0, "K_II": 0.0}
    told = [watch.with_words(model, [row | {"status": s}])[0]["status"] for s in ("ok", "closed")]
    assert told == [f"{OVER_TIME['K']} 50 %", f"closed; {OVER_TIME['K']} 50 %"]


def test_the_page_knows_every_word_here_and_no_other():
    """A row of the table stands for the words up to its first gap `...`."""
    rows = re.findall(r"^\| `([^`]+)` \|", PAGE.read_text(), flags=re.MULTILINE)
    heads = [row.split("...")[0].strip() for row in rows]
    words = [entry[2] for entry in (*AROUND.values(), *FIELDS.values())]
    words += [OTHER_MODE, *OVER_TIME.values()]
    assert [head for head in heads if not any(head in word for word in words)] == []
    assert [word for word in words if not any(head in word for head in heads)] == []
