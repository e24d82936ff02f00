"""What a deck asks of bodies and loads beside what its model has of it: for `check --report`.

What is asked comes from the shapes alone, what is filled from particles and their loads.
"""

from collections.abc import Iterator

import numpy as np

from cramp_cli.deck.regions import Regions
from cramp_cli.materials.geometry import depth

MOST = 20  # bodies and loads that are told one by one
FAR = 1e9  # cells; where a region without a limit ends


def filled(deck, model, state) -> dict[str, str]:
    """Return the mass of each body and the force of each load, asked and filled, for people."""
    regions, facts = Regions(deck.bodies), {}
    for name, asked, found in [
        *_masses(deck, model, state, regions),
        *_forces(deck, model, regions),
    ]:
        facts[name] = f"{_list(asked)} asked, {_list(found)} filled ({_apart(asked, found)})"
    more = len(facts) - MOST
    return facts if more <= 0 else dict(list(facts.items())[:MOST]) | {"and others": str(more)}


def _masses(deck, model, state, regions) -> Iterator[tuple]:
    """Yield name, asked and filled mass (kg) of each solid body."""
    found = np.bincount(state.particles.body, state.particles.mass, len(deck.bodies))
    for number, body in enumerate(deck.bodies):
        if not body.hole and not body.rigid:
            volume = _measure(regions.left(number), model.geometry, "area")
            asked = volume * deck.materials[body.material].density
            yield f"{body.name}: mass, kg", [asked], [found[number]]


def _forces(deck, model, regions) -> Iterator[tuple]:
    """Yield name, asked and filled force (N) of each load with a sum."""
    loads, conditions = deck.loads, model.conditions
    found = np.zeros((len(loads), 2))
    for one in conditions.forces:
        found[one.number] += one.load.sum(axis=0)
    for one in conditions.tractions:
        found[one.number] += one.faces.force.sum(axis=0)
    for number, load in enumerate(loads):
        name = f"load {load.name or number + 1}: force, N"
        if load.type == "force" and load.total is not None:
            yield name, load.total, found[number]
        if load.type == "traction":
            size, normal = _face(deck, load, model.geometry, regions)
            stress = load.traction
            if stress is None:
                stress = -load.pressure * normal
            yield name, size * np.asarray(stress), found[number]


def _face(deck, load, geometry, regions) -> tuple[float, np.ndarray]:
    """Return the area (m^2) of the face that a traction acts on, and its outward normal."""
    from shapely import LineString, Point

    body = next(n for n, one in enumerate(deck.bodies) if one.name == load.body)
    (axis, at), far = load.where.planes[0], FAR * deck.grid.cell
    ends = np.full((2, 2), float(at))
    ends[:, 1 - axis] = np.clip(load.where.span(1 - axis) or (-far, far), -far, far)
    region = regions.left(body)
    face = region.boundary & LineString(ends)
    normal = np.eye(2)[axis]
    middle = np.array(face.interpolate(0.5, normalized=True).coords[0]) if face.length else ends[0]
    outside = not region.covers(Point(middle + 1e-3 * deck.grid.cell * normal))
    return _measure(face, geometry, "length"), normal if outside else -normal


def _measure(region, geometry, kind: str) -> float:
    """Return the volume behind a region or the area behind a line: its size times its depth."""
    size = getattr(region, kind)
    return size * float(depth(geometry, region.centroid.x)) if size else 0.0


def _list(values) -> str:
    return ", ".join(f"{value:.6g}" for value in values)


def _apart(asked, found) -> str:
    """Return by how much the second differs from the first, in percent of the largest."""
    most = float(np.max(np.abs(asked)))
    off = float(np.max(np.abs(np.subtract(found, asked)))) / most if most else 0.0
    return f"{100.0 * off:.3f} % off"
