"""From a deck to numbers: model, state, and what a run of them will take."""

from cramp_cli.build.estimate import estimate
from cramp_cli.build.filled import filled
from cramp_cli.build.model import build

__all__ = ["build", "estimate", "filled"]
