"""Nodes that several contact groups see: their particles are listed like those near cracks."""

from cramp_cli.numerics.kernel import kernel
from cramp_cli.shapes.shape import offsets, place_of, sees
from cramp_cli.state.stencil import CLOSE, FAR


@kernel
def mark_groups(rows, stencil, body, of_body, shape, strides):
    """Note at every node the lowest and the highest of the groups that see it."""
    lowest, highest, base = rows.lowest, rows.highest, stencil.base
    lowest[:], highest[:] = len(of_body), -1
    steps = offsets(strides, shape)
    for p in range(len(base)):
        group, place = of_body[body[p]], place_of(shape, strides, stencil, p)
        for k in range(len(steps)):
            if sees(place, shape, k):
                node = base[p] + steps[k]
                lowest[node] = min(lowest[node], group)
                highest[node] = max(highest[node], group)


@kernel
def list_meeting_particles(rows, stencil, bands, report, shape, strides):
    """Mark particles that see a node of several groups as close; bands, report: as in `locate`."""
    lowest, highest, base, near = rows.lowest, rows.highest, stencil.base, stencil.near
    steps = offsets(strides, shape)
    for block in range(len(bands)):
        for band in range(bands.shape[1] - 1):
            for p in range(bands[block, band], bands[block, band + 1]):
                meets, place = False, place_of(shape, strides, stencil, p)
                for k in range(len(steps)):
                    node = base[p] + steps[k]
                    meets = meets or (lowest[node] < highest[node] and sees(place, shape, k))
                if meets:
                    report[block, band, 2] += near[p] == FAR
                    near[p] = CLOSE
