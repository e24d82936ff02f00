"""How fast: fixed cases, timed warm and in rounds, beside a plain loop of the same minute.

Times of one computer change with what else it does; their ratio to a plain loop timed in the same
round changes little. Results are compared by that ratio.
"""

import json
import os
import subprocess
import sys
import tempfile
from collections import defaultdict
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from statistics import median
from time import perf_counter

import numpy as np
import yaml

ROUNDS = 5
LEAST = 0.4  # s a round takes at least
YARD = 200_000  # entries of the plain loop

BLOCK = """
cramp: 1
analysis: plane_strain
grid: {cell: 1 mm, margin: 5}
materials: {glass: {law: elastic, density: 2500, E: 70 GPa, nu: 0.2}}
solver: {end_time: 1}
"""
STEEL = """
cramp: 1
analysis: plane_strain
grid: {cell: 1 mm}
materials: {steel: {law: elastic, density: 7800, E: 210 GPa, nu: 0.3}}
bodies:
  - name: plate
    material: steel
    shape: {type: rectangle, lower: [-50 mm, -100 mm], upper: [50 mm, 100 mm]}
cracks: [{name: centre, points: [[-20.3 mm, 0.2 mm], [20.3 mm, 0.2 mm]], contact: {law: ignore}}]
loads:
  - {type: traction, body: plate, where: {y: 100 mm}, traction: [0, 1 MPa]}
  - {type: traction, body: plate, where: {y: -100 mm}, traction: [0, -1 MPa]}
solver: {end_time: 1}
fracture: {methods: [domain]}
"""


@dataclass(frozen=True)
class Case:
    """What is timed."""

    deck: dict
    sample: bool = False  # J and K of all tips at every step


@dataclass(frozen=True)
class Timing:
    """What was found; times are medians over rounds of the fastest step in each."""

    particles: int
    threads: int
    per_step: float  # ms
    speed: float  # million particle-steps per second
    lowest: float  # slowest round
    highest: float  # fastest round
    yards: float  # time of a particle-step in times of an entry of the plain loop
    bytes_per_particle: float
    stages: dict  # ns per particle, by the titles of step.py


def block(side: int, cracked: bool = False, **solver) -> dict:
    """Return the deck of a flying square of side x side cells, with or without a crack."""
    deck = yaml.safe_load(BLOCK)
    body = {"type": "rectangle", "lower": [0, 0], "upper": [f"{side} mm", f"{side} mm"]}
    moving = {"velocity": [1.0, 0.5], "angular_velocity": 0.05}
    deck["bodies"] = [{"name": "block", "material": "glass", "shape": body, **moving}]
    deck["solver"] |= solver
    if cracked:
        half, middle = min(50.0, 0.25 * side), 0.5 * side
        points = [[f"{middle + s * half + 0.1} mm", f"{middle + 0.2} mm"] for s in (-1, 1)]
        law = {"law": "frictional", "mu": 0.3}
        deck["cracks"] = [{"name": "crack", "points": points, "contact": law}]
    return deck


def cases(large: bool) -> dict[str, Case]:
    """Return the cases by name; `large` adds those of 2.5 million particles."""
    found = {}
    sides = {"10k": 50, "250k": 250} | ({"2.5M": 790} if large else {})
    for name, side in sides.items():
        found[f"block {name}"] = Case(block(side))
        found[f"cracked block {name}"] = Case(block(side, cracked=True))
    found["block 250k, usl-"] = Case(block(250, strain="usl-"))
    found["cracked block 250k, sharp tips"] = Case(block(250, cracked=True, tips="sharp"))
    found["cracked block 250k, J every step"] = Case(block(250, cracked=True), sample=True)
    found["centre crack 80k, J every step"] = Case(yaml.safe_load(STEEL), sample=True)
    found["double cantilever beam"] = Case(cantilever())
    return found


def cantilever() -> dict:
    """Return the deck of a double cantilever beam of 2400 particles."""
    deck = yaml.safe_load(BLOCK)
    deck["grid"] = {"cell": "2 mm", "margin": 3}
    body = {"type": "rectangle", "lower": [0, "-12 mm"], "upper": ["100 mm", "12 mm"]}
    deck["bodies"] = [{"name": "beam", "material": "glass", "shape": body}]
    points = [["50.25 mm", 0], ["99.5 mm", 0]]
    crack = {"name": "midplane", "points": points, "start": "tip", "end": "edge"}
    deck["cracks"] = [crack | {"contact": {"law": "frictional", "mu": 0}}]
    deck["boundary"] = [{"where": {"x": 0}, "fix": ["x"]}]
    force = {"type": "force", "body": "beam", "where": {"x": "100 mm"}}
    deck["loads"] = [
        force | {"where": {"x": "100 mm", "y": [0, f"{s * 12} mm"][::s]}, "total": [0, 3 * s]}
        for s in (1, -1)
    ]
    deck["solver"]["tips"] = "sharp"
    return deck


class Yardstick:
    """The plain loop: nanoseconds per entry, now."""

    def __init__(self):
        self.a, self.b, self.c = (np.ones(YARD) for _ in range(3))

    def __call__(self) -> float:
        """Return the fastest of a few rounds."""
        from cramp_cli.numerics.yardstick import chain, triad

        taken = []
        for _ in range(8):
            begun = perf_counter()
            triad(self.a, self.b, self.c, 0.5)
            chain(self.a, 0.5)
            taken.append(perf_counter() - begun)
        return 1e9 * min(taken) / YARD


