"""When something is due in a run, and how long its paragraphs take."""

from collections import defaultdict
from time import perf_counter


class Due:
    """Says at which steps something happens that is wanted every so many seconds."""

    def __init__(self, every: float, dt: float):
        self.every, self.slack, self.count = every, 1e-9 * dt, 0

    @property
    def next(self) -> float:
        """The next multiple of `every` (s)."""
        return self.count * self.every

    def __call__(self, time: float) -> bool:
        """Return True at the first step at or after the next multiple of `every`."""
        if time < self.count * self.every - self.slack:
            return False
        self.count = int((time + self.slack) / self.every) + 1
        return True


class Stopwatch:
    """Times the paragraphs of a step, one after the other."""

    def __init__(self):
        self.seconds = defaultdict(float)
        self._title, self._begin = "", 0.0

    def __call__(self, title: str) -> "Stopwatch":
        """Return a context that adds the time spent inside to the title."""
        self._title = title
        return self

    def __enter__(self):
        self._begin = perf_counter()

    def __exit__(self, *_):
        self.seconds[self._title] += perf_counter() - self._begin

    def table(self) -> str:
        """Return titles with seconds and shares, the way of a step from top to bottom."""
        total = sum(self.seconds.values()) or 1.0
        rows = (f"{t:50} {s:9.3f} s {100 * s / total:5.1f} %" for t, s in self.seconds.items())
        return "\n".join(rows)
