"""Has a run with damping come to rest? K of every tip and the strain energy, watched over time.

A static answer is what stands when nothing changes any more. Looked at is the last stretch, a
period of the slowest motion (state/rest.py): what swings shows its range there. What creeps is
carried on by the ratio of its last two steps, half a stretch each (docs/theory/rest.md).
"""

from math import copysign, isfinite, isnan, nan, sqrt
from typing import NamedTuple

import numpy as np

from cramp_cli.cracks.domain import hooke_of
from cramp_cli.cracks.doubts import AROUND, NOISE
from cramp_cli.cracks.tips import sample_tips, tips_of
from cramp_cli.state.rest import near_critical, stretch_of, swing

EVERY = 20  # steps from one look to the next
SAMPLES = 32  # in a stretch
KEPT = 2.0  # stretches
SETTLED = 0.01  # share by which what is at rest may change
STEEPEST = 0.9  # largest ratio of two steps with which a creep is carried on
ENERGY = "strain energy"
WORDS = {"K": "moving: K still changes by {}", "J": "moving: J still changes by {}"}


class Amount(NamedTuple):
    """What is watched at a tip: K_I and K_II, or where there is no K the root of J."""

    what: str  # K or J
    value: list


class Settling:
    """Watches a run; what it remembers is numbers and words."""

    REMEMBERED = ("samples", "stretch", "noise", "rested")  # by a checkpoint

    def __init__(self, model):
        self.samples = []  # [time (s), {what is watched: its components}]
        self.stretch = model.end_time  # s
        self.noise = {"K": 0.0, "J": 0.0}  # amounts below which there is nothing to settle
        self.rested = nan  # when all was at rest (s)

    def look(self, model, state, scratch) -> None:
        """Find the damping of the next steps, and note what is watched; call it after a step."""
        rest = model.rest
        if state.step % EVERY or not rest.watched:
            return
        now = swing(model, state)
        if rest.auto:
            state.drag[1] = near_critical(now.frequency)
        drag = state.drag.tolist() if rest.auto else model.damping
        self.stretch, self.noise = stretch_of(now.frequency, sum(drag)), _noise(model, now)
        watches = rest.stops or model.crack_names
        if watches and self._is_due(state.time):
            self._note(state.time, _amounts(model, state, scratch) | {ENERGY: [now.strained]})
            if rest.stops and self._is_at_rest(model, state, now):
                self.rested = state.time

    def with_words(self, model, rows) -> list[dict]:
        """Return rows of cracks.csv with a word in the status where K has not settled."""
        return [self._with_word(row) for row in rows] if model.rest.watched else rows

    @property
    def has_ended(self) -> bool:
        """Whether all is at rest, and the run over."""
        return not isnan(self.rested)

    def outcome(self, model, tips) -> str:
        """Return what is to be said at the end of a run; tips: their last rows."""
        if self.has_ended:
            return f"at rest at {self.rested:.6g} s"
        moving = [row["status"].split("moving: ")[1] for row in tips if "moving: " in row["status"]]
        if moving or model.rest.stops:
            text = ": ".join(["not at rest", *moving[:1]])
            return f"{text}; solver.end_time is the limit" if model.rest.stops else text
        return "K of all tips has settled to 1 %" if model.rest.watched and tips else ""

    def _is_due(self, time) -> bool:
        return not self.samples or time >= self.samples[-1][0] + self.stretch / SAMPLES

    def _note(self, time, watched) -> None:
        begin = time - KEPT * self.stretch
        self.samples = [one for one in self.samples if one[0] >= begin]
        self.samples.append([time, watched])

    def _with_word(self, row) -> dict:
        if row["speed"] > 0.0 or row["time"] == 0.0:
            return row
        what, value = _amount(row)
        change = self._change(_key(what, row["crack"], row["tip"]), row["time"], value)
        change *= 2.0 if what == "J" else 1.0  # its root was watched
        if not change > SETTLED:
            return row
        word = WORDS[what].format(_percent(change))
        before = "" if row["status"] == "ok" else f"{row['status']}; "
        return row | {"status": before + word}

    def _change(self, name, time, value) -> float:
        """Return the share by which a watched amount still changes, from all before and now."""
        past = [(one[0], one[1][name]) for one in self.samples if name in one[1] and one[0] < time]
        times = [t for t, _ in past] + [time]
        values = np.array([v for _, v in past] + [value])
        return change_over(np.array(times), values, self.stretch, self.noise.get(name[0], 0.0))

    def _is_at_rest(self, model, state, now) -> bool:
        if any(state.growth.speed > 0.0) or now.kinetic > SETTLED * now.strained:
            return False
        if state.time < _loaded(model, state) or state.time < self.stretch:
            return False
        time, last = self.samples[-1]
        return all(self._change(name, time, value) <= SETTLED for name, value in last.items())


