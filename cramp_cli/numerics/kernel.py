"""The decorators of compiled loops.

Division by zero gives inf (found by the health check of a run) instead of an exception in the
middle of a loop; sums are never reordered, so the same deck gives the same bits. Kernels let go of
the interpreter, so that several threads may run them side by side.

Kernels allocate nothing, and numba is told so (`_nrt`): it then does not count references, which
cost ten times the arithmetic wherever a helper is handed an array. One that does allocate does not
compile.
"""

from functools import partial

import numba

from cramp_cli.numerics.call import Kernel
from cramp_cli.numerics.kernel_cache import keep_kernels_by_what_they_are_made_of

keep_kernels_by_what_they_are_made_of()
numba.config.SLP_VECTORIZE = 1  # x and y side by side in one register: a step is 6 % faster

OPTIONS = {"cache": True, "error_model": "numpy", "nogil": True, "_nrt": False}


def _decorator(**options):
    plain = numba.config.DISABLE_JIT  # then njit hands back the function itself
    return partial(numba.njit if plain else Kernel, **OPTIONS, **options)


kernel = _decorator()

# Short helpers of a loop that are handed many arrays: as calls they would pass hundreds of numbers.
inlined_kernel = _decorator(forceinline=True)

# Loops over all particles: a product and a sum may become one fused operation, rounded once, and
# x + 0 is x. Geometry must not: whether a point lies on a crack is decided by differences of equal
# products.
particle_kernel = _decorator(fastmath={"contract", "nsz"})
