"""Which of the cracks between a particle and a node tell its row.

Those of the particle's own body; and a tip that has been carried on counts at its own nodes only.
"""

from cramp_cli.cracks.branches import off_joint
from cramp_cli.cracks.crossing import crossed_cracks, crossed_once, crosses, off_crack
from cramp_cli.cracks.segments import HAIR, ON_CRACK
from cramp_cli.numerics.kernel import inlined_kernel

NO_CRACK = (-1, 0, -1, -1, 0, -1, 0)  # what `crossed_cracks` says of a free line


@inlined_kernel
def cracks_between(segments, cell, hidden, unsure, k, place, n, beside, of_crack, group, tolerance):
    """Return the cracks, as `crossed_cracks` does, that tell the row of a particle at its node k.

    hidden, unsure: of `hidden_nodes`; place: that of the particle, off the cracks
    n: place of the node (m); beside: branch whose tip the node is beside, or -1
    group: of the particle
    """
    (x, y), (nx, ny) = place, n
    crossed = NO_CRACK
    if unsure >> k & 1:
        nx, ny = off_joint(segments, nx, ny, HAIR / ON_CRACK * tolerance)
        nx, ny = off_crack(segments, cell, nx, ny, tolerance)
        crossed = crossed_cracks(segments, cell, x, y, nx, ny, tolerance)
    elif hidden >> k & 1:
        crossed = crossed_once(segments, k)
    if crossed[0] < 0:
        return NO_CRACK
    crossed = without_imagined(segments, crossed, beside, x, y, nx, ny, tolerance)
    return of_group(segments, crossed, of_crack, group)


@inlined_kernel
def is_imagined(segments, s, x, y, nx, ny, tolerance):
    """Return whether a line crosses segment `s` only where its tip has been carried on."""
    ends, real = segments.ends, segments.real
    carried = ends[s, 0] != real[s, 0] or ends[s, 1] != real[s, 1]
    carried = carried or ends[s, 2] != real[s, 2] or ends[s, 3] != real[s, 3]
    return carried and crosses(real, segments.down, s, x, y, nx, ny, tolerance) == 0


@inlined_kernel
def without_imagined(segments, crossed, own, x, y, nx, ny, tolerance):
    """Return the cracks crossed; those of another tip than the node's count where they are real.

    A tip is carried on to tell the sides ahead of it at its own nodes; at the nodes of a tip that
    comes to meet it, this would cut what still holds the two together.

    own: branch of the tip that is near the node, or -1
    """
    a, _, seg_a, b, _, seg_b, _ = crossed
    no_b = b >= 0 and b != own and is_imagined(segments, seg_b, x, y, nx, ny, tolerance)
    no_a = a >= 0 and a != own and is_imagined(segments, seg_a, x, y, nx, ny, tolerance)
    return but_for(crossed, no_a, no_b)


@inlined_kernel
def but_for(crossed, no_a, no_b):
    """Return the cracks crossed without the first, the second, or both."""
    a, side_a, seg_a, b, side_b, seg_b, more = crossed
    if no_b:
        b, side_b, seg_b = -1, 0, -1
    if no_a:
        a, side_a, seg_a = b, side_b, seg_b
        b, side_b, seg_b = -1, 0, -1
    return a, side_a, seg_a, b, side_b, seg_b, more


@inlined_kernel
def of_group(segments, crossed, of_crack, group):
    """Return those of the cracks crossed that cut bodies of a group."""
    seg_a, seg_b, crack = crossed[2], crossed[5], segments.crack
    no_a = seg_a >= 0 and of_crack[crack[seg_a]] != group
    return but_for(crossed, no_a, seg_b >= 0 and of_crack[crack[seg_b]] != group)
