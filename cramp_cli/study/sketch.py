"""The parts of a deck, drawn on axes one kind after the other."""

import numpy as np

from cramp_cli.cracks.domain import USUAL
from cramp_cli.deck.deck import Deck
from cramp_cli.study.figures import BLACK, BLUE, GREEN, GREY, PURPLE, RED
from cramp_cli.study.outlines import exteriors, region_of, solid_outlines
from cramp_cli.study.quantities import Scale, scale_for

MATERIALS = ("#CFE3F2", "#F8E0C0", "#D3EBDD", "#EAD9E6", "#F5D5CB", "#E4E4E4")
MOST_LINES = 120  # grid lines along an axis; of a finer grid only every second, fifth ... is drawn
MOST_NAMES = 8  # of bodies of a material in the legend
ARROWS = 9  # on a loaded face


class Sketch:
    """Draws the parts of a deck on axes.

    length: scale of the axes
    arrow: length of an arrow (m)
    """

    def __init__(self, axes, deck: Deck, length: Scale, arrow: float):
        self.axes, self.deck, self.length, self.arrow = axes, deck, length, arrow
        self.solids = solid_outlines(deck)
        box = deck.lattice_box()
        self.reached = [box.lower, box.upper]  # what the axes must hold (m)

    def grid(self) -> None:
        """Draw the lines of the background grid."""
        box, width = self.deck.lattice_box(), self.deck.grid.cell
        step = next(s for s in (1, 2, 5, 10, 20, 50, 100, 1000) if max(box.cells) / s <= MOST_LINES)
        style = {"color": "#D9D9D9", "linewidth": 0.35, "zorder": 1.5}
        lines = [
            (np.asarray(low) + width * np.arange(0, count + 1, step)) / self.length.size
            for low, count in zip(box.lower, box.cells, strict=True)
        ]
        (x0, y0), (x1, y1) = (np.array(c) / self.length.size for c in (box.lower, box.upper))
        every = f", every {step} cells" if step > 1 else ""
        scale = scale_for("m", width)
        name = f"grid, cell {width / scale.size:.4g} {scale.unit}{every}"
        self.axes.vlines(lines[0], y0, y1, label=name, **style)
        self.axes.hlines(lines[1], x0, x1, **style)
        border = [(x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)]
        self.axes.plot(*np.transpose(border), color="#B0B0B0", lw=0.7, zorder=1.6)

    def bodies(self) -> None:
        """Fill every body with the colour of its material."""
        colours = dict(zip(self.deck.materials, MATERIALS * 20, strict=False))
        for number, outline in self.solids.items():
            body = self.deck.bodies[number]
            text = f"{body.material or 'rigid'}: {self._made_of(body.material)}"
            for hull, holes in exteriors(outline):
                self._fill(hull, holes, colours.get(body.material, GREY), text)
            velocity = body.rigid.velocity if body.rigid else body.velocity
            if any(velocity):
                self._motion(outline, body, velocity)

    def _made_of(self, material: str | None) -> str:
        solid = [b for b in self.deck.bodies if not b.hole]
        names = [b.name for b in solid if b.material == material]
        if len(names) > MOST_NAMES:
            names = [f"{names[0]}, {names[1]}, ..., {names[-1]} ({len(names)} bodies)"]
        return ", ".join(names)

    def _fill(self, hull, holes, colour, text) -> None:
        from matplotlib.patches import PathPatch
        from matplotlib.path import Path as Outline

        rings = [Outline(ring / self.length.size, closed=True) for ring in (hull, *holes)]
        path = Outline.make_compound_path(*rings)
        style = {"facecolor": colour, "edgecolor": GREY, "linewidth": 0.8, "zorder": 1}
        self.axes.add_patch(PathPatch(path, label=text, **style))
        edge = {"facecolor": "none", "edgecolor": GREY, "linewidth": 0.8, "zorder": 2}
        self.axes.add_patch(PathPatch(path, **edge))

    def _motion(self, outline, body, velocity) -> None:
        place = np.array(outline.representative_point().coords[0])
        speed = float(np.hypot(*velocity))
        scale = scale_for("m/s", speed)
        text = f"{body.name}: {speed / scale.size:.3g} {scale.unit}"
        self._arrows([place], np.array(velocity), PURPLE, text)

    def boundary(self) -> None:
        """Draw fixed, moving and mirror planes where they meet bodies."""
        for number, boundary in enumerate(self.deck.boundary):
            name = boundary.name or f"boundary {number + 1}"
            region = region_of(boundary.where, self._all(), self.deck.grid.cell)
            dash = "-." if boundary.symmetry else "-"
            kind = "symmetry plane" if boundary.symmetry else _held(boundary)
            for line in region.lines:
                self._line(line, GREEN, dash, f"{name}: {kind}")
            if boundary.velocity:
                way = np.zeros(2)
                for axis, speed in boundary.components:
                    way[axis] = speed
                self._arrows(region.places(3, way, 2.0 * self.arrow), way, GREEN, f"{name}: {kind}")

    def _line(self, line, colour, dash, text) -> None:
        style = {"lw": 2.6, "alpha": 0.9, "zorder": 3, "solid_capstyle": "butt"}
        self.axes.plot(*line.T / self.length.size, dash, color=colour, label=text, **style)

    def loads(self) -> None:
        """Draw forces, tractions and gravity as arrows."""
        for number, load in enumerate(self.deck.loads):
            name = load.name or f"load {number + 1}"
            if load.type == "gravity":
                self._gravity(name, load)
                continue
            body = next(n for n, b in enumerate(self.deck.bodies) if b.name == load.body)
            region = region_of(load.where, self.solids[body], self.deck.grid.cell)
            way, unit = _pull(load, region)
            size = float(np.hypot(*way))
            scale = scale_for(unit, size)
            text = f"{name}: {size / scale.size:.3g} {scale.unit}{_over_time(load)}"
            for hull, _ in exteriors(region.area) if region.area else ():
                self.axes.fill(*hull.T / self.length.size, color=RED, alpha=0.3, lw=0, zorder=4)
            places = region.places(ARROWS, way, 2.0 * self.arrow)
            self._arrows(places, way, RED, text, from_behind=load.type == "traction")

    def _gravity(self, name, load) -> None:
        way = np.array(load.acceleration)
        place = np.array(self.deck.lattice_box().upper) - 0.7 * self.arrow  # a corner is empty
        text = f"{name}: gravity {np.hypot(*way):.3g} m/s²{_over_time(load)}"
        self._arrows([place], way, RED, text)

    def _arrows(self, places, way, colour, text, from_behind=False) -> None:
        """Draw arrows that start at places, or end there when they push against the solid."""
        size = float(np.hypot(*way))
        if not size or not len(places):
            return
        step = self.arrow * way / size
        inside = from_behind and self._pushes(places[len(places) // 2], step)
        for place in places:
            tail = place - step if inside else place
            self.reached += [tail - 0.1 * step, tail + 1.1 * step]
            (x, y), (u, v) = tail / self.length.size, step / self.length.size
            self.axes.annotate(
                "",
                xy=(x + u, y + v),
                xytext=(x, y),
                arrowprops={"arrowstyle": "-|>", "color": colour, "lw": 1.0, "mutation_scale": 8},
                zorder=5,
                annotation_clip=False,
            )
        self.axes.plot([], [], color=colour, marker=">", ms=4, lw=1.0, label=text)

    def _pushes(self, place, step) -> bool:
        from shapely import Point

        return bool(self._all().covers(Point(*(place + 0.1 * step))))

    def cracks(self) -> None:
        """Draw cracks, their tips and where J is found."""
        for crack in self.deck.cracks:
            line = np.array(crack.corners)
            law = self.deck.contact_of(crack).law
            text = f"{crack.name} (contact: {law})"
            self.axes.plot(*line.T / self.length.size, color=BLACK, lw=1.8, label=text, zorder=6)
            for kind, place in ((crack.start, line[0]), (crack.end, line[-1])):
                self._end(kind, place)

    def _end(self, kind, place) -> None:
        x, y = place / self.length.size
        if kind == "tip":
            self.axes.plot(x, y, "o", ms=4.5, mfc=RED, mec="white", mew=0.6, zorder=8, label="tip")
            self._domains(place)
        elif kind == "junction":
            self.axes.plot(x, y, "D", ms=3.5, color=BLACK, zorder=8, label="junction")
        elif kind == "edge":
            self.axes.plot(x, y, "|", ms=6, color=BLACK, zorder=8, label="edge")
        elif kind == "plain":
            self.axes.plot(x, y, "s", ms=3.5, color=BLACK, zorder=8, label="plain end")

    def _domains(self, place) -> None:
        """Draw the disk of the domain integral and the square of the contour."""
        from matplotlib.patches import Circle, Rectangle

        settings, width = self.deck.fracture, self.deck.grid.cell
        style = {"facecolor": "none", "edgecolor": BLUE, "linewidth": 1.0, "zorder": 7}
        if "domain" in settings.methods:
            for radius in settings.radius or (USUAL * width,):
                circle = Circle(
                    place / self.length.size, radius / self.length.size, ls="--", **style
                )
                self.axes.add_patch(circle)
            self.axes.plot([], [], "--", color=BLUE, lw=1.0, label="J domain, if there is room")
        if "contour" in settings.methods:
            lower = np.array(self.deck.lattice_box().lower)
            node = lower + width * np.round((place - lower) / width)
            half = settings.contour.cells * width
            corner = (node - half) / self.length.size
            side = 2.0 * half / self.length.size
            self.axes.add_patch(Rectangle(corner, side, side, ls=":", **style))
            self.axes.plot([], [], ":", color=BLUE, lw=1.0, label="J contour")

    def _all(self):
        from shapely import union_all

        return union_all(list(self.solids.values()))


def _held(boundary) -> str:
    if boundary.fix:
        return f"{' and '.join(boundary.fix)} fixed"
    scale = scale_for("m/s", [speed for _, speed in boundary.components])
    speeds = (
        f"{'xy'[axis]} at {speed / scale.size:.3g} {scale.unit}"
        for axis, speed in boundary.components
    )
    return ", ".join(speeds) + _over_time(boundary)


def _over_time(entry) -> str:
    kind = entry.in_time.type
    return "" if kind == "constant" else f" ({kind.replace('_', ' ')})"


def _pull(load, region) -> tuple[np.ndarray, str]:
    """Return what a force or traction is, as a vector, and its unit."""
    if load.type == "force":
        return np.array(load.total if load.total is not None else load.each), "N"
    if load.traction is not None:
        return np.array(load.traction), "Pa"
    return load.pressure * region.inward(), "Pa"
