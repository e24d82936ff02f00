"""particles and cracks as XDMF and HDF5."""

import os
import re
import signal
import subprocess
import sys
import textwrap
import time
import xml.etree.ElementTree as ElementTree

import h5py
import numpy as np
import pytest

from cramp_cli.output.exits import FolderError
from cramp_cli.output.fields import FrameWriter, polylines, read_frames, tensor_of_plane

NUMBERS = np.random.default_rng(7)


def particles(n):
    points = NUMBERS.random((n, 2))
    stress = NUMBERS.random((n, 3, 3))
    return points, {"stress": stress, "displacement": points, "material": np.arange(n)}


def moments(path):
    tree = ElementTree.parse(path).getroot()
    return tree.find("Domain/Grid").findall("Grid")


def array_of(item, folder):
    """What a program sees that follows the XDMF file."""
    file, place = item.text.split(":")
    with h5py.File(folder / file) as data:
        values = data[place][()]
    assert list(values.shape) == [int(n) for n in item.get("Dimensions").split()]
    kind = {"f": "Float", "i": "Int"}[values.dtype.kind]
    assert (item.get("NumberType"), int(item.get("Precision"))) == (kind, values.dtype.itemsize)
    return values


def test_frames_come_back(tmp_path):
    writer = FrameWriter(tmp_path, "particles", real="f8")
    written = [particles(n) for n in (5, 3)]
    for step, (points, fields) in enumerate(written):
        writer.write(10 * step, 0.1 * step, points, fields)
    for step, frame in enumerate(read_frames(tmp_path / "particles.xdmf")):
        points, fields = written[step]
        assert (frame.step, frame.time, frame.offsets) == (10 * step, 0.1 * step, None)
        np.testing.assert_array_equal(frame.points, np.pad(points, ((0, 0), (0, 1))))
        np.testing.assert_array_equal(frame.fields["stress"], fields["stress"].reshape(-1, 9))
        np.testing.assert_array_equal(frame.fields["material"], fields["material"])
    assert step == 1


def test_xdmf_of_particles_has_one_cell_each(tmp_path):
    writer = FrameWriter(tmp_path, "particles")
    for step, n in enumerate((4, 6)):
        writer.write(step, 0.5 * step, *particles(n))
    grids = moments(tmp_path / "particles.xdmf")
    assert [float(grid.find("Time").get("Value")) for grid in grids] == [0.0, 0.5]
    topology = grids[1].find("Topology")
    assert topology.attrib == {
        "TopologyType": "Polyvertex",
        "NodesPerElement": "1",
        "NumberOfElements": "6",
    }
    np.testing.assert_array_equal(array_of(topology[0], tmp_path), np.arange(6))
    assert array_of(grids[1].find("Geometry")[0], tmp_path).shape == (6, 3)
    kinds = {a.get("Name"): a.get("AttributeType") for a in grids[1].findall("Attribute")}
    assert kinds == {"stress": "Tensor", "displacement": "Vector", "material": "Scalar"}
    for attribute in grids[1].findall("Attribute"):
        assert attribute.get("Center") == "Node"
        array_of(attribute[0], tmp_path)


def test_xdmf_of_cracks_has_a_polyline_each(tmp_path):
    writer = FrameWriter(tmp_path, "cracks")
    points = NUMBERS.random((5, 2))
    fields = {"opening": np.arange(5.0), "crack": np.array([0, 1])}
    writer.write(0, 0.0, points, fields, lines=[0, 2, 5])
    writer.write(1, 0.1, np.vstack([points, points[:2]]), {}, lines=[0, 2, 7])
    first, second = moments(tmp_path / "cracks.xdmf")
    # XDMF: in a mixed topology a polyline is 2, its number of points, its points
    mixed = array_of(first.find("Topology")[0], tmp_path)
    np.testing.assert_array_equal(mixed, [2, 2, 0, 1, 2, 3, 2, 3, 4])
    assert array_of(second.find("Topology")[0], tmp_path)[5] == 5
    centres = {a.get("Name"): a.get("Center") for a in first.findall("Attribute")}
    assert centres == {"opening": "Node", "crack": "Cell"}
    grown = list(read_frames(tmp_path / "cracks.h5"))[1]
    np.testing.assert_array_equal(grown.offsets, [0, 2, 7])


def test_reals_are_small_and_packed(tmp_path):
    FrameWriter(tmp_path, "particles").write(0, 0.0, *particles(100))
    with h5py.File(tmp_path / "particles.h5") as file:
        stress = file["frame_000000/fields/stress"]
        assert (stress.dtype, stress.compression, stress.compression_opts) == ("f4", "gzip", 1)
        assert stress.shuffle


