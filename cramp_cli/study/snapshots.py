"""Pictures in the plane: a field on the particles with the cracks drawn in, and how it changes."""

from pathlib import Path
from typing import NamedTuple

import numpy as np

from cramp_cli.deck.deck import read_deck
from cramp_cli.output.exits import FolderError
from cramp_cli.output.fields import Frame, read_frames
from cramp_cli.study.figures import BLACK, WIDTH
from cramp_cli.study.particles import (
    Quantity,
    crack_faces,
    quantity,
    squares,
    symbol,
    usual_quantity,
)
from cramp_cli.study.quantities import label, scale_for
from cramp_cli.study.results import frame_at

PLAIN_MAP, SIGNED_MAP = "viridis", "coolwarm"
SHARE = 99.5  # percent of the particles within the colours: a crack tip would take them all
TALLEST = 8.0  # inches
FRAMES_PER_SECOND = 8


class View(NamedTuple):
    """How a picture of a field is made."""

    field: str = ""  # quantity by name; empty: the usual one
    time: float | None = None  # s; None: the last frame
    magnify: float = 1.0  # factor on the displacement


def draw_field(plt, run: Path, view: View):
    """Return a figure of a quantity on the particles at one time, cracks drawn in."""
    particles = frame_at(run, "particles", view.time)
    cracks = _cracks_beside(run, particles)
    stage = _Stage(plt, run, view, [particles])
    stage.show(particles, cracks)
    return stage.figure


def animate(plt, run: Path, view: View, path: Path) -> Path:
    """Write a quantity on the particles over time, all frames with the same colours.

    path: a .gif or an .mp4, for which the program ffmpeg is needed
    Raises FolderError when it is not there, or the run holds no frame.
    """
    writer = _movie_writer(path)
    frames = list(read_frames(run / "particles.h5"))
    if not frames:
        raise FolderError(f"{run / 'particles.h5'}: holds no frame yet")
    stage = _Stage(plt, run, view, frames)
    path.parent.mkdir(parents=True, exist_ok=True)
    stage.show(frames[0], None)
    stage.figure.canvas.draw()  # finds room for all labels once; frames must not jump
    stage.figure.set_layout_engine("none")
    with writer.saving(stage.figure, str(path), dpi=110):
        for frame in frames:
            stage.show(frame, _cracks_beside(run, frame))
            writer.grab_frame()
    return path


def _movie_writer(path: Path):
    from matplotlib.animation import FFMpegWriter, PillowWriter

    if path.suffix == ".gif":
        return PillowWriter(fps=FRAMES_PER_SECOND)
    if not FFMpegWriter.isAvailable():
        raise FolderError(f"{path}: needs the program ffmpeg; `cramp plot ... animation` is a GIF")
    even = "pad=ceil(iw/2)*2:ceil(ih/2)*2"  # most players want pictures of even size
    form = ["-pix_fmt", "yuv420p", "-vf", even]
    return FFMpegWriter(fps=FRAMES_PER_SECOND, extra_args=form)


