"""Linear elastic faces: a thin layer of glue that never fails."""

from typing import NamedTuple

from cramp_cli.cohesive.law import strength, work
from cramp_cli.cohesive.modes import Modes, way_stiffness
from cramp_cli.cohesive.softening import softens


@softens
class Elastic(NamedTuple):
    """Faces that draw back in proportion to their opening."""

    modes: Modes  # peak and toughness are infinite


@strength.implement(Elastic)
def _(law, share, opening):
    return way_stiffness(law.modes, share) * opening


@work.implement(Elastic)
def _(law, share, opening):
    return 0.5 * way_stiffness(law.modes, share) * opening * opening
