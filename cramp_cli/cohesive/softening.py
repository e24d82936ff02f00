"""What all laws with a strength have in common: one damage for both modes.

The faces draw each other back with (1 - D) k_n times the opening and (1 - D) k_t times the sliding.
The damage D is the largest that the strength has asked for so far: on a straight way of opening d

    D(d) = 1 - strength(d) / (k d),

so a first opening follows the strength, and unloading goes straight to the origin. D never falls.
Its growth from D_1 to D_2 dissipates the integral of k d(D)^2/2 dD on the way of that moment, which
is never negative, and the whole toughness of that way from 0 to 1.
"""

from cramp_cli.cohesive.law import respond, stiffest, stored, strength, work
from cramp_cli.cohesive.modes import share_of_sliding, way_stiffness
from cramp_cli.numerics.kernel import kernel

HALVINGS = 80  # of the interval that holds the opening of a damage: to round-off


def softens(record):
    """Make a record a law that softens: one with `modes`, a strength and the work of it."""
    respond.implement(record)(soften)
    stored.implement(record)(store)
    stiffest.implement(record)(stiffer_mode)
    return record


def soften(law, normal, sliding, damage):
    """Return stresses, damage and energies dissipated: the answer of `respond` (law.py)."""
    k_n, k_t = law.modes.stiffness
    normal = max(normal, 0.0)
    opening = (normal * normal + sliding * sliding) ** 0.5
    share = share_of_sliding(law.modes, normal, sliding)
    grown, spent = damage, 0.0
    if opening > 0.0 and damage < 1.0:
        grown = max(damage_at(law, share, opening), damage)
        if grown > damage:
            before = opening_of(law, share, damage, opening)
            spent = max(dissipated(law, share, opening) - dissipated(law, share, before), 0.0)
    whole = 1.0 - grown
    return whole * k_n * normal, whole * k_t * sliding, grown, (1.0 - share) * spent, share * spent


def store(law, normal, sliding, damage):
    """Return the energy that comes back when the faces close: the answer of `stored` (law.py)."""
    k_n, k_t = law.modes.stiffness
    normal = max(normal, 0.0)
    return 0.5 * (1.0 - damage) * (k_n * normal * normal + k_t * sliding * sliding)


def stiffer_mode(law):
    """Return the larger stiffness of both modes: the answer of `stiffest` (law.py)."""
    return max(law.modes.stiffness)


@kernel
def damage_at(law, share, opening):
    """Return the damage after a first opening by a straight way; opening: above 0 (m)."""
    return 1.0 - strength(law, share, opening) / (way_stiffness(law.modes, share) * opening)


@kernel
def dissipated(law, share, opening):
    """Return the energy dissipated by a first opening by a straight way (J/m^2)."""
    return work(law, share, opening) - 0.5 * strength(law, share, opening) * opening


@kernel
def opening_of(law, share, damage, largest):
    """Return the opening of a first way (m) at which the damage is reached, by bisection.

    largest: an opening with more damage (m)
    """
    low, high = 0.0, largest
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if middle in (low, high):
            break
        if damage_at(law, share, middle) > damage:
            high = middle
        else:
            low = middle
    return low
