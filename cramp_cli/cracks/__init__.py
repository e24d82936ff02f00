"""Explicit cracks: crossing test, velocity fields, contact, motion, J and K."""
