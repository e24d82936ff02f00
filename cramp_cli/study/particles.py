"""What the particles of a frame show: a quantity by name, their squares, the cracks among them."""

from typing import NamedTuple

import numpy as np

from cramp_cli.output.exits import FolderError
from cramp_cli.output.fields import Frame
from cramp_cli.schema.section import unknown

COMPONENTS = {"xx": 0, "xy": 1, "yx": 3, "yy": 4, "zz": 8}
SYMMETRIC = ("stress", "strain")  # of these xy is yx
UNITS = {
    "stress": "Pa",
    "strain": "1",
    "displacement": "m",
    "velocity": "m/s",
    "acceleration": "m/s^2",
    "deformation_gradient": "1",
    "energy": "J/m^3",
    "dissipated_energy": "J/m^3",
    "plastic_strain": "1",
}
SHOWN = {
    "xx": "_{xx}",
    "yy": "_{yy}",
    "xy": "_{xy}",
    "zz": "_{zz}",
    "x": "_x",
    "y": "_y",
    "": "",
}
AROUND = 8  # particles beside a point of a crack: as many above as below
OVERLAP = 1.04  # squares are drawn that much larger: a stretched body shows no gaps
SYMBOLS = {"stress": r"\sigma", "strain": "E", "displacement": "u", "velocity": "v"}


class Quantity(NamedTuple):
    """A number per particle that can be coloured."""

    name: str  # as on the command line
    values: np.ndarray  # (n,), SI
    unit: str
    signed: bool  # zero lies in the middle of its colours


def quantities(frame: Frame) -> dict[str, str]:
    """Return what can be shown of a frame: name and the field it comes from."""
    names = {}
    for field, values in frame.fields.items():
        if field not in UNITS or len(values) != len(frame.points):
            continue
        if values.ndim == 1 or values.shape[1] == 3:
            names[field] = field
        if values.ndim == 2:
            parts = ("x", "y") if values.shape[1] == 3 else COMPONENTS
            twice = {"yx"} if field in SYMMETRIC else set()
            names |= {f"{field}_{part}": field for part in parts if part not in twice}
    if "stress" in frame.fields:
        names["von_mises"] = "stress"
    return names


def usual_quantity(frame: Frame) -> str:
    """Return what is shown when nobody asks: stress, else the first there is."""
    known = quantities(frame)
    return "von_mises" if "von_mises" in known else next(iter(known), "")


def quantity(frame: Frame, name: str) -> Quantity:
    """Return a quantity of the particles of a frame.

    name: a field (a vector by its length), a component such as stress_yy, or von_mises
    Raises FolderError for a quantity that the run did not write.
    """
    known = quantities(frame)
    if name not in known:
        field = next((field for field in UNITS if name.startswith(field)), "")
        unwritten = field and field not in frame.fields
        hint = f"; add {field} to output.fields of the deck" if unwritten else ""
        raise FolderError(f"particles.h5: {unknown('quantity', name, known)}{hint}")
    field, values = known[name], frame.fields[known[name]]
    if name == "von_mises":
        return Quantity(name, von_mises(values), "Pa", signed=False)
    part = name.removeprefix(field).lstrip("_")
    if not part:
        length = values if values.ndim == 1 else np.linalg.norm(values, axis=1)
        return Quantity(name, length, UNITS[field], signed=False)
    column = "xy".index(part) if values.shape[1] == 3 else COMPONENTS[part]
    return Quantity(name, values[:, column], UNITS[field], signed=True)


def von_mises(stress: np.ndarray) -> np.ndarray:
    """Return the equivalent stress (n,) of (n, 9) tensors, Pa."""
    tensor = stress.reshape(-1, 3, 3).astype(float)
    mean = np.trace(tensor, axis1=1, axis2=2) / 3.0
    deviator = tensor - mean[:, None, None] * np.eye(3)
    return np.sqrt(1.5 * np.einsum("nij,nij->n", deviator, deviator))


def symbol(name: str) -> str:
    """Return a quantity's name as a label says it."""
    if name == "von_mises":
        return "von Mises stress"
    field, _, part = name.rpartition("_")
    if field in SYMBOLS and part in SHOWN:
        return f"${SYMBOLS[field]}{SHOWN[part]}$"
    return name.replace("_", " ")


def squares(frame: Frame, sizes: np.ndarray, magnify: float = 1.0) -> np.ndarray:
    """Return the corners (n, 4, 2) of the particles' squares (m), a little larger than they are.

    sizes: (n,) side of each square (m)
    magnify: factor on the displacement that is drawn; above 1 it must be in the frame
    """
    corners = 0.5 * OVERLAP * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    centres = frame.points[:, :2] + (magnify - 1.0) * displacement(frame, magnify)
    return centres[:, None, :] + sizes[:, None, None] * corners


def displacement(frame: Frame, magnify: float = 2.0) -> np.ndarray:
    """Return the displacement (n, 2) of the particles (m); zero when it is not needed.

    Raises FolderError when the run did not write it.
    """
    if magnify == 1.0:
        return np.zeros((len(frame.points), 2))
    if "displacement" not in frame.fields:
        text = "to magnify the motion, write 'displacement' in output.fields of the deck"
        raise FolderError(f"particles.h5: {text}")
    return frame.fields["displacement"][:, :2]


def crack_faces(cracks: Frame, particles: Frame, magnify: float = 1.0) -> list[np.ndarray]:
    """Return for each crack the line around both its faces, shape (2 n, 2), in m.

    The faces lie at half the opening from the crack's line. With `magnify` the line moves with the
    particles around it and the opening grows as they do.
    """
    line = cracks.points[:, :2].astype(float)
    if magnify != 1.0:
        line = line + (magnify - 1.0) * _motion_near(line, particles, magnify)
    opening = cracks.fields.get("opening")
    half = 0.5 * magnify * opening[:, :2] if opening is not None else np.zeros_like(line)
    ends = zip(cracks.offsets[:-1], cracks.offsets[1:], strict=True)
    return [np.vstack([(line + half)[a:b], (line - half)[a:b][::-1]]) for a, b in ends]


def _motion_near(points: np.ndarray, particles: Frame, magnify: float) -> np.ndarray:
    """Return the mean displacement of the particles around places (m)."""
    from scipy.spatial import cKDTree  # late: keeps `cramp --help` fast

    count = min(AROUND, len(particles.points))
    _, near = cKDTree(particles.points[:, :2]).query(points, k=count)
    near = np.asarray(near).reshape(len(points), count)
    return displacement(particles, magnify)[near].mean(axis=1)
