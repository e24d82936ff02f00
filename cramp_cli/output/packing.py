"""Records of arrays <-> groups of HDF5, bit for bit, whatever fields the records have.

A record (NamedTuple or dataclass), a tuple, a list or a dictionary becomes a group; an array a
dataset; a number, a text or None an attribute. What is read takes its types from a record that is
like it, so nothing in a file can name code.
"""

from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np

from cramp_cli.output.exits import FolderError

PLAIN = (bool, int, float, str, np.generic)


class PackingError(FolderError):
    """A file does not hold the fields that this program keeps."""


def pack(group, record: Any, place: str = "") -> None:
    """Write all fields of a record into an empty group.

    place: what the record is called in messages; raises TypeError for what no group can hold
    """
    import h5py  # late: keeps `cramp --help` fast

    parts = parts_of(record)
    if parts is None:
        raise TypeError(f"{place or 'state'}: a {type(record).__name__} can not be kept")
    for name, value in parts.items():
        if isinstance(value, np.ndarray):
            group.create_dataset(name, data=value)
        elif value is None:
            group.attrs[name] = h5py.Empty("f")
        elif isinstance(value, PLAIN):
            group.attrs[name] = value
        else:
            pack(group.create_group(name), value, f"{place}.{name}".strip("."))


def unpack(group, like: Any, place: str = "") -> Any:
    """Return the record that a group holds, of the types of `like`.

    Arrays may be longer or shorter than those of `like`. Raises PackingError when a field is
    missing, unknown or of another kind.
    """
    names = set(group) | set(group.attrs)
    if not _is_record(like):
        return _collection(like, {name: _value(group, name, None, place) for name in names})
    parts = parts_of(like)
    for name in sorted(names ^ set(parts)):
        what = "lacks" if name in parts else "has an unknown"
        raise PackingError(f"{what} field {place}.{name}".replace(" .", " "))
    found = {name: _value(group, name, value, place) for name, value in parts.items()}
    return type(like)(**found)


def size_of(record: Any) -> tuple[int, int]:
    """Return the bytes of all arrays of a record, and the number of its arrays and groups."""
    if isinstance(record, np.ndarray):
        return record.nbytes, 1
    sizes = [size_of(part) for part in (parts_of(record) or {}).values()]
    return sum(size for size, _ in sizes), 1 + sum(count for _, count in sizes)


def parts_of(record: Any) -> dict[str, Any] | None:
    """Return the parts of a record or collection by name, None if it is neither."""
    if isinstance(record, dict):
        return {str(name): value for name, value in record.items()}
    if hasattr(record, "_asdict"):
        return record._asdict()
    if is_dataclass(record):
        return {f.name: getattr(record, f.name) for f in fields(record)}
    if isinstance(record, list | tuple):
        return {str(place): value for place, value in enumerate(record)}
    return None


def _is_record(like: Any) -> bool:
    return hasattr(like, "_asdict") or is_dataclass(like)


def _collection(like: Any, found: dict) -> Any:
    if isinstance(like, list | tuple):
        return type(like)(found[str(place)] for place in range(len(found)))
    return found


def _value(group, name: str, like: Any, place: str) -> Any:
    import h5py

    where = f"{place}.{name}".strip(".")
    if name in group.attrs:
        value = group.attrs[name]
        if isinstance(value, h5py.Empty):
            return None
        return value.item() if isinstance(value, np.generic) else value
    if hasattr(group[name], "dtype"):
        return _array(group[name][()], like, where)
    return unpack(group[name], like, where)


def _array(values: np.ndarray, like: Any, where: str) -> np.ndarray:
    if isinstance(like, np.ndarray):
        known, found = (like.dtype, like.shape[1:]), (values.dtype, values.shape[1:])
        if known != found:
            told = f"{where} holds {found[0]} of shape (n, {found[1]})"
            raise PackingError(f"{told} in place of {known[0]} of shape (n, {known[1]})")
    return values
