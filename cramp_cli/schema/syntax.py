"""What is wrong with a text that is no YAML: in our words, those of the library behind them."""

from typing import NamedTuple


class Fault(NamedTuple):
    """Line and column, from 1, and what is wrong there."""

    line: int
    column: int
    message: str


def fault_of(text: str, problem: Exception) -> Fault:
    """Return a scanner's complaint (yaml.YAMLError) as one fault of the text with its place."""
    at = getattr(problem, "problem_mark", None) or getattr(problem, "context_mark", None)
    line, column = (at.line + 1, at.column + 1) if at else (1, 1)
    lines = text.split("\n")
    if line > len(lines):
        line, column = len(lines), len(lines[-1]) + 1
    here = lines[line - 1]
    if "\t" in here[: len(here) - len(here.lstrip())]:
        return Fault(line, here.index("\t") + 1, "tab used for indentation; use spaces")
    message = f"not valid YAML{_hint(here, column, text, problem)}{_said(problem)}"
    return Fault(line, column, message)


def _hint(here: str, column: int, text: str, problem: Exception) -> str:
    """Return what is probably amiss at a column of a line, or nothing."""
    if here[column - 1 : column] == ":" and ": " in here[: column - 1]:
        return ": a value that holds ': ' must stand in quotes"
    began = getattr(problem, "context_mark", None)
    opener = _letter(text, began) if began else ""
    if opener and opener in "[{\"'":
        return f": what begins with {opener} in line {began.line + 1} is not closed rightly"
    return ""


def _letter(text: str, mark) -> str:
    lines = text.split("\n")
    return lines[mark.line][mark.column : mark.column + 1] if mark.line < len(lines) else ""


def _said(problem: Exception) -> str:
    """Return the library's own words, in brackets."""
    words = [getattr(problem, key, None) for key in ("problem", "context")]
    words = " ".join(word for word in words if word)
    return f" ({words})" if words else ""
