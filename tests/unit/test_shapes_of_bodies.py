"""Which points a shape holds, its bounds, centroid and outline."""

from math import pi, sqrt

import numpy as np
import pytest
from pydantic import TypeAdapter, ValidationError

from cramp_cli.deck.shapes import AnyShape
from cramp_cli.schema.explain import explain

ADAPTER = TypeAdapter(AnyShape)
SQUARE = {"type": "rectangle", "lower": [0, 0], "upper": [2, 1]}
DISK = {"type": "disk", "center": [1, 2], "radius": 0.5}
SHAPES = {
    "rectangle": (SQUARE, 2.0),
    "disk": (DISK, pi / 4),
    "ellipse": ({"type": "ellipse", "center": [1, 2], "radii": [2, 0.5], "angle": 30}, pi),
    "polygon": ({"type": "polygon", "points": [[0, 0], [2, 0], [0, 1]]}, 1.0),
    "annulus": ({"type": "annulus", "center": [1, 2], "inner": 1, "outer": 2}, 3 * pi),
    "union": ({"type": "union", "of": [SQUARE, DISK]}, 2.0 + pi / 4),
    "difference": (
        {"type": "difference", "of": SQUARE, "minus": [{**DISK, "center": [1, 0.5]}]},
        2.0 - pi / 4,
    ),
}


def shape(data, folder=None):
    return ADAPTER.validate_python(data, context={"folder": folder})


def mistakes(data, folder=None):
    with pytest.raises(ValidationError) as caught:
        shape(data, folder)
    return [(path, message) for path, message, _ in explain(caught.value, data)]


def points_of_grid(lower, upper, count=400):
    x, y = (np.linspace(a, b, count, endpoint=False) for a, b in zip(lower, upper, strict=True))
    grid = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2)
    return grid + 0.5 * (np.array(upper) - lower) / count


@pytest.mark.parametrize("name", SHAPES)
def test_area_bounds_centroid_and_outline_agree(name):
    """Area by counting points against the formula; centroid against their mean."""
    data, area = SHAPES[name]
    here = shape(data)
    lower, upper = here.bounds()
    points = points_of_grid(np.array(lower) - 0.1, np.array(upper) + 0.1)
    inside = here.contains(points)
    size = np.prod(np.array(upper) - lower + 0.2)
    assert inside.dtype == bool
    assert inside.mean() * size == pytest.approx(area, rel=5e-3)
    assert here.outline().area == pytest.approx(area, rel=1e-3)
    assert np.mean(points[inside], axis=0) == pytest.approx(here.centroid(), abs=5e-3)
    assert np.all(points[inside] >= lower)
    assert np.all(points[inside] <= upper)
    assert here.outline().bounds == pytest.approx((*lower, *upper), abs=2e-3)


def test_neighbours_share_no_point_and_lose_none():
    """Points on the common border, also with the rounding of 0.1 + 0.2, are in exactly one."""
    y = np.linspace(0.0, 1.0, 11)
    left = {"type": "rectangle", "lower": [0, -0.5], "upper": [0.3, 1.5]}
    right = {"type": "rectangle", "lower": [0.3, -0.5], "upper": [1, 1.5]}
    for x in (0.3, 0.1 + 0.2):
        points = np.stack([np.full_like(y, x), y], axis=-1)
        assert not shape(left).contains(points).any()
        assert shape(right).contains(points).all()
        corners = [[0.3, -0.5], [1, -0.5], [1, 1.5], [0.3, 1.5]]
        assert shape({"type": "polygon", "points": corners}).contains(points).all()


def test_disk_and_ring_around_it_share_no_point_and_lose_none():
    angle = np.linspace(0.0, 2.0 * pi, 50)
    points = np.array([1.0, 2.0]) + 0.5 * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    ring = {"type": "annulus", "center": [1, 2], "inner": 0.5, "outer": 1}
    both = shape(DISK).contains(points).astype(int) + shape(ring).contains(points)
    assert (both == 1).all()


