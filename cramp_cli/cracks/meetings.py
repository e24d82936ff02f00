"""Nodes that several contact groups see: their particles are listed like those near cracks."""

from cramp_cli.numerics.kernel import kernel
from cramp_cli.shapes.shape import offsets, place_of, sees
from cramp_cli.state.stencil import CLOSE, FAR


@kernel
def forget_groups(rows, of_body):
    """Let no group see a node."""
    rows.lowest[:], rows.highest[:] = len(of_body), -1


@kernel
def mark_groups(rows, stencil, body, of_body, shape, strides, lo, hi):
    """Note at every node the lowest and the highest of the groups that particles lo..hi are of."""
    lowest, highest, base = rows.lowest, rows.highest, stencil.base
    steps = offsets(strides, shape)
    for p in range(lo, hi):
        group, place = of_body[body[p]], place_of(shape, strides, stencil, p)
        for k in range(len(steps)):
            if sees(place, shape, k):
                node = base[p] + steps[k]
                lowest[node] = min(lowest[node], group)
                highest[node] = max(highest[node], group)


@kernel
def list_meeting_particles(rows, stencil, bands, report, shape, strides):
    """Mark particles of a block that see a node of several groups as close.

    bands: (bands + 1,) first particle of each band; report: (bands, 4) of `locate`
    """
    lowest, highest, base, near = rows.lowest, rows.highest, stencil.base, stencil.near
    steps = offsets(strides, shape)
    for band in range(len(bands) - 1):
        for p in range(bands[band], bands[band + 1]):
            meets, place = False, place_of(shape, strides, stencil, p)
            for k in range(len(steps)):
                node = base[p] + steps[k]
                meets = meets or (lowest[node] < highest[node] and sees(place, shape, k))
            if meets:
                report[band, 2] += near[p] == FAR
                near[p] = CLOSE
