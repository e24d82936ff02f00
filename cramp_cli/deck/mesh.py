"""Regions of a mesh: a physical group of gmsh, a cell array of VTU, a section of an STL surface."""

from collections.abc import Iterator
from functools import cached_property
from pathlib import Path
from typing import ClassVar, Literal

from pydantic import Field

from cramp_cli.deck.files import FileShape
from cramp_cli.deck.shape import KIND
from cramp_cli.schema.section import PreparationError, Wrong
from cramp_cli.schema.units import Length, Point


class Mesh(FileShape):
    """The cells of a plane mesh, or of one group of it; any file that meshio reads."""

    places: ClassVar = ("origin",)

    type: Literal["mesh"] = Field("mesh", description=KIND)
    unit: Length = Field(1.0, gt=0, description="length of a 1 in the file, such as 1 mm")
    group: str | int | None = Field(
        None, description="name or number of a physical group or cell set; all cells if not given"
    )
    array: str = Field(
        "gmsh:physical", min_length=1, description="cell array that holds the numbers of groups"
    )
    height: Length | None = Field(
        None, description="z of the section through a surface in space, such as STL"
    )
    origin: Point = Field((0.0, 0.0), description="where the file's (0, 0) comes to lie")

    @classmethod
    def prepare(cls, data: dict, folder: Path | None) -> dict:
        """Find the file and see whether it is a mesh."""
        from cramp_cli.deck.mesh_file import read_mesh  # late: imports numpy

        data = super().prepare(data, folder)
        if isinstance(data.get("file"), str):
            read_mesh(data["file"], data["sha256"])
        return data

    def wrong_values(self) -> Iterator[Wrong]:
        """The group exists and has an area; a surface in space is cut somewhere."""
        from cramp_cli.deck.mesh_file import is_surface, read_mesh

        mesh = read_mesh(self.file, self.sha256)
        if is_surface(mesh) and self.height is None:
            low, high = (self.unit * z for z in (mesh.points[:, 2].min(), mesh.points[:, 2].max()))
            message = f"is missing: {self.short_name} lies in space, z from {low:g} m to {high:g} m"
            yield ("height",), message
        elif not is_surface(mesh) and self.height is not None:
            yield ("height",), f"is for surfaces in space; {self.short_name} is plane"
        else:
            yield from self._wrong_area()

    def _wrong_area(self) -> Iterator[Wrong]:
        try:
            empty = not self._outline.area
        except PreparationError as problem:
            yield problem.args
            return
        if empty:
            key = "file" if self.height is None else "height"
            yield (key,), f"gives no area: {self.short_name} has no cells there"

    def contains(self, points):
        """Return which points lie inside; the left and lower border belong to it."""
        from shapely import contains_xy, prepare

        outline = self.outline()
        prepare(outline)
        points = self.nudged(points)
        return contains_xy(outline, points[:, 0], points[:, 1])

    def bounds(self):
        """Return the corners of the box around it (m)."""
        x0, y0, x1, y1 = self.outline().bounds
        return (x0, y0), (x1, y1)

    def outline(self):
        """Return the union of the cells, or the section."""
        return self._outline

    @cached_property
    def _outline(self):
        from shapely import affinity

        from cramp_cli.deck.mesh_file import read_mesh, region, section

        mesh = read_mesh(self.file, self.sha256)
        if self.height is None:
            found = region(mesh, self.group, self.array)
        else:
            found = section(mesh, self.height / self.unit)
        scaled = affinity.scale(found, self.unit, self.unit, origin=(0.0, 0.0))
        return affinity.translate(scaled, *self.origin)
