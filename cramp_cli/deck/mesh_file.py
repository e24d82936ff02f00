"""What a mesh file holds, as regions of the plane, in its own unit of length; meshio reads it."""

import contextlib
import io
from functools import lru_cache
from pathlib import Path

import numpy as np

from cramp_cli.schema.section import PreparationError, unknown
from cramp_cli.schema.units import shown

CORNERS = {  # first nodes of a cell; nodes on its edges follow them
    "triangle": 3,
    "triangle6": 3,
    "triangle7": 3,
    "quad": 4,
    "quad8": 4,
    "quad9": 4,
}
FLAT = 1e-9  # of its size: how far nodes of a plane mesh may be apart along z
ASIDE = 1e-7  # of its size: a section lies this far beside its height, off nodes with that height


@lru_cache(maxsize=8)
def read_mesh(file: str, sha256: str):
    """Return a mesh of meshio; sha256: of the file, so that a changed one is read anew.

    Raises PreparationError, blamed on the key `file`, for what meshio can not read.
    """
    import meshio

    name, said = shown(Path(file).name), io.StringIO()
    try:  # meshio prints some of its complaints and exits; text in STL it takes for numbers first
        with contextlib.redirect_stdout(said), np.errstate(over="ignore"):
            mesh = meshio.read(file)
    except (Exception, SystemExit) as problem:  # noqa: BLE001 (its readers raise anything)
        reason = str(problem).strip().splitlines()
        reason = reason[0] if reason and not isinstance(problem, SystemExit) else "unknown format"
        message = f"cannot read {name} as a mesh: {reason}"
        raise PreparationError(("file",), message) from None
    if not any(block.type in CORNERS for block in mesh.cells):
        kinds = ", ".join(sorted({block.type for block in mesh.cells})) or "no cells"
        message = f"{name} has no triangles or quadrilaterals (has {kinds})"
        raise PreparationError(("file",), message)
    return mesh


def is_surface(mesh) -> bool:
    """Return whether a mesh lies in space, not in a plane of constant z."""
    if mesh.points.shape[1] < 3:
        return False
    spans = np.ptp(mesh.points, axis=0)
    return bool(spans[2] > FLAT * spans.max())


def region(mesh, group: str | int | None, array: str):
    """Return the union of the cells of a group, or of all, as a shapely geometry."""
    from shapely import polygons, union_all

    chosen = _all(mesh) if group is None else _members(mesh, group, array)
    parts = [
        polygons(mesh.points[block.data[which, : CORNERS[block.type]], :2])
        for block, which in zip(mesh.cells, chosen, strict=True)
        if block.type in CORNERS and len(which)
    ]
    return union_all(np.concatenate(parts) if parts else [])


def _all(mesh) -> list[np.ndarray]:
    return [np.arange(len(block.data)) for block in mesh.cells]


def _members(mesh, group: str | int, array: str) -> list[np.ndarray]:
    """Return the cells of a group for each block of the mesh."""
    if isinstance(group, str) and group in mesh.cell_sets:
        sets = mesh.cell_sets[group]
        return [np.array([] if one is None else one, dtype=int) for one in sets]
    number = _number(mesh, group)
    if array not in mesh.cell_data:
        raise PreparationError(("array",), unknown("cell array", array, sorted(mesh.cell_data)))
    values = mesh.cell_data[array]
    found = [np.flatnonzero(np.asarray(one).ravel() == number) for one in values]
    areas = [one for one, b in zip(values, mesh.cells, strict=True) if b.type in CORNERS]
    known = sorted({f"{value:g}" for one in areas for value in np.unique(one)}, key=float)
    if f"{number:g}" not in known:
        message = f"no cell has the number {number} (known: {', '.join(known)})"
        raise PreparationError(("group",), message)
    return found


def _number(mesh, group: str | int) -> int:
    """Return the number of a group: its own, or that of its name."""
    if isinstance(group, int):
        return group
    names = {name: int(pair[0]) for name, pair in mesh.field_data.items() if int(pair[1]) == 2}
    if group not in names:
        known = [*names, *(name for name in mesh.cell_sets if not name.startswith("gmsh:"))]
        raise PreparationError(("group",), unknown("group", group, known))
    return names[group]


def section(mesh, height: float):
    """Return the section of a closed surface of triangles at a height z, as a shapely geometry."""
    from shapely import build_area, linestrings, node, set_precision, union_all

    corners = [mesh.points[b.data] for b in mesh.cells if b.type == "triangle"]
    corners = np.concatenate(corners) if corners else np.zeros((0, 3, 3))
    size = float(np.ptp(mesh.points, axis=0).max())
    lines = _cuts(corners, height + ASIDE * size)
    if not len(lines):
        return union_all([])
    # ends of neighbouring cuts differ by round-off: they come together on a fine raster
    return build_area(node(set_precision(union_all(linestrings(lines)), FLAT * size)))


def _cuts(corners: np.ndarray, height: float) -> np.ndarray:
    """Return where a plane cuts triangles (n, 3, 3): ends of lines, (m, 2, 2)."""
    above = corners[:, :, 2] > height
    corners = corners[above.any(axis=1) & ~above.all(axis=1)]
    above = corners[:, :, 2] > height
    odd = np.where(above.sum(axis=1) == 1, above.argmax(axis=1), (~above).argmax(axis=1))
    each = np.arange(len(corners))
    tip = corners[each, odd]
    ends = []
    for other in ((odd + 1) % 3, (odd + 2) % 3):
        foot = corners[each, other]
        share = (height - tip[:, 2]) / (foot[:, 2] - tip[:, 2])
        ends.append((tip + share[:, None] * (foot - tip))[:, :2])
    return np.stack(ends, axis=1)
