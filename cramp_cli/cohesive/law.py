"""What a traction law answers.

A law speaks of one place of a crack: the opening of its faces normal to the crack and their sliding
along it (m), the stresses with which they draw each other back (Pa), and the damage that the place
has suffered: 0 whole, 1 parted. Closed faces press by contact (cracks/contact.py), not by a law.
"""

from cramp_cli.numerics.dispatch import generic


@generic
def respond(law, normal, sliding, damage):
    """Return what the faces do to each other at an opening and a sliding (m).

    damage: of the place so far
    returns: normal and shear stress that draw the faces back (Pa), damage from now on, energy that
    this has dissipated in opening and in sliding (J/m^2)
    """


@generic
def stored(law, normal, sliding, damage):
    """Return the energy that the faces would give back if they closed (J/m^2)."""


@generic
def strength(law, share, opening):
    """Return the stress of a law without damage before, on a straight way of opening (Pa).

    The way is told by the share of sliding in the energy; stress and opening are the lengths of
    their vectors, so that stress times step of opening is work (modes.py).

    share: 0 opening alone, 1 sliding alone; opening: length of the vector of opening (m)
    """


@generic
def work(law, share, opening):
    """Return the area under the strength up to an opening (J/m^2)."""


@generic
def stiffest(law):
    """Return the largest stiffness that faces can have (Pa/m); it limits the time step."""
