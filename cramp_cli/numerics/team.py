"""Threads that share the work of one kernel.

Kernels let go of the interpreter, so plain Python threads run them side by side; nothing is
compiled for it, and no thread outlives a fork. Who does which part never changes a result: parts
that run at the same time write to different places.
"""

from concurrent.futures import ThreadPoolExecutor

LEAST = 10_000  # particles worth a thread


class Team:
    """A number of threads, the caller's among them."""

    def __init__(self, threads: int, particles: int):
        self.size = max(1, min(threads, particles // LEAST))
        self._others = ThreadPoolExecutor(self.size - 1) if self.size > 1 else None

    def run(self, kernel, args, parts) -> None:
        """Call `kernel(*args, part)` for every part, all at the same time; return when all did."""
        if self._others is None:
            for part in parts:
                kernel(*args, part)
            return
        waiting = [self._others.submit(kernel, *args, part) for part in parts[1:]]
        kernel(*args, parts[0])
        for other in waiting:
            other.result()
