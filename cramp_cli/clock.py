"""When something is due in a run, and how long its paragraphs take."""

from collections import defaultdict
from contextlib import contextmanager
from time import perf_counter


class Due:
    """Says at which steps something happens that is wanted every so many seconds."""

    def __init__(self, every: float, dt: float):
        self.every, self.slack, self.count = every, 1e-9 * dt, 0

    def __call__(self, time: float) -> bool:
        """Return True at the first step at or after the next multiple of `every`."""
        if time < self.count * self.every - self.slack:
            return False
        self.count = int((time + self.slack) / self.every) + 1
        return True


class Stopwatch:
    """Times the paragraphs of a step."""

    def __init__(self):
        self.seconds = defaultdict(float)

    @contextmanager
    def __call__(self, title: str):
        """Add the time spent inside to the title."""
        begin = perf_counter()
        yield
        self.seconds[title] += perf_counter() - begin

    def table(self) -> str:
        """Return titles with seconds and shares, the way of a step from top to bottom."""
        total = sum(self.seconds.values()) or 1.0
        rows = (f"{t:50} {s:9.3f} s {100 * s / total:5.1f} %" for t, s in self.seconds.items())
        return "\n".join(rows)
