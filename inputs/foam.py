"""Draw foam.png, a foam with closed cells: black walls of equal width between white cells.

The cells are those of Voronoi around the points of a triangular raster that were moved at random;
a pixel belongs to a wall if its nearest two points are nearly as far. Run it beside the picture:
python foam.py
"""

from pathlib import Path
from random import Random

import numpy as np
from PIL import Image

SIZE, CELL, WALL = 240, 48.0, 9.0  # pixels: side of the picture, of a cell, width of a wall
JITTER = 0.25  # of a cell


def centres(random: Random) -> np.ndarray:
    """Return the points of the cells (n, 2) in pixels, also around the picture."""
    high = CELL * 0.75**0.5
    return np.array(
        [
            (
                (column + 0.5 * (row % 2) + JITTER * (2.0 * random.random() - 1.0)) * CELL,
                (row + 0.5 + JITTER * (2.0 * random.random() - 1.0)) * high,
            )
            for row in range(-2, round(SIZE / high) + 2)
            for column in range(-2, round(SIZE / CELL) + 2)
        ]
    )


def picture(points: np.ndarray) -> np.ndarray:
    """Return the greys of the picture by row and column: 0 in walls, 255 in cells."""
    x, y = np.meshgrid(np.arange(SIZE) + 0.5, np.arange(SIZE) + 0.5)
    away = np.hypot(x[..., None] - points[:, 0], y[..., None] - points[:, 1])
    order = np.argsort(away, axis=-1)[..., :2]
    near, next_near = np.moveaxis(np.take_along_axis(away, order, axis=-1), -1, 0)
    apart = np.hypot(*np.moveaxis(points[order[..., 1]] - points[order[..., 0]], -1, 0))
    to_edge = (next_near**2 - near**2) / (2.0 * apart)  # from the line between the two cells
    border = np.minimum.reduce([x, y, SIZE - x, SIZE - y])
    return np.where((to_edge < 0.5 * WALL) | (border < WALL), 0, 255).astype(np.uint8)


if __name__ == "__main__":
    target = Path(__file__).with_suffix(".png")
    Image.fromarray(picture(centres(Random(6)))).convert("1").save(target, optimize=True)
