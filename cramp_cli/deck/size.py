"""How large the model of a deck is, told without building it and at once."""

from math import prod
from typing import NamedTuple

# bytes of a particle: vectors, tensors, numbers, and its stencil
STATE_BYTES = 16 * 8 + 12 * 8 + 13 * 8
ROW_BYTES = 14 * 8  # of a grid node


class Size(NamedTuple):
    """The size of a model."""

    cells: tuple[int, ...]  # along each axis
    particles: float
    memory_bytes: int


def size_of(deck) -> Size:
    """Return how many cells and particles a deck has, and the memory they take (bytes)."""
    box, width = deck.lattice_box(), deck.grid.cell
    nodes = prod(cells + 1 for cells in box.cells)
    particles = sum(
        body.shape.outline().area * body.particles_per_cell**2 / width**2
        for body in deck.bodies
        if not body.hole
    )
    return Size(box.cells, particles, int(particles * STATE_BYTES + nodes * ROW_BYTES))
