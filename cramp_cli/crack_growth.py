"""Cracks grow between steps, and the solid around their tips follows."""

from cramp_cli.cracks.fields import find_rows
from cramp_cli.cracks.grow import move_tips, plan_growth
from cramp_cli.cracks.release import (
    REACH,
    displacement_gradient,
    particles_around,
    take_strain,
)
from cramp_cli.transfer.sums import locate_particles


def let_cracks_grow(model, state, scratch) -> list[dict]:
    """Let all tips grow by what the step has loaded them to; return rows of growth.csv.

    The stencils must be those of the particles now: the sums before and after the tips have moved
    see the same places.
    """
    moves, rows = plan_growth(model, state, scratch)
    if not moves:
        return rows
    tips = [state.paths.point[move.tip.points[0]] for move in moves]
    around = particles_around(state.particles, tips, REACH * model.lattice.width)
    locate_particles(model, state, scratch)
    find_rows(model, state, scratch)
    before = displacement_gradient(model, state, scratch, around)
    rows += move_tips(model, state, scratch, moves)
    find_rows(model, state, scratch)
    change = displacement_gradient(model, state, scratch, around) - before
    state.books.fracture[0] -= take_strain(model, state, around, change)
    return rows
