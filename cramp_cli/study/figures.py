"""What all pictures share: matplotlib when it is there, size, ink and colours.

Colours are those of Okabe and Ito (2008), which people with any kind of colour vision tell apart;
lines differ in dash as well, so that a print without colour still says which is which.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from cramp_cli.output.exits import FolderError

BLUE, ORANGE, GREEN, RED, PURPLE = "#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7"
SKY, GREY, BLACK = "#56B4E9", "#6B6B6B", "#1A1A1A"
CYCLE = (BLUE, RED, GREEN, PURPLE, ORANGE, SKY)
WIDTH = 6.3  # inches; two columns of a journal
FORMS = ("png", "pdf", "svg")
STYLE = {
    "font.size": 9.0,
    "axes.titlesize": 9.5,
    "axes.titlelocation": "left",
    "axes.labelsize": 9.0,
    "axes.edgecolor": BLACK,
    "axes.labelcolor": BLACK,
    "axes.linewidth": 0.7,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.formatter.useoffset": False,
    "axes.grid": False,
    "grid.color": "#DDDDDD",
    "grid.linewidth": 0.5,
    "xtick.color": BLACK,
    "ytick.color": BLACK,
    "xtick.major.width": 0.7,
    "ytick.major.width": 0.7,
    "text.color": BLACK,
    "mathtext.default": "it",
    "lines.linewidth": 1.4,
    "lines.markersize": 3.5,
    "legend.frameon": False,
    "legend.fontsize": 8.0,
    "figure.facecolor": "white",
    "figure.constrained_layout.use": True,
    "savefig.facecolor": "white",
    "savefig.dpi": 220,
    "pdf.fonttype": 42,
    "svg.fonttype": "none",
}


class NoMatplotlib(FolderError):
    """Pictures are asked for and matplotlib is not installed."""


@contextmanager
def drawing() -> Iterator:
    """Give pyplot, set up for print, and close all figures at the end.

    Raises NoMatplotlib when it is not installed.
    """
    try:
        import matplotlib
    except ImportError:
        told = "pictures need matplotlib; install it with: pip install 'cramp[plot]'"
        raise NoMatplotlib(told) from None
    matplotlib.use("Agg")
    from matplotlib import pyplot

    with pyplot.rc_context(STYLE):
        try:
            yield pyplot
        finally:
            pyplot.close("all")


def save(figure, path: Path) -> Path:
    """Write a figure to a file whose ending tells its form.

    Raises FolderError for another ending than png, pdf and svg.
    """
    if path.suffix.lstrip(".").lower() not in FORMS:
        raise FolderError(f"{path}: a picture's name ends with .png, .pdf or .svg")
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, bbox_inches="tight", pad_inches=0.04)
    return path
