"""Can the numbers of a run be trusted? Each question with its answer."""

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

from cramp_cli.output.look import describe
from cramp_cli.output.tables import number
from cramp_cli.study.results import Columns, by_tip, read_table

REST_WANTED = "end_time is the limit"  # of a run that should have ended at rest
SETTLED = 50  # steps; as a run judges its energy balance
CLOSE = 0.05  # of J: domain and contour, or domains of several radii, differ by less


class Verdict(NamedTuple):
    """One question and its answer."""

    mark: str  # good, look or bad
    question: str
    answer: str


def judge(run: Path, limits) -> list[Verdict]:
    """Return all verdicts about a run.

    limits: what the deck says about the energy balance, with `warn` and `stop`
    """
    tips = by_tip(read_table(run / "cracks.csv"))
    return [
        *_of_run(describe(run)),
        *_of_energy(read_table(run / "history.csv"), limits),
        *_of_rest(describe(run)["manifest"]),
        *(verdict for tip, rows in tips.items() for verdict in _of_tip(tip, rows)),
        *_of_log(run / "run.log"),
    ]


def _of_run(found: dict) -> Iterator[Verdict]:
    manifest = found["manifest"]
    status, question = manifest["status"], "Did it come to its end?"
    if status == "done":
        yield Verdict("good", question, "yes")
    elif status == "running":
        yield Verdict("look", question, "not yet, or it was killed")
    else:
        yield Verdict("bad", question, f"{status}: {manifest['error']}")


def _of_energy(table: Columns, limits) -> Iterator[Verdict]:
    if not table:
        return
    error = np.abs(table["energy_error"][table["step"] >= SETTLED])
    worst = 100.0 * float(error.max(initial=0.0))
    mark = "good" if worst <= 100.0 * limits.warn else "bad"
    least = f"after {SETTLED} steps; the limit is {100.0 * limits.warn:g} %"
    yield Verdict(mark, "Is energy conserved?", f"within {number(worst)} % {least}")


def _of_rest(manifest: dict) -> Iterator[Verdict]:
    """A run with damping is at rest, is not and should, or need not be."""
    text = manifest.get("summary", {}).get("rest", "")
    if text:
        wanted = REST_WANTED in text
        mark = "bad" if wanted else "look" if text.startswith("not") else "good"
        yield Verdict(mark, "Has it come to rest?", text)


def _of_tip(tip: str, rows: Columns) -> Iterator[Verdict]:
    status, count = rows["status"], len(rows["status"])
    good = int(np.sum(status == "ok"))
    mark = "good" if status[-1] == "ok" else "look"
    text = f"{good} of {count} samples are ok; the last one is: {status[-1]}"
    yield Verdict(mark, f"{tip}: may J and K be trusted?", text)
    domain, contour, spread = (float(rows[n][-1]) for n in ("J", "J_contour", "J_spread"))
    if np.isfinite([domain, contour]).all() and domain:
        apart = abs(contour / domain - 1.0)
        mark = "good" if apart < CLOSE else "look"
        text = f"domain {number(domain)} J/m², contour {number(contour)} J/m²: {100 * apart:.2g} %"
        yield Verdict(mark, f"{tip}: do two integrals agree?", text)
    if np.isfinite(spread):
        mark = "good" if spread < CLOSE else "look"
        text = f"J of several radii differs by {100 * spread:.2g} %, which is no bound of its error"
        yield Verdict(mark, f"{tip}: does J depend on the domain?", text)


def _of_log(path: Path) -> Iterator[Verdict]:
    if not path.exists():
        return
    lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
    for line in lines:
        words = line.split(maxsplit=2)
        if len(words) == 3 and words[1] == "warning":
            yield Verdict("look", "Warning", words[2])
