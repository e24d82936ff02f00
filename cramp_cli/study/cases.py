"""The cases of a study: each a set of changes to the base deck, named by what it computes."""

import hashlib
import json
from collections.abc import Iterator
from itertools import product
from math import prod
from typing import Any, NamedTuple

from cramp_cli.deck.deck import DeckError, read_deck, to_yaml
from cramp_cli.deck.sweep import MOST_CASES, Study

DIGITS = 10  # of a case's name


class Case(NamedTuple):
    """One run of a study."""

    name: str  # digest of its whole deck: the same deck is never run twice
    parameters: dict[str, Any]  # what varies: path of keys and value
    settings: tuple[str, ...]  # words after -s, those for all cases first

    def __str__(self) -> str:
        """Return what varies, for people."""
        return ", ".join(f"{path}={shown(value)}" for path, value in self.parameters.items())


def shown(value: Any) -> str:
    """Return a value of a deck as text: words as they are, all else as JSON."""
    return value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)


def expand(study: Study) -> list[Case]:
    """Return all cases of a study in order, equal ones once.

    Raises DeckError with the mistakes of all their decks.
    """
    refuse_too_many(study)
    found, mistakes = {}, []
    for parameters in _combinations(study):
        changes = study.settings | parameters
        settings = tuple(f"{path}={json.dumps(value)}" for path, value in changes.items())
        try:
            deck = read_deck(study.deck_path, settings)
        except DeckError as error:
            mistakes += error.mistakes
            continue
        text = to_yaml(deck.resolved())
        name = hashlib.sha256(text.encode()).hexdigest()[:DIGITS]
        found.setdefault(name, Case(name, parameters, settings))
    if mistakes:
        raise DeckError(mistakes)
    return list(found.values())


def refuse_too_many(study: Study) -> None:
    """Raise DeckError if a study has more combinations than anybody runs, without making them."""
    total = prod(_count(entry) for entry in study.vary)
    if total > MOST_CASES:
        message = f"makes {total} cases; at most {MOST_CASES} are possible"
        raise DeckError([study.mistake(("vary",), message)])


def _count(entry) -> int:
    """Return how many variants an entry of `vary` has."""
    if entry.type == "list":
        return len(entry.cases)
    if entry.type == "grid":
        return prod(map(len, entry.over.values()))
    if entry.type == "zip":
        return min(map(len, entry.over.values()))
    return entry.samples


def _combinations(study: Study) -> Iterator[dict[str, Any]]:
    """Yield the changes of every case: entries of `vary` are combined with each other."""
    for parts in product(*(list(_variants(entry)) for entry in study.vary)):
        yield {path: value for part in parts for path, value in part.items()}


def _variants(entry) -> Iterator[dict[str, Any]]:
    if entry.type == "list":
        yield from entry.cases
    elif entry.type == "grid":
        yield from (
            dict(zip(entry.over, row, strict=True)) for row in product(*entry.over.values())
        )
    elif entry.type == "zip":
        columns = zip(*entry.over.values(), strict=True)
        yield from (dict(zip(entry.over, row, strict=True)) for row in columns)
    else:
        ranges = entry.over.values()
        for shares in _samples(entry):
            values = (r.value(float(s)) for r, s in zip(ranges, shares, strict=True))
            yield dict(zip(entry.over, values, strict=True))


def _named(paths, rows) -> Iterator[dict[str, Any]]:
    yield from (dict(zip(paths, row, strict=True)) for row in rows)


def _samples(entry):
    """Return shares (samples, paths) between 0 and 1, the same for the same seed."""
    from numpy.random import default_rng
    from scipy.stats import qmc

    kinds = {"latin_hypercube": qmc.LatinHypercube, "sobol": qmc.Sobol}
    sampler = kinds[entry.type](len(entry.over), seed=default_rng(entry.seed))
    return sampler.random(entry.samples)
