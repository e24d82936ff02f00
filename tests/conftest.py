"""How property tests draw their examples: the same ones in every run, and without a stopwatch.

`HYPOTHESIS_PROFILE=search pytest tests/unit` draws new ones, ten times as many.
"""

import os

from hypothesis import settings

settings.register_profile("same", derandomize=True, deadline=None, database=None)
settings.register_profile("search", deadline=None, max_examples=1000, database=None)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "same"))
