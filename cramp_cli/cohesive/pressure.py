"""A pressure in the crack that pushes its faces apart, however far they are open."""

from typing import NamedTuple

from cramp_cli.cohesive.law import respond, stiffest, stored


class Pressure(NamedTuple):
    """The pressure at a moment."""

    value: float  # Pa


@respond.implement(Pressure)
def _(law, normal, sliding, damage):
    return -law.value, 0.0, damage, 0.0, 0.0


@stored.implement(Pressure)
def _(law, normal, sliding, damage):
    return 0.0


@stiffest.implement(Pressure)
def _(law):
    return 0.0
