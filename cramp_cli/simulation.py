"""The loop over time: step, and whatever is due after it."""

from contextlib import contextmanager
from time import perf_counter

import numpy as np

from cramp_cli.boundary.events import new_events, past_events
from cramp_cli.clock import Due, Stopwatch
from cramp_cli.cracks.account import growth_of_ends, path_rows
from cramp_cli.cracks.cohesion import parted_points, tractions_now
from cramp_cli.cracks.fields import find_rows, list_cracks
from cramp_cli.cracks.grow import blind_tips, grow
from cramp_cli.cracks.straight_path import UNSTABLE, with_past
from cramp_cli.cracks.tip_mean import TipMeans
from cramp_cli.cracks.tips import sample_tips
from cramp_cli.energy_balance import Balance
from cramp_cli.numerics.call import records_of_one_run
from cramp_cli.output.summary import Summary
from cramp_cli.pace import keep_pace
from cramp_cli.scratch import make_scratch
from cramp_cli.settling import Settling
from cramp_cli.state.failure import NumericalFailure
from cramp_cli.state.health import check_health
from cramp_cli.state.measures import FIELDS
from cramp_cli.state.particles import is_deleted
from cramp_cli.step import step
from cramp_cli.transfer.sums import locate_particles

HEALTH_EVERY = 20  # steps
DUES = ("history_due", "tips_due", "frame_due", "balance_due")
JUDGED = 50  # times that the energy balance of a run is judged, at least
MOST_REMARKS = 20  # of single particles
COMPILING = 2.0  # s; a first step that takes longer has compiled kernels


def simulate(
    deck,
    model,
    state,
    outputs,
    reporter,
    *,
    threads=1,
    profile=False,
    keeper=None,
    remembered=None,
) -> Summary:
    """Run a model to its end and write what the deck asks for.

    outputs: where rows and frames go; reporter: who is told how it goes; threads: to share work
    keeper: writes checkpoints, may end the run by Stopped; remembered: what it kept of this loop
    when the state is that of a checkpoint
    returns: the outcome in a few numbers
    """
    begin, first = perf_counter(), 0.0  # the first step may compile: no measure of the others
    reporter.start(model.end_time, deck.title or "run", _facts(model, state))
    run = _Run(deck, model, state, outputs, reporter, threads, keeper)
    with run.dumped_if_it_fails(), records_of_one_run():
        if remembered:
            run.recall(remembered)
        else:
            run.after_step()
        while state.time < model.end_time - 1e-9 * model.dt and not run.settling.has_ended:
            run.model = keep_pace(model, state)
            step(run.model, state, run.scratch, run.watch)
            run.let_cracks_grow()
            run.let_events_happen()
            run.after_step()
            first = first or run.first_step_took(perf_counter() - begin)
            wall = perf_counter() - begin - first
            reporter.progress(state.step, state.time, wall, run.headline())
        if keeper:
            keeper.at_end(state, run.remember())
        run.last()
    wall = perf_counter() - begin
    if profile:
        reporter.message("info", run.watch.table())
    speed = run.steps_after_first() * len(state.particles.mass) / max(wall - first, 1e-9)
    found = (speed or None, tuple(growth_of_ends(model, state)), tuple(past_events(model, state)))
    rest = run.settling.outcome(model, run.tips)
    return Summary(state.step, state.time, wall, run.tips, run.balance.error, *found, rest)


