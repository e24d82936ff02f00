"""Pictures of a run: the right numbers, in the right unit, at the right place."""

import sys

import numpy as np
import pytest
from PIL import Image
from written import STRETCH, write_run

from cramp_cli.output.exits import FILES, FolderError, exit_code
from cramp_cli.study.crack_path import draw_path
from cramp_cli.study.curves import draw_columns, draw_energy, draw_tips
from cramp_cli.study.figures import NoMatplotlib, drawing, save
from cramp_cli.study.particles import quantity, squares, von_mises
from cramp_cli.study.plot import PlotOptions, plot, seconds
from cramp_cli.study.quantities import label, scale_for
from cramp_cli.study.results import by_tip, frame_at, read_table
from cramp_cli.study.snapshots import View, colour_limits, draw_field


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    return write_run(tmp_path_factory.mktemp("plot") / "plate.run")


@pytest.fixture
def plt():
    with drawing() as pyplot:
        yield pyplot


@pytest.mark.parametrize(
    ("unit", "largest", "shown"),
    [
        ("s", 1.5e-3, "1.5 ms"),
        ("s", 2e-5, "20 µs"),
        ("m", 0.1, "100 mm"),
        ("Pa*m^0.5", 3e5, "0.3 MPa√m"),
        ("J/m^2", 336.0, "336 J/m²"),
        ("Pa", 0.0, "0 Pa"),
        ("1", 1e-7, "1e-07 "),
    ],
)
def test_numbers_get_the_prefix_that_people_use(unit, largest, shown):
    scale = scale_for(unit, [0.0, -largest, np.nan])
    assert f"{largest / scale.size:g} {scale.unit}" == shown


def test_a_pure_number_has_no_unit_on_its_axis():
    assert label("error", scale_for("1", [1.0])) == "error"
    assert label("time", scale_for("s", [1.0])) == "time (s)"


def test_a_table_is_read_without_the_line_that_is_being_written(tmp_path):
    (tmp_path / "cracks.csv").write_text(
        "time,crack,tip,K_I\n0,a,end,1\n0,b,start,2\n1,a,end,3\n1,b"
    )
    tips = by_tip(read_table(tmp_path / "cracks.csv"))
    assert list(tips) == ["a end", "b start"]
    np.testing.assert_array_equal(tips["a end"]["K_I"], [1.0, 3.0])
    assert read_table(tmp_path / "none.csv") == {}


def test_the_frame_nearest_to_a_time(run):
    assert [frame_at(run, "particles", t).step for t in (-1.0, 1.2e-6, None)] == [0, 1, 2]


def test_von_mises_of_pure_tension_and_pressure():
    tension, pressure = np.diag([0.0, 5.0, 0.0]), -3.0 * np.eye(3)
    np.testing.assert_allclose(von_mises(np.array([tension, pressure]).reshape(2, 9)), [5.0, 0.0])


def test_quantities_of_a_frame(run):
    frame = frame_at(run, "particles")
    np.testing.assert_allclose(quantity(frame, "stress_yy").values, 1e9 * STRETCH * 2e-6)
    assert np.all(quantity(frame, "stress_xx").values == 0.0)
    assert quantity(frame, "displacement").signed is False
    with pytest.raises(FolderError, match="did you mean 'stress_yy'"):
        quantity(frame, "stress_y")
    with pytest.raises(FolderError, match="add velocity to output.fields"):
        quantity(frame, "velocity_x")


def test_a_deformation_gradient_has_both_shears(run):
    frame = frame_at(run, "particles")
    n = len(frame.points)
    F = np.tile([1.0, 0.1, 0.0, -0.2, 1.0, 0.0, 0.0, 0.0, 1.0], (n, 1))
    frame = frame._replace(fields=frame.fields | {"deformation_gradient": F})
    assert np.all(quantity(frame, "deformation_gradient_xy").values == 0.1)
    assert np.all(quantity(frame, "deformation_gradient_yx").values == -0.2)
    with pytest.raises(FolderError, match="unknown quantity 'stress_yx'"):
        quantity(frame, "stress_yx")


def test_magnified_squares_move_that_much_further(run):
    frame = frame_at(run, "particles")
    sizes = np.full(len(frame.points), 1e-3)
    once, thrice = (squares(frame, sizes, m).mean(axis=1) for m in (1.0, 3.0))
    np.testing.assert_allclose(thrice - once, 2.0 * frame.fields["displacement"][:, :2], atol=1e-9)


def test_zero_is_in_the_middle_of_signed_colours(run):
    shown = [quantity(frame_at(run, "particles"), "displacement_y")]
    low, high = colour_limits(shown)
    assert low == -high < 0.0


