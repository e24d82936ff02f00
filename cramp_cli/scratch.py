"""The scratch paper of a run: arrays for the sums of a step, and threads to make them."""

import numpy as np

from cramp_cli.cracks.cloud import list_origins
from cramp_cli.cracks.fields import beyond_tips
from cramp_cli.cracks.followers import make_followers
from cramp_cli.cracks.segments import make_segments
from cramp_cli.cracks.view import make_seen
from cramp_cli.numerics.team import Team
from cramp_cli.shapes.shape import has_domain, offsets
from cramp_cli.state.grid import make_grid
from cramp_cli.state.model import Scratch
from cramp_cli.state.stencil import make_stencil
from cramp_cli.transfer.sums import share_particles


def make_scratch(model, state, threads: int = 1) -> Scratch:
    """Return scratch arrays large enough for the cracks as they are, and threads to share work."""
    lattice, n = model.lattice, len(state.particles.mass)
    dim, bands = len(lattice.cells), state.bands.shape[1] - 1
    segment_count = max(len(state.paths.point) - state.paths.crack_count, 1)
    shape = model.blocks[0].shape
    per_particle = len(offsets(model.strides, shape))
    listed = min(n, 40 * segment_count + 64)
    grid, rows = make_grid(lattice.node_count, dim, 16 * segment_count + 64)
    report = np.zeros((len(model.blocks), bands, 4), dtype=np.int64)
    scratch = Scratch(
        grid=grid,
        rows=rows,
        stencil=make_stencil(
            n, dim, per_particle, listed, domains=has_domain(shape), sized=model.half is not None
        ),
        segments=make_segments(lattice.node_count, segment_count, 24 * segment_count + 64),
        team=Team(threads, n),
        beyond=beyond_tips(model),
        report=report,
        reports=list(report),
        per_band=np.zeros(bands),
        seen=(make_seen(), make_seen()),
        followers=make_followers(2 * state.paths.crack_count, dim),
        half=model.half,
        at_tips=np.zeros((2 * state.paths.crack_count, 2)),
        origins=list_origins(lattice, state.particles),
    )
    share_particles(state, scratch)
    return scratch
