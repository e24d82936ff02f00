"""How far every end of a crack has grown, and what drives it."""

from typing import NamedTuple

import numpy as np

OWN, KINK, BLEND, HELD, BLIND, MIXED = range(6)  # where the load of a tip was found


class Growth(NamedTuple):
    """One line for each end of each crack: 2 * crack + end.

    Directions and corners are those of the undeformed body.
    """

    heading: np.ndarray  # (ends, dim) unit vector out of the crack at its end
    initial: np.ndarray  # (ends, dim) the same at the start of the run
    corner: np.ndarray  # (ends, dim) place of the last sharp bend (m)
    parent: np.ndarray  # (ends, dim) heading before that bend
    kink: np.ndarray  # (ends,) length grown since that bend, inf if there is none near (m)
    piece: np.ndarray  # (ends,) length of the piece that grows now (m)
    owed: np.ndarray  # (ends,) growth too short to be laid out yet (m)
    speed: np.ndarray  # (ends,) m/s
    load: np.ndarray  # (ends, 3) J (J/m^2), K_I, K_II (Pa sqrt(m)) when last found
    mean: np.ndarray  # (ends, 2) sums of K_I and K_II times the way of the piece (Pa m^1.5)
    stage: np.ndarray  # (ends,) where the load was found: OWN, KINK, ...
    reach: np.ndarray  # (ends,) radius of the domain in which it was last found (m)
    unseen: np.ndarray  # (ends,) length grown since the load was last found (m)
    running: np.ndarray  # (ends,) 1 from the onset to an arrest
    rested: np.ndarray  # (ends,) time at rest since it last moved (s)
    length: np.ndarray  # (ends,) grown so far (m)
    ahead: np.ndarray  # (ends,) energy of its way that the solid has not lost yet (J)
    taken: np.ndarray  # (ends,) energy taken beside its domain since it moved last (J)
    beside: np.ndarray  # (ends,) the same per area of its way, of late (J/m^2)
    smoothed: np.ndarray  # (ends,) length at which its wake was smoothed last (m)
    wall: np.ndarray  # (ends,) toughness of the interface that the piece runs along (J/m^2), or 0
    energy: np.ndarray  # (ends,) spent on new surface so far (J)
    pending: np.ndarray  # (ends,) part of it that no event has told yet (J)


def make_growth(paths) -> Growth:
    """Return the ends of all cracks as they are before they grow."""
    heads = [_heading(paths, crack, end) for crack in range(paths.crack_count) for end in (0, 1)]
    heading = np.array(heads).reshape(len(heads), paths.point.shape[1])
    n = len(heads)
    return Growth(
        heading=heading,
        initial=heading.copy(),
        corner=np.zeros_like(heading),
        parent=heading.copy(),
        kink=np.full(n, np.inf),
        piece=np.full(n, np.inf),
        owed=np.zeros(n),
        speed=np.zeros(n),
        load=np.zeros((n, 3)),
        mean=np.zeros((n, 2)),
        stage=np.full(n, BLIND, dtype=np.int64),
        reach=np.zeros(n),
        unseen=np.zeros(n),
        running=np.zeros(n, dtype=np.int64),
        rested=np.zeros(n),
        length=np.zeros(n),
        ahead=np.zeros(n),
        taken=np.zeros(n),
        beside=np.zeros(n),
        smoothed=np.zeros(n),
        wall=np.zeros(n),
        energy=np.zeros(n),
        pending=np.zeros(n),
    )


def running_tips(growth: Growth) -> list[int]:
    """Return the ends (2 * crack + end) that run, or pause for less than an arrest takes."""
    return np.flatnonzero(growth.running).tolist()


def _heading(paths, crack: int, end: int) -> np.ndarray:
    points = paths.origin[paths.crack(crack)]
    out = points[-1] - points[-2] if end else points[0] - points[1]
    return out / np.linalg.norm(out)