def test_turned_ellipse():
    tilted = shape({"type": "ellipse", "center": [0, 0], "radii": [2, 1], "angle": 90})
    assert tilted.contains(np.array([[0.0, 1.9], [1.9, 0.0]])).tolist() == [True, False]
    diagonal = shape({"type": "ellipse", "center": [0, 0], "radii": [2, 1], "angle": "45 deg"})
    assert diagonal.bounds()[1] == pytest.approx((sqrt(2.5), sqrt(2.5)))


def test_polygon_from_a_file(tmp_path):
    (tmp_path / "ümlaut.csv").write_text("x,y\n# corner\n0, 0\n\n2,0 # right\n0,1\n")
    from_file = shape({"type": "polygon", "file": "ümlaut.csv"}, tmp_path)
    assert from_file.points == ((0.0, 0.0), (2.0, 0.0), (0.0, 1.0))
    assert from_file.model_dump(exclude_none=True)["points"] == from_file.points


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (None, "cannot read 'a.csv': No such file or directory"),
        (b"0,0\n1,2,3\n", "line 2 of a.csv is no 'x,y' row (got '1,2,3')"),
        (b"0;0\n", "line 1 of a.csv is no 'x,y' row (got '0;0')"),
        (b"\xff", "'a.csv' is not UTF-8 text"),
    ],
)
def test_files_that_hold_no_points(tmp_path, content, message):
    if content is not None:
        (tmp_path / "a.csv").write_bytes(content)
    found = mistakes({"type": "polygon", "file": "a.csv"}, tmp_path)
    assert (("file",), message) in found


def test_a_folder_or_a_device_is_no_file(tmp_path):
    assert mistakes({"type": "polygon", "file": "."}, tmp_path) == [(("file",), "'.' is no file")]
    found = mistakes({"type": "polygon", "file": "/dev/zero"}, tmp_path)
    assert found == [(("file",), "'/dev/zero' is no file")]


def test_points_of_a_file_are_checked_too(tmp_path):
    (tmp_path / "a.csv").write_text("0,0\nnan,0\n1,1\n")
    found = mistakes({"type": "polygon", "file": "a.csv"}, tmp_path)
    assert found == [(("file",), "line 2 of a.csv is not finite")]


@pytest.mark.parametrize(
    ("data", "found"),
    [
        (
            {**SQUARE, "upper": [-1, 0]},
            [
                (("upper", 0), "must be above lower (0 m) (got -1 m)"),
                (("upper", 1), "must be above lower (0 m) (got 0 m)"),
            ],
        ),
        ({**DISK, "radius": "-1 mm"}, [(("radius",), "must be above 0 (got -1 mm)")]),
        (
            {"type": "ellipse", "center": [0, 0], "radii": [1, 0]},
            [(("radii", 1), "must be above 0 (got 0 m)")],
        ),
        (
            {"type": "annulus", "center": [0, 0], "inner": 2, "outer": 1},
            [(("outer",), "must be above inner (2 m) (got 1 m)")],
        ),
        (
            {"type": "polygon", "points": [[0, 0], [1, 1], [1, 0], [0, 1]]},
            [(("points",), "is no simple polygon: its border meets itself at (0.5, 0.5) m")],
        ),
        (
            {"type": "polygon", "points": [[0, 0], [1, 1]]},
            [(("points",), "must have at least 3 entries (got 2)")],
        ),
        ({"type": "polygon"}, [((), "give one of points, file")]),
        (
            {"type": "polygon", "points": [[0, 0], [1, 1], [1, 0]], "file": "x"},
            [(("file",), "give only one of points, file")],
        ),
        ({"type": "union", "of": []}, [(("of",), "must have at least 1 entry (got 0)")]),
        (
            {"type": "union", "of": [SQUARE, {"type": "disc"}]},
            [
                (
                    ("of", 1, "type"),
                    "unknown type 'disc'; did you mean 'disk'? (known: rectangle, disk, ellipse, "
                    "polygon, annulus, union, difference, array, pack, image, mesh)",
                )
            ],
        ),
        (
            {"type": "difference", "of": DISK, "minus": [{**DISK, "radius": 2}]},
            [(("minus",), "cuts everything away")],
        ),
        ("disk", [((), "must be a section such as {type: rectangle, ...} (got 'disk')")]),
    ],
)
def test_mistakes(data, found):
    assert mistakes(data) == found
