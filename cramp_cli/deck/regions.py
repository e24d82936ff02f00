"""What is left of bodies where later bodies and holes cover them."""

from functools import cached_property


class Regions:
    """The regions of all bodies of a deck, holes among them."""

    def __init__(self, bodies):
        self.bodies = bodies

    @cached_property
    def _bounds(self):
        """Lower and upper corners of the boxes around the bodies, (bodies, 2) each (m)."""
        import numpy as np

        corners = np.array([body.shape.bounds() for body in self.bodies])
        return corners[:, 0], corners[:, 1]

    def left(self, number: int):
        """Return what later bodies leave of body `number`, as a shapely geometry."""
        from shapely import union_all

        low, high = self._bounds
        meets = ((low[number] < high) & (low < high[number])).all(axis=1)
        later = [n for n in meets.nonzero()[0].tolist() if n > number]
        own = self.bodies[number].shape.outline()
        return own - union_all([self.bodies[n].shape.outline() for n in later]) if later else own
