"""Regions of a grey picture: foams, composites, sections of a tomogram."""

from collections.abc import Iterator
from functools import cached_property, lru_cache
from pathlib import Path
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from cramp_cli.deck.files import FileShape
from cramp_cli.deck.shape import KIND
from cramp_cli.schema.section import Count, PreparationError, Wrong, only_one
from cramp_cli.schema.units import Length, Point, pair, shown

LARGEST = 4096 * 4096  # pixels
DEEPEST = ("1", "L", "LA", "P", "PA", "RGB", "RGBA", "RGBX", "CMYK", "YCbCr")  # 8 bit at most
Greys = pair(Annotated[Count, Field(ge=0, le=255)])


class Image(FileShape):
    """The pixels of a picture with a grey in a range; a body for every range makes materials."""

    places: ClassVar = ("origin",)

    type: Literal["image"] = Field("image", description=KIND)
    grey: Greys = Field(
        description="darkest and lightest grey that belong to it, from 0 (black) to 255 (white)"
    )
    pixel: Length | None = Field(None, gt=0, description="width of a pixel; or `width`")
    width: Length | None = Field(None, gt=0, description="width of the picture; or `pixel`")
    origin: Point = Field((0.0, 0.0), description="lower left corner of the picture")

    @classmethod
    def prepare(cls, data: dict, folder: Path | None) -> dict:
        """Find the file and see whether it is a picture."""
        data = super().prepare(data, folder)
        if isinstance(data.get("file"), str):
            greys(data["file"], data["sha256"])
        return data

    @classmethod
    def wrong_keys(cls, keys: set[str]) -> Iterator[Wrong]:
        """Its size is told in one way."""
        yield from only_one(keys, ("pixel", "width"))

    def wrong_values(self) -> Iterator[Wrong]:
        """Some pixel has such a grey."""
        low, high = self.grey
        if low > high:
            yield ("grey",), f"must be [low, high] (got [{low}, {high}])"
        elif not self.mask.any():
            found = greys(self.file, self.sha256)
            there = f"its greys are {found.min()} to {found.max()}"
            yield ("grey",), f"no pixel of {self.short_name} is from {low} to {high}; {there}"

    @cached_property
    def mask(self):
        """Which pixels belong to it: booleans by row, from below, and column."""
        found = greys(self.file, self.sha256)[::-1]
        return (found >= self.grey[0]) & (found <= self.grey[1])

    @property
    def side(self) -> float:
        """The width of a pixel (m)."""
        return self.pixel if self.pixel is not None else self.width / self.mask.shape[1]

    def contains(self, points):
        """Return which points lie in such a pixel; its left and lower border belong to it."""
        import numpy as np

        column, row = np.floor((self.nudged(points) - self.origin) / self.side).astype(int).T
        rows, columns = self.mask.shape
        inside = (column >= 0) & (column < columns) & (row >= 0) & (row < rows)
        inside[inside] = self.mask[row[inside], column[inside]]
        return inside

    def bounds(self):
        """Return the corners of the box around all such pixels (m)."""
        import numpy as np

        rows, columns = (np.flatnonzero(self.mask.any(axis=axis)) for axis in (1, 0))
        (x, y), side = self.origin, self.side
        lower = x + side * int(columns[0]), y + side * int(rows[0])
        return lower, (x + side * int(columns[-1] + 1), y + side * int(rows[-1] + 1))

    def outline(self):
        """Return the union of the pixels."""
        return self._outline

    @cached_property
    def _outline(self):
        from shapely import box, union_all

        row, first, last = _runs(self.mask)
        (x, y), side = self.origin, self.side
        return union_all(
            box(x + side * first, y + side * row, x + side * last, y + side * (row + 1))
        )


@lru_cache(maxsize=8)
def greys(file: str, sha256: str):
    """Return the greys of a picture, 0 to 255, by row from above and column.

    sha256: of the file, so that another picture of the same name is read anew
    Raises PreparationError for what is no picture of 8 bit.
    """
    import numpy as np

    name = shown(Path(file).name)
    try:
        from PIL import Image as Picture
        from PIL import UnidentifiedImageError
    except ImportError:
        message = "pictures need pillow: pip install 'cramp[image]'"
        raise PreparationError(("file",), message) from None
    try:
        with Picture.open(file) as picture:
            if picture.width * picture.height > LARGEST:
                size = f"{picture.width} x {picture.height}"
                raise PreparationError(("file",), f"has {size} pixels; at most {LARGEST} are read")
            if picture.mode not in DEEPEST:
                message = f"{name} has more than 8 bit for a grey; save it with 8 ({picture.mode})"
                raise PreparationError(("file",), message)
            return np.asarray(picture.convert("L"))
    except UnidentifiedImageError:
        raise PreparationError(("file",), f"{name} is no picture that pillow knows") from None
    except (OSError, ValueError, SyntaxError, Picture.DecompressionBombError) as problem:
        raise PreparationError(("file",), f"cannot read {name}: {problem}") from None


def _runs(mask):
    """Return row, first column and column behind the last of all runs of pixels in a row."""
    import numpy as np

    change = np.diff(np.pad(mask, ((0, 0), (1, 1))).astype(np.int8), axis=1)
    row, first = np.nonzero(change == 1)
    return row, first, np.nonzero(change == -1)[1]
