"""How long a step may be while things move fast.

The time step of a model is that of its waves and its stiffest faces. A particle, a rigid body or a
held boundary that is faster than waves would jump over nodes, and over what it should touch. So
while anything would move farther than a quarter of a cell, steps are halved as often as it takes:
a function of the state alone, the same after a resume and for any number of threads.
"""

from dataclasses import replace
from math import ceil, inf, log2, sqrt

import numpy as np

from cramp_cli.state.failure import NumericalFailure
from cramp_cli.state.health import check_health
from cramp_cli.state.measures import fastest

FARTHEST = 0.25  # cells that anything moves in a step
MOST_HALVINGS = 10  # some 500 times the speed of waves; no solid bears that


def keep_pace(model, state):
    """Return the model with the time step of this moment; raise NumericalFailure without one."""
    speed = largest_speed(model, state)
    cells = speed * model.dt / model.lattice.width
    if cells <= FARTHEST:
        return model
    halvings = ceil(log2(cells / FARTHEST)) if cells < inf else inf
    if not halvings <= MOST_HALVINGS:
        check_health(model, state)  # it knows which particle, where, and why
        waves = f"{cells:.3g} cells in a step of the waves"
        raise NumericalFailure(
            f"step {state.step}, t = {state.time:.6g} s: something moves at {speed:.4g} m/s, "
            f"{waves}.\nEither the solution has blown up (lower solver.cfl), or a velocity of the "
            "deck is far above the speed of waves in its materials."
        )
    return replace(model, dt=model.dt / 2**halvings)


def largest_speed(model, state) -> float:
    """Return the speed of the fastest particle, rigid body or held boundary (m/s)."""
    between, dim = model.between_bodies, len(model.strides)
    speeds = [sqrt(fastest(state.particles.velocity))]
    if between is not None:
        speeds += np.hypot.reduce(between.rigid_velocities(state, dim), axis=1).tolist()
    for hold in model.conditions.holds:
        speeds.append(abs(hold.value * hold.signal.speed(state)))
    return max(speeds)
