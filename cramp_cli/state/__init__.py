"""Named arrays without behaviour: particles, grid, cracks."""