def test_tips_are_drawn_with_references(run, plt, tmp_path):
    (tmp_path / "paper.csv").write_text("time,K_I\n1e-6,1.4e5\n")
    figure = draw_tips(plt, run, [tmp_path / "paper.csv"])
    K_I, K_II, J = figure.axes
    assert [panel.get_ylabel() for panel in (K_I, J)] == [
        r"$K_\mathrm{I}$ (MPa√m)",
        "$J$ (J/m²)",
    ]
    lines = {line.get_label(): line.get_xydata() for line in K_I.lines}
    np.testing.assert_allclose(lines["notch end"], [[0, 0], [1, 0.15], [2, 0.3]], atol=1e-12)
    np.testing.assert_allclose(lines["notch end, contour"][-1], [2, 0.33])
    np.testing.assert_allclose(lines["paper"], [[1.0, 0.14]])
    np.testing.assert_allclose(lines["status is not ok"], [[1.0, 0.15]])
    assert K_II.get_ylim()[1] < 0.01  # K_II is zero beside K_I
    assert J.get_xlabel() == "time (µs)"


def test_the_books_are_drawn_without_empty_ones(run, plt):
    figure = draw_energy(plt, run)
    names = [text.get_text() for text in figure.legends[0].get_texts()]
    assert names == ["external work", "kinetic", "strain"]


def test_an_unknown_column_is_named_with_the_one_that_is_meant(run, plt):
    with pytest.raises(FolderError, match="unknown column 'K_1'; did you mean 'K_I'"):
        draw_columns(plt, run, ["K_1"])


def test_a_reference_needs_time(run, plt, tmp_path):
    (tmp_path / "paper.csv").write_text("t,K_I\n1e-6,1.4e5\n")
    with pytest.raises(FolderError, match=r"paper\.csv: needs a column 'time'"):
        draw_tips(plt, run, [tmp_path / "paper.csv"])


def test_a_field_has_a_square_for_every_particle(run, plt):
    figure = draw_field(plt, run, View("displacement_y", 1e-6))
    axes, bar = figure.axes
    assert len(axes.collections[0].get_paths()) == len(frame_at(run, "particles").points)
    assert axes.get_title("left") == "$t$ = 1 µs"
    assert bar.get_ylabel() + bar.get_xlabel() == "$u_y$ (nm)"


def test_an_opened_crack_is_drawn_wide_enough_to_see(run, plt):
    figure = draw_path(plt, run, View())
    upper = next(line for line in figure.axes[0].lines if line.get_label() == "notch, both faces")
    np.testing.assert_allclose(upper.get_xydata()[0], [0.0, 0.5], atol=1e-6)  # mm: 1 mm, once


def test_plot_writes_what_a_run_has(run, tmp_path):
    made = plot(run, tmp_path / "p", PlotOptions(columns=["K_I"], kinds=["tips", "animation"]))
    assert [path.name for path in made] == ["tips.png", "animation.gif", "K_I.png"]
    with Image.open(made[1]) as film:
        assert film.n_frames == 3
    assert [path.name for path in plot(run, tmp_path / "q", PlotOptions(form="pdf"))] == [
        *("tips.pdf", "energy.pdf", "path.pdf", "field.pdf")
    ]


def test_a_movie_is_made_by_ffmpeg_or_says_that_it_is_missing(run, tmp_path, monkeypatch):
    """A stand-in for ffmpeg that keeps what it is sent: all frames, of the size it was told."""
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(FolderError, match="needs the program ffmpeg"):
        plot(run, tmp_path / "p", PlotOptions(kinds=["movie"]))
    stand_in = tmp_path / "ffmpeg"
    stand_in.write_text(f"#!{sys.executable}\n{STAND_IN}")
    stand_in.chmod(0o755)
    (made,) = plot(run, tmp_path / "p", PlotOptions(kinds=["movie"]))
    size, sent = made.read_text().split()
    wide, high = map(int, size.split("x"))
    assert int(sent) == 3 * 4 * wide * high


STAND_IN = """
import sys
words = sys.argv[1:]
sent = len(sys.stdin.buffer.read())
open(words[-1], "w").write(words[words.index("-s") + 1] + " " + str(sent))
"""


def test_a_picture_without_its_file_is_refused(run, tmp_path):
    bare = write_run(tmp_path / "bare.run")
    (bare / "particles.h5").unlink()
    with pytest.raises(FolderError, match="has no particles.h5, which the picture 'field'"):
        plot(bare, tmp_path, PlotOptions(kinds=["field"]))


def test_times_are_told_with_their_unit():
    assert seconds("1.5 ms") == pytest.approx(1.5e-3)
    assert seconds("2e-3") == 2e-3
    assert seconds(None) is None
    for text in ("1 mm", "soon"):
        with pytest.raises(FolderError, match="is no time"):
            seconds(text)


def test_without_matplotlib_one_line_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(NoMatplotlib, match=r"pip install 'cramp\[plot\]'") as caught, drawing():
        pass
    assert exit_code(caught.value) == FILES


def test_a_picture_has_an_ending_that_is_known(plt, tmp_path):
    with pytest.raises(FolderError, match="ends with .png, .pdf or .svg"):
        save(plt.figure(), tmp_path / "x.jpg")
