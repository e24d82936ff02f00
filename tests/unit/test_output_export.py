"""From a run's folder to VTU, PVD and CSV."""

import xml.etree.ElementTree as ElementTree

import meshio
import numpy as np
import pytest

from cramp_cli.output.exits import FolderError
from cramp_cli.output.export import export
from cramp_cli.output.fields import FrameWriter


@pytest.fixture
def run(tmp_path):
    """Two frames of three particles and of two cracks, the second of which grows."""
    particles, cracks = FrameWriter(tmp_path, "particles"), FrameWriter(tmp_path, "cracks")
    points = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 2.0]])
    line = np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0], [4.0, 1.0], [5.0, 1.0]])
    for step, count in enumerate((5, 6)):
        fields = {"stress": np.arange(27.0).reshape(3, 3, 3), "mass": np.arange(3.0)}
        particles.write(step, 0.25 * step, points + step, fields)
        on_lines = {"opening": np.arange(float(count)), "crack": np.array([0, 1])}
        cracks.write(step, 0.25 * step, line[:count], on_lines, lines=[0, 2, count])
    return tmp_path


def test_vtu_holds_all_frames_with_their_times(run, tmp_path):
    opened = export(run, tmp_path / "out", "vtu")
    assert [path.name for path in opened] == ["particles.pvd", "cracks.pvd"]
    for path in opened:
        sets = ElementTree.parse(path).getroot().findall("Collection/DataSet")
        assert [float(one.get("timestep")) for one in sets] == [0.0, 0.25]
        assert all((path.parent / one.get("file")).exists() for one in sets)


def test_vtu_of_particles_reads_back(run, tmp_path):
    export(run, tmp_path / "out", "vtu")
    mesh = meshio.read(tmp_path / "out" / "particles_000001.vtu")
    np.testing.assert_allclose(mesh.points[2], [2.0, 3.0, 0.0])
    assert mesh.cells_dict["vertex"].shape == (3, 1)
    np.testing.assert_array_equal(mesh.point_data["stress"][1], np.arange(9.0, 18.0))


def test_vtu_of_cracks_joins_no_two_cracks(run, tmp_path):
    export(run, tmp_path / "out", "vtu")
    mesh = meshio.read(tmp_path / "out" / "cracks_000001.vtu")
    np.testing.assert_array_equal(mesh.cells_dict["line"], [[0, 1], [2, 3], [3, 4], [4, 5]])
    np.testing.assert_array_equal(mesh.cell_data["crack"][0], [0, 1, 1, 1])


def test_csv_has_a_row_per_point(run, tmp_path):
    opened = export(run, tmp_path / "out", "csv")
    assert opened[0].read_text() == "time,file\n0,particles_000000.csv\n0.25,particles_000001.csv\n"
    lines = (tmp_path / "out" / "cracks_000000.csv").read_text().splitlines()
    assert lines[0] == "points_x,points_y,points_z,line,opening"
    assert lines[3] == "2,0,0,1,2"
    head = (tmp_path / "out" / "particles_000000.csv").read_text().splitlines()[0]
    assert head.startswith("points_x,points_y,points_z,mass,stress_xx,stress_xy")


def test_a_folder_without_frames_is_refused(tmp_path):
    with pytest.raises(FolderError, match="to export"):
        export(tmp_path, tmp_path / "out", "vtu")
