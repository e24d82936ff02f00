"""From the `contact` section of a deck to laws of cracks and bodies, and contact groups."""

import numpy as np

from cramp_cli.build.surface import outline_of, outline_of_all, rings_of, surface_beside
from cramp_cli.contact.laws import NORMALS, BodyContact, BodyLaws, RigidBody
from cramp_cli.contact.outline import Outlines, make_outlines
from cramp_cli.contact.surface import Surface
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


def build_body_contact(deck, events, particles, width) -> BodyContact | None:
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
    surface = build_surface(deck, particles, width)
    return BodyContact(tuple(names), tables, NORMALS[section.normal], outlines, surface, rigid)


def build_outlines(deck, group, groups, width) -> Outlines:
    """Return the outlines of the rigid bodies.

    group: of every body, by name; groups: how many; width: of a cell (m)
    """
    rings = [[] for _ in range(groups)]
    for n, body in enumerate(deck.bodies):
        if body.rigid:
            rings[group[body.name]] += rings_of(outline_of(deck, n, width))
    return make_outlines(rings)


def build_surface(deck, particles, width) -> Surface:
    """Return the surface of the elastic bodies where their particles are next to it.

    particles: of all bodies, at the start; width: of a cell (m)
    """
    foot, normal = np.zeros((2, *particles.position.shape))
    if any(body.rigid for body in deck.bodies):
        groups = groups_of_bodies(deck)
        for n, body in enumerate(deck.bodies):
            mine = particles.body == n
            if body.rigid is None and mine.any():
                alike = [k for k, group in enumerate(groups) if group == groups[n]]
                outline, number = outline_of_all(deck, alike, width), particles.id[mine]
                side = width / body.particles_per_cell
                near = surface_beside(particles.position[mine], outline, side)
                foot[number], normal[number] = near
    return Surface(foot, normal)