class _Run:
    """What is due after a step."""

    def __init__(self, deck, model, state, outputs, reporter, threads, keeper):
        self.deck, self.model, self.state = deck, model, state
        self.outputs, self.reporter, self.keeper = outputs, reporter, keeper
        self.scratch, self.watch = make_scratch(model, state, threads), Stopwatch()
        self.balance, self.begun_at = Balance(state, deck.solver), state.step
        self.settling = Settling(model)
        self.history_due = Due(deck.output.history_every, model.dt)
        self.tips_due = Due(deck.fracture.every, model.dt)
        self.frame_due = Due(deck.output.every, model.dt)
        self.means = TipMeans(model) if model.fracture.means else None
        self.balance_due = Due(model.end_time / JUDGED, model.dt)
        self.tips, self.written, self.judged = [], set(), -1
        self.told, self.remarks_told = set(), 0
        list_cracks(model, state, self.scratch)
        locate_particles(model, state, self.scratch)
        find_rows(model, state, self.scratch)

    def let_cracks_grow(self) -> None:
        """Let the cracks grow by what the step has loaded them to, and tell of it."""
        if len(self.scratch.parted):
            self.outputs.growth(parted_points(self.model, self.state, self.scratch))
        if self.model.propagation is not None:
            with self.watch("10 cracks grow"):
                self.outputs.growth(grow(self.model, self.state, self.scratch))
            for name in blind_tips(self.model, self.state):
                text = f"no domain fits around the tip {name}: it has no load and can not grow"
                self._tell(f"blind {name}", text)

    def let_events_happen(self) -> None:
        """Hold or reverse the conditions whose event has come, and tell of it."""
        for text in new_events(self.model, self.state):
            where = f"step {self.state.step}, t = {self.state.time:.6g} s"
            self.reporter.message("info", f"{where}: {text}")

    def after_step(self) -> None:
        """Look after the solution and write what is due."""
        self._tell_remarks()
        if self.state.step % HEALTH_EVERY == 0:
            check_health(self.model, self.state)
            self.balance.glance(self.model, self.state)
            self._tell_strange_rows()
            self._tell_short_domains()
            self._tell_lost_faces()
        self.settling.look(self.model, self.state, self.scratch)
        if self.means:
            next_row = min(self.tips_due.next, self.model.end_time)
            self.means.after_step(self.model, self.state, self.scratch, next_row)
        self._write(self.history_due, self.tips_due, self.frame_due)
        if self.balance_due(self.state.time):
            self._judge_balance()
        if self.keeper:
            self.keeper.after_step(self.state, self.remember)

    @contextmanager
    def dumped_if_it_fails(self):
        """Write all that is known of a state that turned out to be none."""
        try:
            yield
        except NumericalFailure as failure:
            with np.errstate(all="ignore"):  # what is wrong may be anywhere in it
                position, fields = _points(self.state.particles, FIELDS)
            where = self.outputs.failure(self.state, position, fields)
            failure.add_note(f"the state is in {where}")
            raise

    def remember(self) -> dict:
        """Return what a checkpoint keeps of this loop: all that does not follow from the state."""
        check_health(self.model, self.state)  # a checkpoint of an ill state is of no use
        return {
            "balance": {name: getattr(self.balance, name) for name in Balance.REMEMBERED},
            "settling": {name: getattr(self.settling, name) for name in Settling.REMEMBERED},
            "due": {name: getattr(self, name).count for name in DUES},
            "tips": self.tips,
            "written": sorted(self.written),
            "told": sorted(self.told),
            "remarks_told": self.remarks_told,
            "means": self.means.samples if self.means else None,
        }

    def recall(self, remembered) -> None:
        """Go on from what `remember` gave."""
        vars(self.balance).update(remembered["balance"])
        vars(self.settling).update(remembered["settling"])
        for name, count in remembered["due"].items():
            getattr(self, name).count = count
        self.tips, self.told = remembered["tips"], set(remembered["told"])
        self.remarks_told = remembered["remarks_told"]
        self.written = {tuple(key) for key in remembered["written"]}
        if self.means:
            self.means.samples = remembered["means"]

    def first_step_took(self, seconds: float) -> float:
        """Say how long it took to begin, and time the steps anew from here."""
        long = seconds > COMPILING
        text = f"compiling kernels and the first step took {seconds:.1f} s"
        self.reporter.message("info" if long else "debug", text)
        self.watch.seconds.clear()
        return seconds

    def steps_after_first(self) -> int:
        """Return the number of steps taken after the first of this run."""
        return max(self.state.step - self.begun_at - 1, 0)

    def last(self) -> None:
        """Write the end of the run, and tell whether it has come to rest."""
        check_health(self.model, self.state)
        self._write(*(lambda time: True,) * 3)
        self.balance.judge(self.state, self.reporter, at_end=True)
        self.outputs.last_paths(path_rows(self.model, self.state))
        if self.model.rest.stops:
            level = "info" if self.settling.has_ended else "warning"
            self.reporter.message(level, self.settling.outcome(self.model, self.tips))

    def headline(self) -> dict:
        """Return the numbers worth a look while it runs."""
        if not self.tips:
            return {"energy_error": self.balance.error}
        return {name: self.tips[0][name] for name in ("J", "K_I", "K_II")}

    def _write(self, history_due, tips_due, frame_due) -> None:
        time = self.state.time
        if history_due(time) and self._first("history"):
            books = self.balance.row(self.model, self.state)
            self.outputs.history(books | self._reactions() | self._contact_forces())
            self.balance.judge(self.state, self.reporter)
            self.judged = self.state.step
        if self.model.crack_names and tips_due(time) and self._first("tips"):
            rows = sample_tips(self.model, self.state, self.scratch)
            if self.means:
                rows = self.means.of_rows(self.model, self.state, self.scratch, rows)
            self.tips = with_past(self.settling.with_words(self.model, rows), self.told)
            self._tell_unstable_ways()
            self.outputs.tips(self.tips)
        if frame_due(time) and self._first("frame"):
            self._frame()

    def _judge_balance(self) -> None:
        """Judge the energy balance between two rows of the history."""
        if self.judged < self.state.step:
            self.balance.row(self.model, self.state)
            self.balance.judge(self.state, self.reporter)
            self.judged = self.state.step

    def _first(self, what) -> bool:
        """Return True once per step."""
        key = (what, self.state.step)
        if key in self.written:
            return False
        self.written = {k for k in self.written if k[1] == self.state.step} | {key}
        return True

    def _reactions(self) -> dict:
        names = self.model.conditions.names
        return {
            f"reaction_{name}_{axis}": float(self.state.reactions[b, d])
            for b, name in enumerate(names)
            for d, axis in enumerate("xy")
        }

    def _contact_forces(self) -> dict:
        between = self.model.between_bodies
        return {
            f"contact_{name}_{axis}": float(self.state.contact_forces[g, d])
            for g, name in enumerate(between.names if between else ())
            for d, axis in enumerate("xy")
        }

    def _frame(self) -> None:
        state, output = self.state, self.deck.output
        if output.particles:
            position, fields = _points(state.particles, output.fields)
            self.outputs.particle_frame(state.step, state.time, position, fields)
        if self.model.crack_names:
            paths = state.paths
            lines = [paths.point[paths.crack(c)] for c in range(paths.crack_count)]
            fields = {"opening": paths.above - paths.below}
            if self.model.cohesion is not None:
                traction = tractions_now(self.model, state)
                fields |= {"traction": traction, "damage": paths.damage}
            self.outputs.crack_frame(state.step, state.time, lines, fields)

    def _tell_strange_rows(self) -> None:
        """Say once when pairs of particle and node could not be told apart by the cracks."""
        wrong, crowded = (int(n) for n in self.scratch.rows.count[2:4])
        if wrong:
            self._tell("wrong side", f"{wrong} particle-node pairs see a crack from its wrong side")
        if crowded:
            self._tell("crowded", f"{crowded} particle-node pairs cross more than two cracks")

    def _tell_short_domains(self) -> None:
        """Say once when particles of cpdi have become longer than their domains may be."""
        short = int(self.scratch.report[:, :, 3].sum())
        if short:
            text = f"{short} particles are longer than two cells: their domains are shortened"
            self._tell("short domains", text, "gaps may open; more particles_per_cell put it off")

    def _tell_lost_faces(self) -> None:
        """Say once when a boundary that has held a body holds none any more."""
        for grip in self.scratch.held or ():
            if grip.has_let_go(self.scratch.grid.mass):
                name = self.model.conditions.names[grip.hold.boundary]
                text = f"boundary '{name}' holds no particle any more"
                self._tell(f"lost {name}", text, "the body has torn, or left it: look at a frame")

    def _tell_unstable_ways(self) -> None:
        """Say once of each tip when its way hangs on what is smaller than a cell."""
        for row in self.tips:
            name = f"{row['crack']} {row['tip']}"
            if UNSTABLE in row["status"]:
                text = f"the way of {name} is unstable: where it goes from here tells nothing"
                self._tell(f"{UNSTABLE} {name}", text, "see docs/theory/growth.md, Overloads")

    def _tell_remarks(self) -> None:
        """Pass on what the step has to say, but not without end."""
        remarks, told = self.scratch.remarks, self.remarks_told
        for text in remarks[: max(MOST_REMARKS - told, 0)]:
            self.reporter.message("warning", text)
        self.remarks_told += len(remarks)
        if told < MOST_REMARKS <= self.remarks_told:
            self.reporter.message("warning", "there are more of these; they are not told")
        remarks.clear()

    def _tell(self, what, text, advice="a finer grid near the cracks would help") -> None:
        if what not in self.told:
            self.told.add(what)
            self.reporter.message("warning", f"step {self.state.step}: {text}; {advice}")


def _points(particles, names) -> tuple:
    """Return positions and named fields of all particles, in the order of their numbers."""
    order = np.argsort(particles.id)
    order = order[~is_deleted(particles)[order]]
    fields = {name: FIELDS[name](particles)[order] for name in names}
    return particles.position[order], fields | {"body": particles.body[order]}


def _facts(model, state) -> dict:
    """Return what a user may want to check before the run."""
    return {
        "cells": " x ".join(str(n) for n in model.lattice.cells)
        + f" of {model.lattice.width:.4g} m",
        "particles": len(state.particles.mass),
        "cracks": f"{state.paths.crack_count} with {len(state.paths.point)} points",
        "time step": f"{model.dt:.6g} s, {int(np.ceil(model.end_time / model.dt))} steps",
    }
