"""Traction laws: what the faces of a crack give each other, or carry, while they part."""
