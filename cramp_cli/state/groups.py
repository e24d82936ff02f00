"""Contact groups: bodies of one group share their rows and move as one solid, others may touch."""

from typing import NamedTuple

import numpy as np


class Groups(NamedTuple):
    """The contact group of everything; all zero in a model without contact between bodies."""

    of_body: np.ndarray  # (bodies,)
    of_crack: np.ndarray  # (cracks,) of the bodies that a crack cuts: others do not see it