class _Stage:
    """Axes, colours and sizes that all frames of one picture share."""

    def __init__(self, plt, run: Path, view: View, frames: list[Frame]):
        self.run, self.view = run, view
        self.name = view.field or usual_quantity(frames[-1])
        if not self.name:
            raise FolderError(f"{run / 'particles.h5'}: no field to show; see output.fields")
        self.sizes = particle_sizes(run, frames[0])
        shown = [quantity(frame, self.name) for frame in frames]
        self.limits = colour_limits(shown)
        self.scale = scale_for(shown[0].unit, np.array(self.limits))
        box = _box(squares(frame, self.sizes, view.magnify) for frame in frames)
        self.length = scale_for("m", box)
        self.figure, self.axes = plt.subplots(figsize=_figure_size(box))
        self._frame_axes(box)
        self._colour_bar(plt, shown[0], shown)
        self.drawn = []

    def _frame_axes(self, box) -> None:
        (x0, y0), (x1, y1) = box / self.length.size
        margin = 0.02 * max(x1 - x0, y1 - y0)
        self.axes.set(xlim=(x0 - margin, x1 + margin), ylim=(y0 - margin, y1 + margin))
        self.axes.set_aspect("equal")
        self.axes.set_xlabel(label("$x$", self.length))
        self.axes.set_ylabel(label("$y$", self.length))

    def _colour_bar(self, plt, first: Quantity, shown: list[Quantity]) -> None:
        low, high = (limit / self.scale.size for limit in self.limits)
        norm = plt.Normalize(low, high)
        self.colours = plt.cm.ScalarMappable(norm, SIGNED_MAP if first.signed else PLAIN_MAP)
        over = any(q.values.max() > self.limits[1] * (1 + 1e-9) for q in shown)
        under = first.signed and any(q.values.min() < self.limits[0] * (1 + 1e-9) for q in shown)
        extend = {(0, 0): "neither", (0, 1): "max", (1, 0): "min", (1, 1): "both"}[under, over]
        (x0, x1), (y0, y1) = self.axes.get_xlim(), self.axes.get_ylim()
        flat = x1 - x0 > 1.6 * (y1 - y0)
        place = {"location": "bottom", "aspect": 40} if flat else {"location": "right"}
        bar = self.figure.colorbar(
            self.colours, ax=self.axes, extend=extend, shrink=0.9, pad=0.02, **place
        )
        bar.set_label(label(symbol(self.name), self.scale))
        bar.outline.set_linewidth(0.5)

    def show(self, particles: Frame, cracks: Frame | None) -> None:
        """Replace what is drawn by another moment."""
        from matplotlib.collections import PolyCollection

        for artist in self.drawn:
            artist.remove()
        values = quantity(particles, self.name).values / self.scale.size
        corners = squares(particles, self.sizes, self.view.magnify) / self.length.size
        cloud = PolyCollection(
            corners,
            facecolors=self.colours.to_rgba(values),
            edgecolors="none",
            antialiased=False,
            rasterized=True,
        )
        self.drawn = [self.axes.add_collection(cloud)]
        for around in crack_faces(cracks, particles, self.view.magnify) if cracks else ():
            self.drawn += draw_crack(self.axes, around / self.length.size)
        self.axes.set_title(self._title(particles.time))

    def _title(self, time: float) -> str:
        scale = scale_for("s", time)
        drawn = f", displacement × {self.view.magnify:g}" if self.view.magnify != 1.0 else ""
        return f"$t$ = {time / scale.size:.4g} {scale.unit}{drawn}"


def draw_crack(axes, around: np.ndarray) -> list:
    """Draw both faces of a crack, white between them; points as the axes want them."""
    from matplotlib.patches import Polygon

    inside = axes.add_patch(Polygon(around, facecolor="white", edgecolor="none", zorder=3))
    faces = np.split(around, 2)
    style = {"color": BLACK, "lw": 0.9, "zorder": 4, "solid_capstyle": "round"}
    return [inside, *(axes.plot(*face.T, **style)[0] for face in faces)]


def particle_sizes(run: Path, frame: Frame) -> np.ndarray:
    """Return the side (n,) of the square that each particle stands for (m)."""
    deck = read_deck(run / "resolved.yaml")
    sides = [deck.grid.cell / body.particles_per_cell for body in deck.bodies]
    return np.array(sides)[frame.fields["body"].astype(int)]


def colour_limits(shown: list[Quantity]) -> tuple[float, float]:
    """Return lowest and highest number of the colours, about zero for a signed quantity."""
    values = np.concatenate([one.values[np.isfinite(one.values)] for one in shown])
    high = float(np.percentile(np.abs(values) if shown[0].signed else values, SHARE))
    if shown[0].signed:
        return -(high or 1.0), high or 1.0
    low = min(0.0, float(values.min()))
    return low, high if high > low else low + 1.0


def _box(all_corners) -> np.ndarray:
    """Return lower and upper corner (2, 2) of everything that is drawn (m)."""
    ends = [(c.min(axis=(0, 1)), c.max(axis=(0, 1))) for c in all_corners]
    return np.array([np.min([a for a, _ in ends], axis=0), np.max([b for _, b in ends], axis=0)])


def _figure_size(box) -> tuple[float, float]:
    width, height = box[1] - box[0]
    if width > 1.6 * height:  # the bar of colours is below
        return WIDTH, 1.5 + 0.9 * WIDTH * height / width
    wide = min(WIDTH, 1.8 + (TALLEST - 1.0) * width / height)
    return wide, min(TALLEST, 0.9 + (wide - 1.6) * height / width)


def _cracks_beside(run: Path, particles: Frame) -> Frame | None:
    """Return the cracks at the moment of a frame of particles."""
    if not (run / "cracks.h5").exists():
        return None
    return frame_at(run, "cracks", particles.time)