def test_a_frame_without_points_is_kept_but_not_shown(tmp_path):
    writer = FrameWriter(tmp_path, "particles")
    writer.write(0, 0.0, np.empty((0, 2)), {"mass": np.empty(0)})
    writer.write(1, 0.1, *particles(2))
    assert len(moments(tmp_path / "particles.xdmf")) == 1
    assert [len(frame.points) for frame in read_frames(tmp_path / "particles.h5")] == [0, 2]


def test_resume_drops_later_frames(tmp_path):
    writer = FrameWriter(tmp_path, "particles")
    for step in range(4):
        writer.write(step, 0.1 * step, *particles(3))
    index = (tmp_path / "particles.xdmf").read_text()
    FrameWriter(tmp_path, "particles", keep=4)
    assert (tmp_path / "particles.xdmf").read_text() == index
    FrameWriter(tmp_path, "particles", keep=2).write(2, 0.9, *particles(5))
    frames = list(read_frames(tmp_path / "particles.h5"))
    assert [(frame.step, len(frame.points)) for frame in frames] == [(0, 3), (1, 3), (2, 5)]
    assert len(moments(tmp_path / "particles.xdmf")) == 3
    with pytest.raises(FolderError, match="holds 3 frames, the checkpoint knows of 4"):
        FrameWriter(tmp_path, "particles", keep=4)


@pytest.mark.parametrize(
    ("values", "message"), [(np.zeros(4), "4 values for 3"), (np.zeros((3, 5)), "shape")]
)
def test_a_field_that_does_not_fit_is_named(tmp_path, values, message):
    writer = FrameWriter(tmp_path, "particles")
    with pytest.raises(ValueError, match=f"field mass.*{message}"):
        writer.write(0, 0.0, np.zeros((3, 2)), {"mass": values})


def test_a_missing_or_foreign_file_is_named(tmp_path):
    with pytest.raises(FolderError, match="no such file"):
        list(read_frames(tmp_path / "particles.xdmf"))
    (tmp_path / "particles.h5").write_text("no HDF5")
    with pytest.raises(FolderError, match="cannot be read as HDF5"):
        list(read_frames(tmp_path / "particles.xdmf"))


def test_tensors_of_a_plane_are_symmetric():
    full = tensor_of_plane(np.array([[1.0, 2.0, 3.0, 4.0]])).reshape(3, 3)
    np.testing.assert_array_equal(full, [[1, 4, 0], [4, 2, 0], [0, 0, 3]])


def test_polylines_of_nothing_are_nothing():
    assert polylines(np.array([0])).size == 0


def test_a_reader_does_not_stop_the_run(tmp_path):
    writer = FrameWriter(tmp_path, "particles")
    writer.write(0, 0.0, *particles(3))
    program = "import h5py, sys; f = h5py.File(sys.argv[1], locking=True); print(1, flush=True);"
    words = [sys.executable, "-c", program + "input()", str(tmp_path / "particles.h5")]
    with subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as reader:
        reader.stdout.readline()
        writer.write(1, 0.1, *particles(3))
        reader.communicate(b"\n")
    assert len(list(read_frames(tmp_path / "particles.h5"))) == 2


def test_files_open_after_a_kill(tmp_path):
    """The run may be killed at any moment; all frames that the XDMF file names are readable."""
    program = textwrap.dedent("""
        import sys, numpy as np
        from cramp_cli.output.fields import FrameWriter
        writer = FrameWriter(sys.argv[1], "particles")
        points = np.random.default_rng(1).random((2000, 2))
        for step in range(100000):
            writer.write(step, step * 1.0, points, {"a": points, "b": points[:, 0]})
            print(step, flush=True)
    """)
    for pause in (0.0, 0.013, 0.04):
        words = [sys.executable, "-c", program, str(tmp_path)]
        with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as process:
            for _ in range(5):
                process.stdout.readline()
            time.sleep(pause)
            os.kill(process.pid, signal.SIGKILL)
        named = set(re.findall(r"/(frame_\d+)/points", (tmp_path / "particles.xdmf").read_text()))
        assert len(named) >= 5
        assert len(list(read_frames(tmp_path / "particles.h5"))) >= len(named)
        for grid in moments(tmp_path / "particles.xdmf"):
            array_of(grid.find("Geometry")[0], tmp_path)
