"""What numba need not load before the first kernel runs."""

import sys
from functools import cache

BLAS = "scipy.linalg.cython_blas"


@cache
def leave_out_blas() -> None:
    """Let numba load its functions of arrays without looking for BLAS.

    It would import all of scipy.linalg, a sixth of the start of a run, to know whether it may
    multiply matrices with it; kernels multiply none. Numba looks again for one that does.
    """
    if BLAS in sys.modules:
        return
    sys.modules[BLAS] = None  # to import it fails, without a look at scipy
    try:
        import numba.np.arraymath  # noqa: F401
    finally:
        del sys.modules[BLAS]