def time_case(case: Case, threads: int, rounds: int = ROUNDS) -> Timing:
    """Time the steps of a case: `rounds` rounds of at least LEAST seconds, after two warm steps."""
    from cramp_cli.build import build
    from cramp_cli.cracks.tips import sample_tips
    from cramp_cli.deck.deck import check_deck
    from cramp_cli.schema.mistake import Source
    from cramp_cli.scratch import make_scratch
    from cramp_cli.step import step

    model, state = build(check_deck(Source("bench", yaml.safe_dump(case.deck), case.deck), Path()))
    scratch, count, yard = (
        make_scratch(model, state, threads),
        len(state.particles.mass),
        Yardstick(),
    )
    seconds = defaultdict(list)

    @contextmanager
    def watch(title):
        begun = perf_counter()
        yield
        seconds[title].append(perf_counter() - begun)

    def once() -> float:
        begun = perf_counter()
        step(model, state, scratch, watch)
        if case.sample:
            with watch("J and K of all tips"):
                sample_tips(model, state, scratch)
        return perf_counter() - begun

    once(), once(), seconds.clear()
    fastest, yards = [], []
    for _ in range(rounds):
        yards.append(yard())
        begun, taken = perf_counter(), []
        while perf_counter() - begun < LEAST or len(taken) < 3:
            taken.append(once())
        fastest.append(min(taken))
    speeds = [1e-6 * count / t for t in fastest]
    return Timing(
        particles=count,
        threads=scratch.team.size,
        per_step=1e3 * median(fastest),
        speed=median(speeds),
        lowest=min(speeds),
        highest=max(speeds),
        yards=median(1e9 * t / count / y for t, y in zip(fastest, yards, strict=True)),
        bytes_per_particle=_bytes((state, scratch)) / count,
        stages={title: 1e9 * min(times) / count for title, times in seconds.items()},
    )


def _bytes(thing) -> int:
    """Return the bytes of all arrays in something nested."""
    if isinstance(thing, np.ndarray):
        return thing.nbytes
    if isinstance(thing, list | tuple):
        return sum(map(_bytes, thing))
    return sum(map(_bytes, vars(thing).values())) if hasattr(thing, "__dict__") else 0


def time_start() -> dict[str, float]:
    """Return seconds from the command to the end of a first step: nothing compiled, and all.

    And to the end of that run of one step.
    """
    with tempfile.TemporaryDirectory() as folder:
        deck = Path(folder) / "start.yaml"
        deck.write_text(yaml.safe_dump(block(20, cracked=True, end_time=1e-9)), encoding="utf-8")
        environment = os.environ | {"CRAMP_CACHE_DIR": folder, "PYTHONPYCACHEPREFIX": folder}
        environment.pop("PYTHONDONTWRITEBYTECODE", None)
        command = [sys.executable, "-m", "cramp_cli", "run", str(deck), "--overwrite"]
        taken = [_time_first_step([*command, "-o", f"{folder}/run"], environment) for _ in range(4)]
    (cold, _), *warm = taken
    return {"cold": cold, "warm": median(w[0] for w in warm), "over": median(w[1] for w in warm)}


def _time_first_step(command: list[str], environment: dict) -> tuple[float, float]:
    """Return the seconds until a run tells of its first step, and until it is over."""
    begun, first = perf_counter(), None
    told = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}
    with subprocess.Popen(command, env=environment, **told) as run:
        for line in run.stdout:
            if first is None and line.split()[:1] == ["1"]:
                first = perf_counter() - begun
    if run.returncode or first is None:
        raise RuntimeError(f"the run that was timed has ended with {run.returncode}")
    return first, perf_counter() - begun


def bench(threads: int, large: bool, wanted: list[str], tell) -> dict:
    """Time all cases whose name holds one of the wanted words; tell(name, timing) as they come."""
    found = {}
    for name, case in cases(large).items():
        if not wanted or any(word in name for word in wanted):
            found[name] = asdict(time_case(case, threads))
            tell(name, found[name])
    return {"cases": found}


def row(name: str, timing: dict, old: dict | None = None) -> str:
    """Return a line of the table; with an old result of the case, how much faster it has become."""
    ratio = f" {old['yards'] / timing['yards']:6.2f}x" if old else ""
    return (
        f"{name:34} {timing['threads']:3d} {timing['per_step']:9.3f} {timing['speed']:6.2f} "
        f"{timing['lowest']:6.2f} {timing['highest']:6.2f} {timing['yards']:6.1f}{ratio}"
    )


HEAD = f"{'case':34} thr   ms/step  M/s    low   high  yards"


def stages_text(timing: dict) -> str:
    """Return the stages of a step, a line each (ns per particle)."""
    return "\n".join(f"    {t:46} {ns:8.1f} ns" for t, ns in timing["stages"].items())


def read_old(path: Path | None) -> dict:
    """Return the cases of an older result, by name."""
    return json.loads(path.read_text(encoding="utf-8"))["cases"] if path else {}
