"""Functions of time as data: what a load or a prescribed velocity is multiplied by.

Each kind answers with its value at a time, and with its integral from time 0 on: how far a
prescribed velocity has gone.
"""

from bisect import bisect_right
from collections.abc import Iterator
from math import cos, inf, pi, radians, sin
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field

from cramp_cli.schema.section import Section, Wrong, one_of, unknown
from cramp_cli.schema.units import Angle, Frequency, Number, Time, complaint


class Constant(Section):
    """1 at all times."""

    type: Literal["constant"] = Field("constant", description="kind of curve")

    def value(self, t: float) -> float:
        """Return the factor at time t (s)."""
        return 1.0

    def integral(self, t: float) -> float:
        """Return the integral of the factor from time 0 to t >= 0 (s)."""
        return t

    @property
    def last_change(self) -> float:
        """Time from which on the factor stays (s)."""
        return 0.0


class Step(Section):
    """Full from time 0, the same as `constant`."""

    type: Literal["step"] = Field("step", description="kind of curve")

    def value(self, t: float) -> float:
        """Return the factor at time t (s)."""
        return 1.0

    def integral(self, t: float) -> float:
        """Return the integral of the factor from time 0 to t >= 0 (s)."""
        return t

    @property
    def last_change(self) -> float:
        """Time from which on the factor stays (s)."""
        return 0.0


class Ramp(Section):
    """0 until `start`, then a straight line to 1 at `until`, then 1."""

    type: Literal["ramp"] = Field("ramp", description="kind of curve")
    until: Time = Field(description="time at which the factor is 1")
    start: Time = Field(0.0, description="time at which it leaves 0")

    def wrong_values(self) -> Iterator[Wrong]:
        """The ramp needs time to rise."""
        if self.until <= self.start:
            yield ("until",), f"must be later than start (got {self.until:g} s, {self.start:g} s)"

    def value(self, t: float) -> float:
        """Return the factor at time t (s)."""
        return min(max((t - self.start) / (self.until - self.start), 0.0), 1.0)

    def integral(self, t: float) -> float:
        """Return the integral of the factor from time 0 to t >= 0 (s)."""
        return self._area(t) - self._area(0.0)

    @property
    def last_change(self) -> float:
        """Time from which on the factor stays (s)."""
        return self.until

    def _area(self, t: float) -> float:
        rising = min(max(t - self.start, 0.0), self.until - self.start)
        return 0.5 * rising**2 / (self.until - self.start) + max(t - self.until, 0.0)


class Table(Section):
    """Straight lines between points in time; the ends are held."""

    type: Literal["table"] = Field("table", description="kind of curve")
    time: tuple[Time, ...] = Field(min_length=1, description="times, increasing")
    value_at: tuple[Number, ...] = Field(
        alias="value", min_length=1, description="the factor at each time"
    )

    def wrong_values(self) -> Iterator[Wrong]:
        """Each time has a value, and times increase."""
        if len(self.time) != len(self.value_at):
            counts = f"{len(self.value_at)} values, {len(self.time)} times"
            yield ("value",), f"must have one value for each time (got {counts})"
        for place, (before, after) in enumerate(zip(self.time, self.time[1:], strict=False)):
            if after <= before:
                message = f"times must increase (got {after:g} s after {before:g} s)"
                yield ("time", place + 1), message

    def value(self, t: float) -> float:
        """Return the factor at time t (s)."""
        after = bisect_right(self.time, t)
        if after in (0, len(self.time)):
            return self.value_at[-1 if after else 0]
        t0, t1 = self.time[after - 1], self.time[after]
        v0, v1 = self.value_at[after - 1], self.value_at[after]
        return v0 + (v1 - v0) * (t - t0) / (t1 - t0)

    def integral(self, t: float) -> float:
        """Return the integral of the factor from time 0 to t >= 0 (s)."""
        inner = [time for time in self.time if 0.0 < time < t]
        times = [0.0, *inner, t]
        values = [self.value(time) for time in times]
        pieces = zip(times, times[1:], values, values[1:], strict=False)
        return sum(0.5 * (v0 + v1) * (t1 - t0) for t0, t1, v0, v1 in pieces)

    @property
    def last_change(self) -> float:
        """Time from which on the factor stays (s)."""
        return self.time[-1]


class Sine(Section):
    """0 before `start`, then sin(2 pi frequency (t - start) + phase), for a number of cycles."""

    type: Literal["sine"] = Field("sine", description="kind of curve")
    frequency: Frequency = Field(gt=0, description="cycles per second")
    phase: Angle = Field(0.0, description="phase at `start`")
    start: Time = Field(0.0, description="time of the first cycle's begin")
    cycles: Number | None = Field(
        None, gt=0, description="number of cycles, then 0; without end if not given"
    )

    def value(self, t: float) -> float:
        """Return the factor at time t (s)."""
        turns = self.frequency * (t - self.start)
        if turns < 0.0 or (self.cycles is not None and turns > self.cycles):
            return 0.0
        return sin(2.0 * pi * turns + radians(self.phase))

    def integral(self, t: float) -> float:
        """Return the integral of the factor from time 0 to t >= 0 (s)."""
        return self._area(t) - self._area(0.0)

    @property
    def last_change(self) -> float:
        """Time from which on the factor stays (s); infinite without a number of cycles."""
        return inf if self.cycles is None else self.start + self.cycles / self.frequency

    def _area(self, t: float) -> float:
        turns = max(self.frequency * (t - self.start), 0.0)
        turns = turns if self.cycles is None else min(turns, self.cycles)
        phase = radians(self.phase)
        return (cos(phase) - cos(2.0 * pi * turns + phase)) / (2.0 * pi * self.frequency)


class Pulse(Section):
    """0, except for one pulse of height 1."""

    type: Literal["pulse"] = Field("pulse", description="kind of curve")
    duration: Time = Field(gt=0, description="length of the pulse")
    start: Time = Field(0.0, description="begin of the pulse")
    shape: Literal["square", "half_sine", "triangle"] = Field("square", description="its form")

    def value(self, t: float) -> float:
        """Return the factor at time t (s)."""
        share = (t - self.start) / self.duration
        if not 0.0 <= share < 1.0:
            return 0.0
        if self.shape == "half_sine":
            return sin(pi * share)
        return 1.0 if self.shape == "square" else 1.0 - abs(2.0 * share - 1.0)

    def integral(self, t: float) -> float:
        """Return the integral of the factor from time 0 to t >= 0 (s)."""
        return self._area(t) - self._area(0.0)

    @property
    def last_change(self) -> float:
        """Time from which on the factor stays (s)."""
        return self.start + self.duration

    def _area(self, t: float) -> float:
        share = min(max((t - self.start) / self.duration, 0.0), 1.0)
        if self.shape == "half_sine":
            return self.duration * (1.0 - cos(pi * share)) / pi
        if self.shape == "square":
            return self.duration * share
        half = 1.0 - share
        return self.duration * (share**2 if share < 0.5 else 0.5 - half**2)


KINDS = {
    kind.model_fields["type"].default: kind for kind in (Constant, Step, Ramp, Table, Sine, Pulse)
}
WORDS = ("constant", "step")  # kinds that need no more than their name


def _long_form(data: Any) -> Any:
    """Turn the word `step` into {type: step}."""
    if not isinstance(data, str):
        return data
    if data in WORDS:
        return {"type": data}
    if data in KINDS:
        raise complaint(f"'{data}' needs more keys: write {{type: {data}, ...}}")
    raise complaint(unknown("curve", data, KINDS))


Curve = Annotated[one_of("type", *KINDS.values()), BeforeValidator(_long_form)]
