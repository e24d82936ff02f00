"""Fracture simulation with explicit cracks in the material point method."""

__version__ = "0.1.0"