def change_over(times, values, stretch: float, noise: float) -> float:
    """Return by which share of its size an amount still changes.

    times: (n,) rising (s); values: (n, components) at these times; stretch: time looked at (s)
    noise: size of what is nothing. The range over the stretch, or what a creep has still before it:
    a step d over half a stretch that follows one of d/r goes on by d r/(1 - r).
    """
    begin = times[-1] - stretch
    first = max(int(np.searchsorted(times, begin, side="right")) - 1, 0)
    seen = values[first:]
    size = float(np.sqrt(np.sum(seen * seen, axis=1)).max())
    if size <= noise:
        return 0.0
    middle = values[
        max(int(np.searchsorted(times, 0.5 * (begin + times[-1]), side="right")) - 1, 0)
    ]
    before, after = middle - values[first], values[-1] - middle
    left = max(map(_still_to_come, before.tolist(), after.tolist()))
    return max(float(np.ptp(seen, axis=0).max()), left) / size


def _still_to_come(before: float, after: float) -> float:
    """Return what two steps on one way let expect beyond them; nothing if it turned back."""
    if before * after <= 0.0:
        return 0.0
    ratio = min(after / before, STEEPEST)
    return abs(after) * ratio / (1.0 - ratio)


def _amount(row) -> Amount:
    """Return what is watched in a row of cracks.csv; of no size where nothing is known."""
    for names in (("K_I", "K_II"), ("K_I_contour", "K_II_contour")):
        K = [row[name] for name in names]
        if all(map(isfinite, K)):
            return Amount("K", K)
    J = row["J"] if isfinite(row["J"]) else row["J_contour"]
    return Amount("J", [copysign(sqrt(abs(J)), J) if isfinite(J) else 0.0])


def _amounts(model, state, scratch) -> dict:
    """Return what is watched at all tips; where cracks grow their load is known already."""
    if model.propagation is not None:
        load = state.growth.load
        names = [
            (model.crack_names[t.crack], ("start", "end")[t.end]) for t in tips_of(state.paths)
        ]
        lines = [2 * t.crack + t.end for t in tips_of(state.paths)]
        return {
            _key("K", *name): load[k, 1:].tolist() for name, k in zip(names, lines, strict=True)
        }
    found = [(row, _amount(row)) for row in sample_tips(model, state, scratch)]
    return {_key(a.what, row["crack"], row["tip"]): a.value for row, a in found}


def _key(what, crack, tip) -> str:
    return f"{what} {crack} {tip}"


def _noise(model, now) -> dict:
    """Return K and the root of J that are nothing beside the strain energy (doubts.py)."""
    stiffness = [
        hooke_of(b.law, model.geometry).stiffness for b in model.blocks if b.law is not None
    ]
    J = NOISE * AROUND * model.lattice.width * now.strained / now.volume
    known = [one for one in stiffness if isfinite(one)]
    return {"K": sqrt(max(known, default=0.0) * max(J, 0.0)), "J": sqrt(max(J, 0.0))}


def _loaded(model, state) -> float:
    """Return when loads stop to change (s): after an event that turns them back they need a while.

    A load that goes back the way it came is there when as much time has gone again.
    """
    happened = state.events[np.isfinite(state.events)]
    return max(model.rest.loads_until, 2.0 * float(happened.max(initial=0.0)))


def _percent(share: float) -> str:
    return f"{100.0 * share:.2g} %" if share < 0.995 else "100 % or more"
