"""From the `contact` section of a deck to laws of cracks and bodies, and contact groups."""

import numpy as np

from cramp_cli.build.surface import outline_of
from cramp_cli.contact.laws import NORMALS, BodyContact, BodyLaws, RigidBody
from cramp_cli.contact.outline import Outlines, make_outlines
from cramp_cli.cracks.contact import LAWS, ContactLaws
from cramp_cli.deck.contact_groups import group_of_crack, groups_of_bodies, names_of_groups
from cramp_cli.state.groups import Groups


def build_crack_laws(deck) -> ContactLaws:
    """Return the law of every crack."""
    laws = [_numbers(deck.contact_of(crack))[:3] for crack in deck.cracks]
    kind, mu, mu_static = (np.array([law[n] for law in laws], dtype=float) for n in range(3))
    return ContactLaws(kind.astype(np.int64), mu, mu_static)


def _numbers(section) -> tuple[int, float, float, float, float]:
    """Return kind, mu, mu_static, strength and shear strength of a law of a deck."""
    mu, static = getattr(section, "mu", 0.0), getattr(section, "mu_static", None)
    pull, shear = getattr(section, "strength", 0.0), getattr(section, "shear_strength", None)
    return (
        LAWS[section.law],
        mu,
        mu if static is None else static,
        pull,
        pull if shear is None else shear,
    )


def build_groups(deck) -> Groups:
    """Return the contact group of every body and crack."""
    together = deck.contact.bodies is None
    cracks = [0 if together else group_of_crack(deck, crack) for crack in deck.cracks]
    of_body = np.array(groups_of_bodies(deck), dtype=np.int64)
    return Groups(of_body, np.array(cracks, dtype=np.int64))


def build_body_contact(deck, events, width) -> BodyContact | None:
    """Return how the bodies touch; None if they do not.

    events: EventList that grows by theirs; width: of a cell (m)
    """
    section = deck.contact
    if section.bodies is None:
        return None
    group = dict(zip((b.name for b in deck.bodies), groups_of_bodies(deck), strict=True))
    names = names_of_groups(deck)
    laws = np.empty((5, len(names), len(names)))
    laws[:] = np.array(_numbers(section.bodies))[:, None, None]
    for pair in section.pairs:
        a, b = (group[name] for name in pair.bodies)
        laws[:, a, b] = laws[:, b, a] = _numbers(pair.contact)
    rigid = tuple(
        RigidBody(
            group[b.name],
            n,
            np.array(b.rigid.velocity, dtype=float),
            events.signal(b.rigid, f"body {b.name}"),
        )
        for n, b in enumerate(deck.bodies)
        if b.rigid
    )
    tables = BodyLaws(laws[0].astype(np.int64), *(table.copy() for table in laws[1:]))
    outlines = build_outlines(deck, group, len(names), width)
    return BodyContact(tuple(names), tables, NORMALS[section.normal], outlines, rigid)


def build_outlines(deck, group, groups, width) -> Outlines:
    """Return the outlines of the rigid bodies.

    group: of every body, by name; groups: how many; width: of a cell (m)
    """
    from shapely import get_parts
    from shapely.geometry.polygon import orient

    rings = [[] for _ in range(groups)]
    for n, body in enumerate(deck.bodies):
        if body.rigid:
            for part in get_parts(outline_of(deck, n, width)):
                ends = orient(part)  # the body is at the left of its rings
                rings[group[body.name]] += [r.coords for r in (ends.exterior, *ends.interiors)]
    return make_outlines(rings)
