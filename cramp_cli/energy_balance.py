"""The energies of a run, and whether they balance (docs/theory/energy.md)."""

from copy import copy
from math import isfinite

from cramp_cli.cracks.cohesion import cohesive_energies, energy_of_pressures
from cramp_cli.state.failure import NumericalFailure
from cramp_cli.state.health import check_health
from cramp_cli.state.measures import momentum, sum_energies

SETTLED = 50  # steps with energy until the limits of the deck hold: before, they are wider
WILD = 0.5  # of the energy; more than this is never a matter of the first steps


class Balance:
    """Keeps the energy balance and judges it.

    solver: what the deck says about the solver, with the limits of the balance
    """

    REMEMBERED = ("start", "largest", "error", "warned", "begun")  # by a checkpoint

    def __init__(self, state, solver):
        self.limits, self.solver = solver.energy_error, solver
        self.start = sum(sum_energies(state.particles))
        self.largest = 0.0
        self.error = 0.0
        self.warned = False
        self.begun = 0  # the last step that was seen without energy

    def row(self, model, state) -> dict:
        """Return the energies of a row of history.csv and keep the balance."""
        kinetic, stored, plastic = sum_energies(state.particles)
        books = state.books
        damping, friction = float(books.damping[0]), float(books.friction[0])
        fracture, impact = float(books.fracture[0]), float(books.impact[0])
        absorbed, work = float(books.absorbed[0]), float(books.external[0])
        held, parting = cohesive_energies(model, state)
        taken = friction + max(impact, 0.0) + plastic + damping + absorbed + parting + fracture
        spent = kinetic + stored + held + taken
        of_load = energy_of_pressures(model, state)
        self.largest = max(self.largest, kinetic + stored + held, abs(work), taken, of_load)
        self.error = (spent - self.start - work) / self.largest if self.largest else 0.0
        self.begun = self.begun if self.largest else state.step
        if not isfinite(self.error):
            check_health(model, state)  # it knows which particle, where, and why
        total = momentum(state.particles)
        return {
            "step": state.step,
            "time": state.time,
            "dt": model.dt,
            "kinetic_energy": kinetic,
            "strain_energy": stored,
            "fracture_energy": fracture,
            "cohesive_stored": held,
            "cohesive_energy": parting,
            "friction_energy": friction,
            "impact_energy": impact,
            "plastic_energy": plastic,
            "damping_energy": damping,
            "absorbed_energy": absorbed,
            "external_work": work,
            "energy_error": self.error,
            "momentum_x": float(total[0]),
            "momentum_y": float(total[1]),
        }

    def glance(self, model, state) -> None:
        """Stop a solution that blows up between two rows; the balance stays what it was."""
        now = copy(self)
        now.row(model, state)
        if not abs(now.error) <= max(WILD, self.limits.stop):
            raise now.failure(state)

    def judge(self, state, reporter, *, at_end=False) -> None:
        """Warn once when the balance is off by more than the first limit, stop at the second.

        The first load meets a body at rest: what the first step books otherwise than the solid
        feels it stays, and its share falls while energy comes in. So the limit is that of the deck
        times SETTLED over the steps so far, but for gains and losses that no first step explains.
        at_end: of a run, which is judged however short it is
        """
        steps = max(state.step - self.begun, 1)
        start = 0.0 if at_end else min(WILD, self.limits.stop * SETTLED / steps)
        if not abs(self.error) <= max(self.limits.stop, start):
            raise self.failure(state)
        if (at_end or steps >= SETTLED) and abs(self.error) > self.limits.warn and not self.warned:
            self.warned = True
            reporter.message("warning", self._text(state))

    def failure(self, state) -> NumericalFailure:
        """Return what ends a run whose balance is off by too much."""
        return NumericalFailure(
            f"{self._text(state)} (solver.energy_error.stop: {self.limits.stop:g}).\n"
            f"{self._advice()}; look at energy_error in history.csv for when it began."
        )

    def _text(self, state) -> str:
        where = f"step {state.step}, t = {state.time:.6g} s"
        return f"{where}: the energy balance is off by {100 * self.error:.3g} %"

    def _advice(self) -> str:
        update, strain = self.solver.update, self.solver.strain
        if self.solver.may_be_unstable:
            better = strain.replace("-", "+")
            return (
                f"{update} with strain: {strain} may be unstable; use {better} or lower solver.cfl"
            )
        if update == "flip":
            return "Lower solver.cfl, use more particles per cell or a finer grid"
        known = f"What {update} filters from particles is in damping_energy and no part of this"
        return f"{known}.\nUse flip, a ramp instead of a step, or a finer grid"
