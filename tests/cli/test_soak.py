"""The promises of docs/reliability.md under faults by the hundred: `make soak`.

Each test prints the figures it has reached; docs/reliability.md tells them.
"""

import csv
import json
import os
import random
import time
import xml.etree.ElementTree as ElementTree

import pytest
from fuzz import generated, mutated
from plate import GROWING
from promises import begin, cramp, differences, run_in_pieces
from runs import INPUTS

from cramp_cli.output.fields import read_frames

pytestmark = pytest.mark.soak

DECKS = sorted(path for path in INPUTS.glob("*.yaml") if "." not in path.stem)
SEED = int(os.environ.get("CRAMP_SOAK_SEED", "1"))
KILLS, MUTATED, GENERATED = 30, 500, 1000
# frames and checkpoints so often that many kills fall into the writing of files
SETTINGS = ("-s", "solver.end_time=100 us", "-s", "output.every=1 us")
HOW = ("--checkpoint-every", 25, "--resume", "auto")


@pytest.mark.parametrize("deck", DECKS, ids=lambda deck: deck.stem)
def test_1_a_whole_deck_in_pieces_is_the_same_to_the_byte(tmp_path, deck):
    """To its end, with all the growth that it has, stopped three times."""
    whole = run_in_pieces(deck, tmp_path / "whole", checkpoint_every=(50, None))
    with (whole / "history.csv").open(newline="") as file:
        steps = int(list(csv.DictReader(file))[-1]["step"])
    stops = sorted(random.Random(SEED).sample(range(1, steps), 3))
    pieces = run_in_pieces(deck, tmp_path / "pieces", stops, checkpoint_every=(50, None))
    assert differences(whole, pieces) == []
    print(f"\n{deck.stem}: {steps} steps, stopped after {stops}: the same")


def test_2_thirty_kills_at_random_moments_lose_nothing(here):
    """kill -9 while a crack grows, other numbers of threads; the end is that of a whole run."""
    dice, kills, runs, ends = random.Random(SEED), 0, 0, []
    (here / "growing.yaml").write_text(GROWING, encoding="utf-8")
    assert cramp("run", "growing.yaml", "-o", "whole.run", *SETTINGS, *HOW).returncode == 0
    while kills < KILLS:
        runs += 1
        run = here / f"{runs}.run"
        words = ("run", "growing.yaml", "-o", run, *SETTINGS, *HOW)
        for _ in range(3):
            with begin(*words, "-t", dice.choice((1, 2, 4))) as process:
                time.sleep(dice.uniform(0.5, 6.0))  # a run takes some 5 s
                alive = process.poll() is None
                process.kill()
            kills += alive
            ends.append(look_at(run))
        done = cramp(*words)
        assert done.returncode == 0, done.stderr
        assert differences(here / "whole.run", run) == []
    print(f"\n{kills} kills in {runs} runs after steps {sorted(ends)}: 0 lost")


def look_at(run):
    """Open every file of a run that was killed; return its last step."""
    step = -1
    for path in run.glob("*") if run.exists() else ():
        if path.suffix == ".csv":
            with path.open(newline="") as file:
                rows = list(csv.DictReader(file))
            step = int(rows[-1]["step"]) if rows and path.stem == "history" else step
        elif path.suffix == ".h5":
            assert all(len(frame.points) for frame in read_frames(path))
        elif path.suffix == ".xdmf":
            ElementTree.parse(path)
        elif path.suffix == ".json":
            json.loads(path.read_text())
    return step


def test_6_strange_decks_end_with_a_known_code(cramp_here):
    """Each in 10 s at most: `check` builds models of up to a million particles."""
    texts, codes, slowest = [deck.read_text() for deck in DECKS], {}, 0.0
    for number in range(MUTATED + GENERATED):
        text, seed = texts[number % len(texts)], SEED * 10_000 + number
        data = mutated(text, seed) if number < MUTATED else generated(text, seed)
        begun = time.monotonic()
        code, told = cramp_here(data)
        slowest = max(slowest, time.monotonic() - begun)
        assert code in (0, 3, 4, 5), f"seed {seed}: {told}"
        assert "Traceback" not in told, f"seed {seed}"
        codes[code] = codes.get(code, 0) + 1
    assert slowest < 10.0
    print(f"\n{sum(codes.values())} decks by exit code {codes}, the slowest {slowest:.1f} s")
