"""A picture of a deck: bodies, cracks, tips with their J domains, loads, boundary, grid."""

from pathlib import Path

import numpy as np

from cramp_cli.deck.deck import Deck
from cramp_cli.study.figures import WIDTH, drawing, save
from cramp_cli.study.quantities import label, scale_for
from cramp_cli.study.sketch import Sketch

REACH = 0.07  # length of an arrow, of the picture
TALLEST, BESIDE = 8.5, 1.9  # inches; room for the legend


def preview(deck: Deck, path: Path) -> Path:
    """Draw a deck into a file (png, pdf or svg)."""
    with drawing() as plt:
        return save(draw_deck(plt, deck), path)


def draw_deck(plt, deck: Deck):
    """Return a figure of a deck at time 0, lengths as in the deck's box of cells."""
    box = deck.lattice_box()
    corners = np.array([box.lower, box.upper])
    length = scale_for("m", corners)
    figure, axes = plt.subplots(figsize=_size(corners))
    sketch = Sketch(axes, deck, length, REACH * float(np.ptp(corners, axis=0).max()))
    sketch.grid()
    sketch.bodies()
    sketch.boundary()
    sketch.loads()
    sketch.cracks()
    axes.set_aspect("equal")
    lower, upper = np.min(sketch.reached, axis=0), np.max(sketch.reached, axis=0)
    axes.set_xlim(lower[0] / length.size, upper[0] / length.size)
    axes.set_ylim(lower[1] / length.size, upper[1] / length.size)
    axes.set_xlabel(label("$x$", length))
    axes.set_ylabel(label("$y$", length))
    figure.suptitle(deck.title, x=0.01, ha="left", fontsize="medium")
    beside = {"loc": "upper left", "bbox_to_anchor": (1.02, 1.02), "handlelength": 1.8}
    axes.legend(handles=_each_once(axes), **beside)
    return figure


def _size(corners) -> tuple[float, float]:
    width, height = np.ptp(corners, axis=0)
    wide = min(WIDTH, BESIDE + 0.6 + (TALLEST - 0.9) * width / height)
    wide = max(wide, BESIDE + 2.4)
    return wide, min(TALLEST, 0.9 + (wide - BESIDE - 0.6) * height / width)


def _each_once(axes) -> list:
    handles, texts = axes.get_legend_handles_labels()
    return list(dict(zip(reversed(texts), reversed(handles), strict=True)).values())[::-1]
