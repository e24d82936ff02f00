"""Can the way of a running tip be told by its K? Not where a stress along the crack turns it away.

A straight crack with the stress T along its faces leaves its way by any small turn if T > 0: the
turn grows by the factor e within K^2/(8 T^2) (Cotterell and Rice 1980, eq. 30). Where that is
shorter than a cell no grid shows where the crack goes, and a path that is symmetric stays so only
down to round-off.
"""

import numpy as np

BEHIND, ASIDE = (1.5, 5.0), 1.0  # cells behind a tip, and beside its line, where T is read
SHORT = 1.0  # cells
UNSTABLE, WAS_UNSTABLE = "the way is unstable", "the way was unstable"


def unstable_path(model, site, row) -> list[str]:
    """Return a word on a running tip whose way hangs on what is smaller than a cell."""
    width, T = model.lattice.width, stress_along(site, model.lattice.width)
    square = row["K_I"] ** 2 + row["K_II"] ** 2
    if not T > 0.0 or not square < 8.0 * SHORT * width * T * T:
        return []
    cells = square / (8.0 * T * T) / width
    text = "doubtful: the way is unstable, a turn grows by e within {:.2g} cells (T = {:.2g} Pa)"
    return [text.format(cells, T)]


def with_past(rows, told) -> list[dict]:
    """Return rows of cracks.csv with a word on tips whose way was unstable before.

    told: what has been said so far, of an unstable way with the name of the tip
    """
    return [_with_past(row, f"{UNSTABLE} {row['crack']} {row['tip']}" in told) for row in rows]


def _with_past(row, was_unstable: bool) -> dict:
    if not was_unstable or UNSTABLE in row["status"]:
        return row
    before = "" if row["status"] == "ok" else f"{row['status']}; "
    return row | {"status": f"{before}doubtful: {WAS_UNSTABLE}"}


def stress_along(site, width) -> float:
    """Return the stress along the faces behind a tip, T (Pa); 0 where nothing lies beside them.

    The mean over both sides: there the field of K_I has no such stress, that of K_II opposite ones.
    """
    particles, (ex, ey), (nx, ny) = site.cloud.particles, site.frame.before, site.frame.now
    away = particles.origin - np.array(site.frame.origin)
    behind, aside = -(away @ (ex, ey)) / width, away @ (-ey, ex) / width
    band = (behind > BEHIND[0]) & (behind < BEHIND[1]) & (np.abs(aside) < ASIDE)
    sides = [band & (aside > 0.0), band & (aside < 0.0)]
    seen = [one for one in sides if one.any()]
    xx, yy, _, xy = particles.stress.T[:4]
    along = xx * nx * nx + yy * ny * ny + 2.0 * xy * nx * ny
    return float(np.mean([along[one].mean() for one in seen])) if seen else 0.0
