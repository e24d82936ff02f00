"""Is the solution still one? Looked at every few steps."""

import numpy as np

from cramp_cli.numerics.kernel import kernel
from cramp_cli.numerics.matrix import determinant, matrix, zero_matrix
from cramp_cli.state.failure import NumericalFailure

WELL, NOT_A_NUMBER, INVERTED = 0, 1, 2
CAUSES = (
    "Likely causes: the time step (lower solver.cfl), a load too large for the material, or "
    "particles pressed together more than they can bear."
)


@kernel
def first_ill(particles, strides):
    """Return the first particle whose state is no number or turned inside out, and which it is."""
    x, v, F, stress = particles.position, particles.velocity, particles.F, particles.stress
    like = zero_matrix(strides)
    for p in range(len(particles.mass)):
        total = 0.0
        for d in range(len(strides)):
            total += x[p, d] + v[p, d]
        for c in range(stress.shape[1]):
            total += 0.0 * stress[p, c]
        if not np.isfinite(total):
            return p, NOT_A_NUMBER
        if determinant(matrix(like, F, p)) <= 0.0:
            return p, INVERTED
    return -1, WELL


def check_health(model, state) -> None:
    """Raise NumericalFailure if a particle is ill."""
    p, what = first_ill(state.particles, model.strides)
    if what == WELL:
        return
    words = {
        NOT_A_NUMBER: "has a state that is no number",
        INVERTED: "is turned inside out (det F <= 0)",
    }
    raise NumericalFailure(
        f"step {state.step}, t = {state.time:.6g} s: {describe(model, state, p)} {words[what]}.\n"
        f"{CAUSES}"
    )


def describe(model, state, p: int) -> str:
    """Return a particle as text: number, material, place at the start and now."""
    particles = state.particles
    material = next(b.material for b in model.blocks if b.lo <= p < b.hi)
    now = ", ".join(f"{c:.6g}" for c in particles.position[p])
    before = ", ".join(f"{c:.6g}" for c in particles.origin[p])
    return f"particle {particles.id[p]} of {material} at ({now}) m, at first at ({before}) m,"
