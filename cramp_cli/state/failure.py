"""The way a run says that its solution is no longer one."""


class NumericalFailure(Exception):
    """NaN, an inverted particle, a particle outside the grid: with step, place and likely cause."""
