"""The package and the plain step take the same steps."""

import numpy as np
import pytest
from plain_step import Crack, Hold, Particle, Problem, plain_step
from support import advance, build_deck

from cramp_cli.cracks.contact import LAWS
from cramp_cli.shapes.linear import Linear
from cramp_cli.state.paths import EDGE

STEPS = 20
BLOCK = """
cramp: 1
analysis: plane_strain
thickness: 1
grid: {cell: 1, margin: 3}
materials: {m: {law: elastic, density: 1, E: 1, nu: 0.3}}
bodies: [{name: block, material: m, shape: {type: rectangle, lower: [0, 0], upper: [8, 6]}}]
solver: {end_time: 1000, cfl: 0.3, tips: sharp}
"""
LAW_NAMES = {number: name for name, number in LAWS.items()}


def crack(*points, start="edge", end="tip", **law):
    return {"points": [list(p) for p in points], "start": start, "end": end, "contact": law}


FRICTION = {"law": "frictional", "mu": 0.3}
ON_NODES = ((0.0, 3.0), (4.3, 3.0))  # along a row of nodes, through none with its points
SLANTED = ((0.0, 2.1), (2.7, 2.9), (5.1, 3.4))
RISING = ((2.3, 0.0), (3.4, 4.6))  # crosses both others


def built(cracks, update, velocity=0.02, **sections):
    """Return a package problem with all particles in motion, and the same as a plain problem.

    The particles are moved a little: at first they end at cell borders, and round-off would decide
    whether a particle sees a node with a weight of 1e-34.
    """
    named = [{"name": f"c{n}", **one} for n, one in enumerate(cracks)]
    model, state, scratch = build_deck(BLOCK, cracks=named, **sections)
    state.particles.position[:] += (0.013, -0.017)
    state.particles.origin[:] = state.particles.position
    x, y = state.particles.position.T
    chance = np.random.default_rng(3).normal(size=state.particles.velocity.shape)
    smooth = np.stack([np.sin(0.7 * x + y), 2.0 - 0.7 * y + np.cos(x)], axis=1)
    state.particles.velocity[:] = velocity * (smooth + 0.1 * chance)
    return (model, state, scratch), plain(model, state, update)


def plain(model, state, holds):
    """Read the numbers of a built deck; formulas are not read."""
    (block,), paths = model.blocks, state.paths
    p = state.particles
    particles = [
        Particle(x, v, m, V)
        for x, v, m, V in zip(
            *(a.tolist() for a in (p.position, p.velocity, p.mass, p.volume)), strict=True
        )
    ]
    for force in model.conditions.forces:
        for n, pull in zip(force.particles, force.load.tolist(), strict=True):
            particles[n].pull = pull
    laws = model.contact
    cracks = [
        Crack(
            paths.point[paths.crack(c)].tolist(), tuple(paths.ends[c] == EDGE),
            LAW_NAMES[laws.kind[c]], laws.mu[c], laws.mu_static[c],
        )
        for c in range(paths.crack_count)
    ]  # fmt: skip
    width = model.lattice.width
    return Problem(
        particles, cracks, holds, width, model.lattice.lower,
        half=0.0 if isinstance(block.shape, Linear) else block.shape.half[0] * width,
        lame=block.law.lame, shear=block.law.shear,
        plane_stress=type(model.geometry).__name__ == "PlaneStress",
        dt=model.dt, shares=(model.scheme.before, model.scheme.after), again=model.scheme.again,
        gravity=model.conditions.body_force(state, 2), damping=model.damping,
    )  # fmt: skip


def compare(package, problem, round_off=1e-12):
    """Take steps with both; 20 steps of round-off leave 1e-12 of the largest number of each kind.

    The work of friction is compared with that of the stresses.

    round_off: more where a scheme divides forces by masses that it has just left behind (USL-)
    """
    model, state, _ = package
    advance(*package, STEPS)
    for _ in range(STEPS):
        plain_step(problem)
    p, paths = state.particles, state.paths
    pairs = {
        "position": (p.position, [q.x for q in problem.particles]),
        "displacement": (p.position - p.origin, [np.subtract(q.x, q.X) for q in problem.particles]),
        "velocity": (p.velocity, [q.v for q in problem.particles]),
        "acceleration": (p.acceleration, [q.a for q in problem.particles]),
        "stress": (p.stress, [q.stress for q in problem.particles]),
        "F": (p.F, [np.ravel(q.F) for q in problem.particles]),
        "L": (p.L, [np.ravel(q.L) for q in problem.particles]),
        "stretch": (p.stretch, [q.stretch for q in problem.particles]),
        "work": (p.work, [q.work for q in problem.particles]),
        "friction": (state.books.friction, [problem.friction]),
        "impact": (state.books.impact, [problem.impact]),
    }
    for name, points in (("point", "plane"), ("above", "above"), ("below", "below")):
        pairs[name] = getattr(paths, name), [x for c in problem.cracks for x in getattr(c, points)]
    if problem.holds:
        pairs["reactions"] = state.reactions.sum(axis=0), problem.reaction
    for name, (got, wanted) in pairs.items():
        wanted = np.array(wanted).reshape(np.shape(got))
        size = np.abs(wanted if name not in ("friction", "impact") else p.work).max(initial=0.0)
        np.testing.assert_allclose(got, wanted, rtol=0.0, atol=round_off * size, err_msg=name)
    return pairs


