"""A picture of the cracks alone: where they began, where they are, how far they are open."""

from pathlib import Path

import numpy as np

from cramp_cli.deck.deck import read_deck
from cramp_cli.study.figures import BLACK, CYCLE, GREY, WIDTH
from cramp_cli.study.quantities import Scale, label, scale_for
from cramp_cli.study.results import first_frame, frame_at
from cramp_cli.study.snapshots import View


def draw_path(plt, run: Path, view: View):
    """Return a figure of the cracks: where they began, where they are, how far they are open.

    The opening is magnified so that it can be seen; the legend says how much.
    """
    begun, now = first_frame(run, "cracks"), frame_at(run, "cracks", view.time)
    line, opening = now.points[:, :2], now.fields["opening"][:, :2]
    reach, widest = np.ptp(line, axis=0).max(), np.abs(opening).max(initial=0.0)
    factor = _round_number(0.12 * reach / widest) if widest > 1e-9 * reach else 1.0
    half = 0.5 * factor * opening
    length = scale_for("m", np.abs(line).max(axis=0))
    box = np.array([(line - np.abs(half)).min(axis=0), (line + np.abs(half)).max(axis=0)])
    figure, axes = plt.subplots(figsize=_path_size(box))
    names = [crack.name for crack in read_deck(run / "resolved.yaml").cracks]
    for number, name in enumerate(names):
        mine = slice(now.offsets[number], now.offsets[number + 1])
        _draw_opened(axes, line[mine], half[mine], length, CYCLE[number % len(CYCLE)], name)
        if begun is not None:
            mine = slice(begun.offsets[number], begun.offsets[number + 1])
            first = begun.points[mine, :2] / length.size
            text = "at the start" if number == 0 else None
            axes.plot(*first.T, color=BLACK, ls=(0, (4, 2)), lw=0.9, label=text, zorder=4)
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_xlabel(label("$x$", length))
    axes.set_ylabel(label("$y$", length))
    axes.grid()
    time = scale_for("s", now.time)
    drawn = f", opening × {factor:g}" if factor != 1.0 else ""
    axes.set_title(f"$t$ = {now.time / time.size:.4g} {time.unit}{drawn}")
    figure.legend(loc="outside lower left", ncols=4)
    return figure


def _draw_opened(axes, line, half, length: Scale, colour, name) -> None:
    around = np.vstack([line + half, (line - half)[::-1]]) / length.size
    axes.fill(*around.T, facecolor=colour, alpha=0.18, edgecolor="none")
    axes.plot(*(line + half).T / length.size, color=colour, lw=1.2, label=f"{name}, both faces")
    axes.plot(*(line - half).T / length.size, color=colour, lw=1.2)
    axes.plot(*line[[0, -1]].T / length.size, "o", color=GREY, ms=3, zorder=5)


def _path_size(box) -> tuple[float, float]:
    width, height = np.maximum(box[1] - box[0], 1e-12)
    return WIDTH, float(np.clip(1.4 + 0.9 * WIDTH * height / width, 2.4, 6.0))


def _round_number(value: float) -> float:
    """Return 1, 2 or 5 times a power of ten, not above a value; at least 1."""
    if value < 1.0:
        return 1.0
    power = 10.0 ** np.floor(np.log10(value))
    return float(power * max(step for step in (1.0, 2.0, 5.0) if step * power <= value))
