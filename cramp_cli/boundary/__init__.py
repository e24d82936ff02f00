"""Prescribed velocities, symmetry planes, loads."""
