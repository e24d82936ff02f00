"""What became of the cracks: how far every end has grown, and the paths at the end of a run."""

from cramp_cli.state.paths import EDGE, PLAIN

ENDED = {EDGE: "left the body", PLAIN: "met another crack"}


def growth_of_ends(model, state) -> list[dict]:
    """Return for every end that has grown how far (m), for which energy (J), and where it is."""
    lines, paths, growth = [], state.paths, state.growth
    for k, length in enumerate(growth.length.tolist()):
        if length > 0.0:
            crack, end = divmod(k, 2)
            x, y = paths.point[paths.start[crack + end] - end].tolist()
            rests = "runs" if growth.speed[k] > 0.0 else "rests"
            lines.append(
                {
                    "crack": model.crack_names[crack],
                    "tip": ("start", "end")[end],
                    "grown": length,
                    "energy": float(growth.energy[k]),
                    "x": x,
                    "y": y,
                    "fate": ENDED.get(int(paths.ends[crack, end]), rests),
                }
            )
    return lines


def path_rows(model, state) -> list[dict]:
    """Return a row of path.csv for every point of every crack."""
    paths, rows = state.paths, []
    for crack, name in enumerate(model.crack_names):
        for number, p in enumerate(range(paths.start[crack], paths.start[crack + 1])):
            (x, y), (X, Y) = paths.point[p].tolist(), paths.origin[p].tolist()
            rows.append({"crack": name, "point": number, "x": x, "y": y, "X": X, "Y": Y})
    return rows
