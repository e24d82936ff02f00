"""What becomes of particles that leave the grid: an error, taken away, or held at its border."""

import numpy as np

from cramp_cli.shapes.shape import first_node, support
from cramp_cli.state.failure import NumericalFailure
from cramp_cli.state.health import CAUSES, describe

ERROR, DELETE, CLAMP = "error", "delete", "clamp"
INWARDS = 1 / 16  # cells by which a particle is put back until the grid holds its nodes


def let_leave(model, state, scratch, p: int) -> None:
    """Take away or hold all particles that have left the grid, as the model says.

    What they do is told in `scratch.remarks`; the energy that they take along is booked as work
    done on the surroundings.

    p: one of those that left
    raises: NumericalFailure if particles may not leave, or particle `p` is nowhere
    """
    if model.leaving == ERROR or not _is_somewhere(state.particles, p):
        raise _failure(model, state, p)
    treat, words = {DELETE: (_delete, "is deleted"), CLAMP: (_hold, "is held at its border")}[
        model.leaving
    ]
    for block, bands in zip(model.blocks, state.bands, strict=True):
        for q in range(block.lo, bands[-1]):
            axes = _axes_left(model.lattice, block.shape, state.particles.position[q])
            if axes:
                text = f"{describe(model, state, q)} has left the grid and {words}"
                scratch.remarks.append(f"step {state.step}, t = {state.time:.6g} s: {text}")
                state.books.external[0] -= treat(model.lattice, state.particles, block, q, axes)


def _is_somewhere(particles, p: int) -> bool:
    """Return whether place and deformation of a particle are numbers."""
    return bool(np.isfinite(particles.position[p]).all() and np.isfinite(particles.F[p]).all())


def _axes_left(lattice, shape, position) -> list[int]:
    """Return the axes along which a particle sees nodes that the grid has not."""
    cells = (position - lattice.lower) / lattice.width
    return [d for d, x in enumerate(cells) if not _sees_nodes(lattice, shape, d, float(x))]


def _sees_nodes(lattice, shape, axis: int, x: float) -> bool:
    return 0 <= first_node(shape, axis, x) <= lattice.nodes[axis] - support(shape)


def _delete(lattice, particles, block, p: int, axes) -> float:
    """Make a particle nothing; return its energy (J).

    It stays in the arrays, behind the last band, so that the numbers of the others are what they
    were.
    """
    volume, mass, velocity = particles.volume[p], particles.mass[p], particles.velocity[p]
    energy = 0.5 * mass * (velocity @ velocity) + particles.work[p] * volume
    particles.mass[p] = particles.volume[p] = 0.0
    dim = len(velocity)
    particles.F[p] = np.eye(dim).ravel()
    for array in (velocity, particles.acceleration[p], particles.stress[p], particles.L[p]):
        array[:] = 0.0
    return float(energy)


def _hold(lattice, particles, block, p: int, axes) -> float:
    """Put a particle back to the border and stop it there; return the energy lost (J)."""
    energy = 0.0
    for d in axes:
        x = (particles.position[p, d] - lattice.lower[d]) / lattice.width
        inwards = INWARDS if x < 0.5 * lattice.cells[d] else -INWARDS
        x = float(np.clip(x, 0.0, lattice.cells[d]))
        while not _sees_nodes(lattice, block.shape, d, x):
            x += inwards
        particles.position[p, d] = lattice.lower[d] + x * lattice.width
        energy += 0.5 * particles.mass[p] * float(particles.velocity[p, d]) ** 2
        particles.velocity[p, d] = 0.0
    return energy


def _failure(model, state, p: int) -> NumericalFailure:
    """Return what to say of a particle that has no nodes."""
    text = f"step {state.step}, t = {state.time:.6g} s: {describe(model, state, p)}"
    if not _is_somewhere(state.particles, p):
        return NumericalFailure(f"{text} has a position or a shape that is no number.\n{CAUSES}")
    return NumericalFailure(
        f"{text} leaves the grid.\nMake the grid larger (grid.lower, grid.upper or grid.margin), "
        "look for what throws the body out, or let particles leave (solver.leaving)."
    )
