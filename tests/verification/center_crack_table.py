"""K_I of a centre crack for 5 x 5 places of its tip in a cell: `python <this file> [cells ...]`.

The plate is inputs/center_crack.yaml: 0.1 m from its middle to its edge, and 0.04 m to the tip. The
crack has n + i/5 cells from the middle to its tip and lies j/5 cells above a row of nodes.
"""

import sys
from concurrent.futures import ProcessPoolExecutor
from itertools import product
from pathlib import Path
from time import perf_counter
from typing import NamedTuple

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from runs import run_input
from verification.solutions import center_crack

SIGMA, HALF_WIDTH = 1e6, 0.1  # Pa, m
A = 0.04  # m: half the crack with its tip on a node
PLACES = list(product(range(5), range(5)))  # (i, j): of the tip, of the line, in fifths of a cell
PROCESSES = 2


class Intensity(NamedTuple):
    """K at the tip over the exact K_I."""

    one: float  # K_I
    two: float  # K_II
    status: str


def crack_settings(cells, tip, line):
    """Return the settings of -s for n cells per half crack and a place in fifths of a cell."""
    h = A / cells
    points = [[0, line / 5 * h], [A + tip / 5 * h, line / 5 * h]]
    return f"grid.cell={h}", f"cracks.centre.points={points}"


def intensity(cells, tip, line, *more):
    """Return K of the plate at rest over the exact K_I; `more` are further settings of -s."""
    settings = crack_settings(cells, tip, line)
    brief = "fracture.every=1 ms", "output.particles=false"
    row = run_input("center_crack", *settings, *brief, *more).tip("end")[-1]
    exact = center_crack(SIGMA, A + tip / 5 * A / cells, HALF_WIDTH)
    return Intensity(row["K_I"] / exact, row["K_II"] / exact, row["status"])


def table(cells):
    """Return intensities by place, found by several processes."""
    with ProcessPoolExecutor(PROCESSES) as pool:
        found = [pool.submit(intensity, cells, *place) for place in PLACES]
        return {place: one.result() for place, one in zip(PLACES, found, strict=True)}


def write(cells, found):
    """Print K_I / exact and K_II / exact, rows by line and columns by tip."""
    for name, values in (("K_I / exact", "one"), ("K_II / exact", "two")):
        print(
            f"\n{name}, a = ({cells} + tip) cells\nline \\ tip"
            + "".join(f"{i / 5:9.1f}" for i in range(5))
        )
        for j in range(5):
            row = (getattr(found[i, j], values) for i in range(5))
            print(f"{j / 5:10.1f}" + "".join(f"{value:9.4f}" for value in row))
    odd = {place: one.status for place, one in found.items() if one.status != "ok"}
    if odd:
        print("status:", odd)


if __name__ == "__main__":
    for count in [int(word) for word in sys.argv[1:]] or [10, 20]:
        begun = perf_counter()
        write(count, table(count))
        print(f"{perf_counter() - begun:.0f} s", flush=True)
