"""Contact groups of a deck: which bodies touch, which stay one solid, and what is wrong with them.

All functions want a deck whose sections are right by themselves.
"""

from collections import Counter
from collections.abc import Iterator
from typing import Any

from cramp_cli.schema.section import Wrong, unknown

SAMPLES = 200  # places along a crack that tell which bodies it cuts


def groups_of_bodies(deck: Any) -> list[int]:
    """Return the contact group of every body; they count up in the order of the deck.

    Without contact between bodies all are in one group; a hole stands in group 0.
    """
    if deck.contact.bodies is None:
        return [0] * len(deck.bodies)
    first = {name: group[0] for group in deck.contact.groups for name in group}
    leaders = [first.get(body.name, body.name) for body in deck.bodies]
    order = list(dict.fromkeys(x for x, b in zip(leaders, deck.bodies, strict=True) if not b.hole))
    return [
        0 if body.hole else order.index(leader)
        for leader, body in zip(leaders, deck.bodies, strict=True)
    ]


def names_of_groups(deck: Any) -> list[str]:
    """Return for each contact group the name of its first body."""
    names: dict[int, str] = {}
    for group, body in zip(groups_of_bodies(deck), deck.bodies, strict=True):
        if not body.hole:
            names.setdefault(group, body.name)
    return [names[group] for group in sorted(names)]


def group_of_crack(deck: Any, crack: Any) -> int:
    """Return the contact group of the bodies in which most of a crack lies."""
    found = _groups_along(deck, crack)
    return found.most_common(1)[0][0] if found else 0


def _groups_along(deck: Any, crack: Any) -> Counter:
    """Return how many places of a crack lie in each contact group."""
    import numpy as np

    points, groups = crack.path(crack.length / SAMPLES), groups_of_bodies(deck)
    middles = 0.5 * (points[:-1] + points[1:])
    owner = np.full(len(middles), -1)
    for number, body in enumerate(deck.bodies):
        owner[body.shape.contains(middles)] = -1 if body.hole or body.rigid else number
    return Counter(groups[number] for number in owner.tolist() if number >= 0)


def contact_mistakes(deck: Any) -> Iterator[Wrong]:
    """Yield names that lead nowhere, and bodies and cracks that can not touch as the deck says."""
    yield from _rigid_mistakes(deck)
    if deck.contact.bodies is None:
        return
    solid = [body.name for body in deck.bodies if not body.hole]
    rigid = {body.name for body in deck.bodies if body.rigid}
    yield from _group_mistakes(deck.contact.groups, solid, rigid)
    yield from _pair_mistakes(deck, solid)
    for place, crack in enumerate(deck.cracks):
        found = _groups_along(deck, crack)
        if len(found) > 1:
            names = " and ".join(names_of_groups(deck)[g] for g in sorted(found))
            message = f"runs through {names}, which touch as two bodies: give each its own crack"
            yield ("cracks", place), message


def _rigid_mistakes(deck: Any) -> Iterator[Wrong]:
    rigid = {body.name: place for place, body in enumerate(deck.bodies) if body.rigid}
    for place in rigid.values():
        if deck.contact.bodies is None:
            message = "acts by contact only; give contact: {bodies: {law: frictional}}"
            yield ("bodies", place, "rigid"), message
    if rigid and len(rigid) == sum(not body.hole for body in deck.bodies):
        yield ("bodies",), "are all rigid: nothing is left to simulate"
    for place, load in enumerate(deck.loads):
        if getattr(load, "body", None) in rigid:
            message = f"'{load.body}' is rigid: only its velocity moves it"
            yield ("loads", place, "body"), message


def _group_mistakes(groups, solid, rigid) -> Iterator[Wrong]:
    taken: set[str] = set()
    for place, group in enumerate(groups):
        for at, name in enumerate(group):
            path = ("contact", "groups", place, at)
            if name not in solid:
                yield path, unknown("body", name, solid)
            elif name in rigid:
                yield path, f"'{name}' is rigid: it moves by itself and belongs to no group"
            elif name in taken:
                yield path, f"'{name}' is in a group already"
            taken.add(name)


def _pair_mistakes(deck: Any, solid) -> Iterator[Wrong]:
    names, numbers = [body.name for body in deck.bodies], groups_of_bodies(deck)
    taken: set[frozenset] = set()
    for place, pair in enumerate(deck.contact.pairs):
        path = ("contact", "pairs", place, "bodies")
        strange = [(at, name) for at, name in enumerate(pair.bodies) if name not in solid]
        for at, name in strange:
            yield (*path, at), unknown("body", name, solid)
        if strange:
            continue
        groups = frozenset(numbers[names.index(name)] for name in pair.bodies)
        if len(groups) == 1:
            yield path, "are one solid: they are the same body or in one of contact.groups"
        elif groups in taken:
            yield path, "have a law already, by themselves or by their groups"
        taken.add(groups)
