"""Contact between bodies: normals, separation, laws, rigid bodies."""
