"""The one decorator of compiled loops.

Division by zero gives inf (found by the health check of a run) instead of an exception in the
middle of a loop; sums are never reordered, so the same deck gives the same bits.
"""

import numba

from cramp_cli.numerics.cache import cache_folder

numba.config.CACHE_DIR = str(cache_folder())

kernel = numba.njit(cache=True, error_model="numpy", nogil=True)