@pytest.mark.parametrize("strain", ["usf", "usl-", "usl+", "usavg-", "usavg+"])
def test_schemes(strain):
    both = built([crack(*ON_NODES, **FRICTION)], [], solver={"strain": strain})
    pairs = compare(*both, round_off=1e-11 if strain == "usl-" else 1e-12)
    assert pairs["friction"][1][0] > 0.0


@pytest.mark.parametrize("strain", ["usf", "usl+", "usavg+"])
def test_linear_shape_functions(strain):
    solver = {"strain": strain, "shape": "linear"}
    compare(*built([crack(*SLANTED, **FRICTION)], [], solver=solver))


@pytest.mark.parametrize(
    "law",
    [
        {"law": "ignore"},
        {"law": "frictional"},
        {"law": "frictional", "mu": 0.2, "mu_static": 0.6},
        {"law": "stick"},
        {"law": "glued"},
    ],
    ids=["ignore", "frictionless", "static friction", "stick", "glued"],
)
def test_contact_laws(law):
    compare(*built([crack(*SLANTED, **law)], []))


def test_plane_stress():
    compare(*built([crack(*SLANTED, **FRICTION)], [], analysis="plane_stress"))


@pytest.mark.parametrize("line", [ON_NODES, SLANTED])
@pytest.mark.parametrize("second", [FRICTION, {"law": "ignore"}])
def test_two_crossing_cracks(line, second):
    compare(*built([crack(*line, **FRICTION), crack(*RISING, **second)], []))


def test_a_crack_inside_the_body():
    compare(*built([crack((2.1, 2.2), (5.6, 3.9), start="tip", **FRICTION)], []))


@pytest.mark.parametrize("strain", ["usf", "usl-", "usavg+"])
def test_a_struck_edge_below_a_notch(strain):
    """Only the part of the edge below the crack is held."""
    edge = {"where": {"x": 0.0, "y": [-1.0, 3.0]}, "velocity": {"x": 0.1}}
    top = {"where": {"y": 6.0}, "fix": ["y"]}
    holds = [Hold(0, 0.0, (-1.0, 3.0), 0, 0.1), Hold(1, 6.0, (-99.0, 99.0), 1, 0.0)]
    cracks = [crack(*ON_NODES, **FRICTION)]
    compare(*built(cracks, holds, boundary=[edge, top], solver={"strain": strain}))


def test_forces_gravity_and_damping():
    """An opening crack: the arms are pulled apart."""
    up = {
        "type": "force",
        "body": "block",
        "where": {"x": 0.0, "y": [3.0, 6.0]},
        "each": [0.001, 0.02],
    }
    down = {
        "type": "force",
        "body": "block",
        "where": {"x": 0.0, "y": [0.0, 3.0]},
        "total": [0.0, -0.1],
    }
    weight = {"type": "gravity", "acceleration": [0.001, -0.002]}
    damping = {"grid": 0.05, "particle": 0.02}
    more = {"loads": [up, down, weight], "solver": {"damping": damping}}
    pairs = compare(*built([crack(*ON_NODES, **FRICTION)], [], velocity=0.002, **more))
    assert np.max(pairs["above"][0][:, 1] - pairs["below"][0][:, 1]) > 0.1


@pytest.mark.parametrize("per_cell", [1, 3])
def test_other_sizes_of_particles(per_cell):
    body = {"name": "block", "material": "m", "particles_per_cell": per_cell}
    body["shape"] = {"type": "rectangle", "lower": [0, 0], "upper": [6, 4]}
    compare(*built([crack((0.0, 2.2), (3.4, 2.9), **FRICTION)], [], bodies=[body]))
