"""Sums from particles to grid rows, motion of the grid, and the way back."""
