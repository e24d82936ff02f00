"""The XDMF text that tells ParaView and VTK what the HDF5 file holds."""

from xml.sax.saxutils import quoteattr

HEAD = '<?xml version="1.0" encoding="utf-8"?>\n<Xdmf Version="3.0">\n<Domain>\n'
KINDS = {1: "Scalar", 3: "Vector", 9: "Tensor"}


def collection(name: str, grids: list[str]) -> str:
    """Return the whole file: grids over time."""
    opening = f'<Grid Name={quoteattr(name)} GridType="Collection" CollectionType="Temporal">\n'
    return HEAD + opening + "".join(grids) + "</Grid>\n</Domain>\n</Xdmf>\n"


def grid(place: str, frame) -> str:
    """Return one moment.

    place: where its arrays are, as "file.h5:/group"
    """
    fields = [_attribute(place, name, values, frame) for name, values in frame.fields.items()]
    return (
        f'<Grid Name="step {frame.step}" GridType="Uniform">\n<Time Value="{frame.time:.17g}"/>\n'
        + _topology(place, frame)
        + f'<Geometry GeometryType="XYZ">{_item(f"{place}/points", frame.points)}</Geometry>\n'
        + "".join(fields)
        + "</Grid>\n"
    )


def _topology(place: str, frame) -> str:
    """Return one cell per particle, or one polyline per crack."""
    if frame.offsets is None:
        count = size = len(frame.points)
        kind = 'TopologyType="Polyvertex" NodesPerElement="1"'
    else:
        count = len(frame.offsets) - 1
        size = 2 * count + len(frame.points)
        kind = 'TopologyType="Mixed"'
    data = _data(f"{place}/cells", str(size), "Int", 4)
    return f'<Topology {kind} NumberOfElements="{count}">{data}</Topology>\n'


def _attribute(place: str, name: str, values, frame) -> str:
    kind = KINDS[values[0].size if len(values) else 1]
    centre = "Node" if len(values) == len(frame.points) else "Cell"
    data = _item(f"{place}/fields/{name}", values)
    label = f'Name={quoteattr(name)} AttributeType="{kind}" Center="{centre}"'
    return f"<Attribute {label}>{data}</Attribute>\n"


def _item(place: str, values) -> str:
    number = "Float" if values.dtype.kind == "f" else "Int"
    return _data(place, " ".join(map(str, values.shape)), number, values.dtype.itemsize)


def _data(place: str, shape: str, number: str, precision: int) -> str:
    kind = f'NumberType="{number}" Precision="{precision}"'
    return f'<DataItem Format="HDF" {kind} Dimensions="{shape}">{place}</DataItem>'
