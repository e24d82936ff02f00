"""Text of 80 columns: the facts of a run and its progress."""

WIDTH = 80
MOST_EXTRAS = 3


def facts_text(title: str, facts: dict[str, object]) -> str:
    """Return a title with a line per fact under it."""
    widest = max(map(len, facts), default=0)
    return "\n".join([title, *(f"  {name:{widest}}  {value}" for name, value in facts.items())])


def progress_head(extra: dict[str, float]) -> str:
    """Return the first line of the table of progress."""
    names = "".join(f" {name[:14]:>14}" for name in list(extra)[:MOST_EXTRAS])
    return f"{'step':>9} {'time (s)':>10} {'%':>4} {'left':>6}{names}"


def progress_line(
    step: int, time: float, done: float, left: float | None, extra: dict[str, float]
) -> str:
    """Return one line of the table of progress.

    done: share of the run; left: seconds to go
    """
    numbers = "".join(f" {number(value):>14}" for value in list(extra.values())[:MOST_EXTRAS])
    return f"{step:9d} {time:10.4g} {100 * done:4.0f} {duration(left):>6}{numbers}"


def duration(seconds: float | None) -> str:
    """Return seconds as people say them: 4.2 s, 42 s, 3m07, 2h15."""
    if seconds is None:
        return ""
    if seconds < 9.95:
        return f"{seconds:.1f} s"
    whole = round(seconds)
    if whole < 100:
        return f"{whole} s"
    if whole < 6000:
        return f"{whole // 60}m{whole % 60:02d}"
    return f"{whole // 3600}h{whole % 3600 // 60:02d}"


def number(value: object) -> str:
    """Return a number with four digits; nothing for None, text as it is."""
    if value is None:
        return ""
    return f"{float(value):.4g}" if hasattr(value, "__float__") else str(value)
