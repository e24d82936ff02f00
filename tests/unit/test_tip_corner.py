"""Outside a corner both segments of a crack are equally near: round-off must not choose."""

import numpy as np

from cramp_cli.cracks.tip_nodes import along_crack

CRACK = np.array([[-10.0, 0.25], [-6.0, 0.25], [-4.46080883, 0.29180375], [-4.45, 0.278]])


def test_the_segment_beside_a_corner_is_that_towards_the_tip():
    """Before the rule 29 of 4000 places changed their segment with an error of 1e-15."""
    random = np.random.default_rng(0)
    for _ in range(1000):
        x, y = CRACK[2] + 0.4 * random.normal(size=2)
        rough = CRACK * (1.0 + 1e-15 * random.normal(size=CRACK.shape))
        one, other = (along_crack(line, 0, 3, 3, x, y, 10.0) for line in (CRACK, rough))
        assert one[2] == other[2]
