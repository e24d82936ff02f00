"""J, K_I and K_II of tips as means over the time in which a wave crosses a domain.

A single sample holds waves of the length of a few cells, which the grid makes rather than the
solid: the domain sees them pass to and fro. Their mean over that time is next to nothing; the load
on a tip changes more slowly. The mean belongs to the middle of its time, which stands beside it.
"""

from math import nan, sqrt

import numpy as np

from cramp_cli.cracks.domain import USUAL
from cramp_cli.cracks.site import site_of
from cramp_cli.cracks.tip_domain import measure_domain, recall_growth
from cramp_cli.cracks.tips import tips_of
from cramp_cli.materials.law import confined_modulus

SAMPLES = 10  # within the time of a mean
NAMES = ("J", "K_I", "K_II")


def crossing_time(model, block) -> float:
    """Return the time (s) that a wave in a material takes through the domain of a tip."""
    radii = model.fracture.radii
    radius = radii[0] if radii else USUAL * model.lattice.width
    return 2.0 * radius * sqrt(block.density / confined_modulus(block.law))


class TipMeans:
    """Samples of the last moments, for the means that stand in the rows of cracks.csv."""

    def __init__(self, model):
        self.longest = max(crossing_time(model, block) for block in model.blocks)
        shortest = min(crossing_time(model, block) for block in model.blocks)
        self.stride = max(int(shortest / SAMPLES / model.dt), 1)  # steps
        self.samples = {}  # by tip: time (s), J, K_I, K_II of the last moments

    def after_step(self, model, state, scratch, next_row) -> None:
        """Sample the tips while a mean is due soon; next_row: time of the next row (s)."""
        near = state.time > next_row - self.longest - (self.stride + 1) * model.dt
        if near and state.step % self.stride == 0:
            for tip in tips_of(state.paths):
                self._note(_key(model, tip), state.time, _measured(model, state, scratch, tip))

    def of_rows(self, model, state, scratch, rows) -> list[dict]:
        """Return the rows of all tips with the means up to now."""
        blocks = [site_of(model, state, scratch, tip).block for tip in tips_of(state.paths)]
        means = []
        for row, block in zip(rows, blocks, strict=True):
            key = f"{row['crack']} {row['tip']}"
            self._note(key, state.time, [row[name] for name in NAMES])
            since = state.time - crossing_time(model, block) - 0.5 * model.dt
            means.append(row | _mean(np.array(self.samples[key]), since))
        return means

    def _note(self, key, time, values) -> None:
        kept = self.samples.setdefault(key, [])
        if kept and kept[-1][0] == time:
            kept.pop()
        kept.append([time, *values])
        while kept[0][0] < time - 1.01 * self.longest:
            kept.pop(0)


def _key(model, tip) -> str:
    return f"{model.crack_names[tip.crack]} {('start', 'end')[tip.end]}"


def _measured(model, state, scratch, tip) -> list[float]:
    """Return J, K_I, K_II of a tip; nan where it has none."""
    grown = state.growth.length[2 * tip.crack + tip.end] > 0.0
    measure = recall_growth if grown else measure_domain
    found, _ = measure(model, state, scratch, tip, site_of(model, state, scratch, tip))
    return [found.get(name, nan) for name in NAMES]


def _mean(samples, since) -> dict:
    """Return the means (trapezoids) of the samples since a time (s), and when they belong to."""
    time, *values = samples[samples[:, 0] >= since].T
    way = time[-1] - time[0]
    means = [np.trapezoid(v, time) / way if way > 0.0 else v[-1] for v in values]
    found = {f"{name}_mean": float(v) for name, v in zip(NAMES, means, strict=True)}
    return found | {"time_mean": float(0.5 * (time[0] + time[-1]))}
