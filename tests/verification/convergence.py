"""Orders of convergence and K over the place of a tip in its cell, as the page docs/convergence.md.

    python tests/verification/convergence.py > docs/convergence.md

Twenty minutes on two processors. The tests beside this file assert what the page shows.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import numpy as np
from verification.center_crack_table import intensity, table
from verification.test_manufactured import (
    CELLS,
    AlongAxes,
    Vortex,
    VortexInPlate,
    VortexWithin,
    error,
)

SHAPES = ("ugimp", "cpdi", "bspline2", "bspline3")
MOTIONS = {
    "along the axes": AlongAxes,
    "vortex in a plate": VortexInPlate,
    "smooth vortex": VortexWithin,
    "vortex, free edges": Vortex,
}
CRACKS = (6, 12, 24)  # cells per half crack

HEAD = """# Convergence

This page is generated: `python tests/verification/convergence.py > docs/convergence.md`.

## Manufactured motions

A motion is chosen and the body force that it needs is given to every particle (neo-Hookean
rubber; `tests/verification/test_manufactured.py`). The error is the rms of the displacement when it
is largest, as a share of the largest displacement, with {cells} cells per metre.

*Along the axes*: a standing wave along both axes. *Vortex in a plate*: the ring of the usual test
turns to and fro within a solid that rests. *Smooth vortex*: its motion vanishes at both edges with
one more derivative. *Vortex, free edges*: the ring alone; its body force ends with a jump at edges
that particles make as stairs, so its order is that of the edges.

| motion | shape | {errors} | orders |
|---|---|{rules}|---|"""
CRACK = """
## K of a centre crack

`inputs/center_crack.yaml`: the largest error over five places of the tip in its cell, the crack 0.4
cells above a row of nodes. What is left is too little to tell an order; that of the edge crack, the
harder case, is 1.4 from five to ten cells (`tests/verification/test_rest.py`).

| cells per half crack | K_I | order |
|---|---|---|"""


def motions() -> None:
    """Print the errors and orders of all motions and shapes."""
    errors = " | ".join(f"{n} cells" for n in CELLS)
    cells = ", ".join(map(str, CELLS))
    print(HEAD.format(cells=cells, errors=errors, rules="|".join("---" for _ in CELLS)))
    for name, motion in MOTIONS.items():
        for shape in SHAPES:
            found = np.array([error(motion(), cells, shape) for cells in CELLS])
            orders = ", ".join(f"{o:.2f}" for o in np.log2(found[:-1] / found[1:]))
            numbers = " | ".join(f"{100 * e:.3g} %" for e in found)
            print(f"| {name} | `{shape}` | {numbers} | {orders} |", flush=True)


def crack() -> None:
    """Print the largest error of K_I of a centre crack over grids."""
    print(CRACK)
    before = None
    for cells in CRACKS:
        off = max(abs(intensity(cells, tip, 2).one - 1.0) for tip in range(5))
        order = f"{np.log2(before / off):.2f}" if before else ""
        print(f"| {cells} | {100 * off:.2f} % | {order} |", flush=True)
        before = off


def places() -> None:
    """Print K_I over the exact one for 25 places of the tip in its cell."""
    for cells in (10, 20):
        found = {place: one.one for place, one in table(cells).items()}
        low, high = min(found.values()), max(found.values())
        print(f"\n{cells} cells per half crack, K_I over the exact one by the place of the tip:")
        print(f"from {low:.4f} to {high:.4f}.\n")
        tips = " | ".join(f"tip at {i / 5}" for i in range(5))
        print(f"| line above a row of nodes | {tips} |\n{6 * '|---'}|")
        for j in range(5):
            row = " | ".join(f"{found[i, j]:.4f}" for i in range(5))
            print(f"| {j / 5} | {row} |", flush=True)


if __name__ == "__main__":
    motions()
    crack()
    places()
