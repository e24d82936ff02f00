"""What a deck says about damping and coming to rest, in numbers."""

from cramp_cli.deck.rest import last_change, may_rest
from cramp_cli.deck.run import AUTO
from cramp_cli.state.rest import Rest


def damping_of(solver) -> tuple[float, float]:
    """Return the drag on grid and particles (1/s); none where it is found while running."""
    if solver.damping == AUTO:
        return 0.0, 0.0
    return solver.damping.grid, solver.damping.particle


def rest_of(deck) -> Rest:
    """Return when a run of a deck is at rest."""
    return Rest(
        auto=deck.solver.damping == AUTO,
        watched=may_rest(deck.solver),
        stops=deck.solver.stop_when == "at_rest",
        loads_until=last_change(deck),
    )
