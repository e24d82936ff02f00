"""The program `cramp`, also as ``python -m cramp_cli``: obey the words, end with the right code."""

import atexit
import gc
import sys

import typer

from cramp_cli.cli.app import app
from cramp_cli.cli.words import Settings
from cramp_cli.streams import mend_streams, mute_stdout


def main(words: list[str] | None = None) -> int:
    """Run the command line; return the exit code."""
    gc.set_threshold(100_000)  # a start makes next to no garbage; looking for it takes a tenth
    atexit.register(gc.freeze)  # nor is there a need to look for it at the end: 0.2 s
    settings = Settings()
    mend_streams()
    try:
        code = _obey(sys.argv[1:] if words is None else words, settings)
        sys.stdout.flush()
    except BrokenPipeError:  # the reader of our output has seen enough
        mute_stdout()
        return 0
    except (Exception, KeyboardInterrupt) as error:
        return _explain(error, settings.verbosity)
    return code


def _obey(words: list[str], settings: Settings) -> int:
    if not {"--help", "--version"} & set(words):
        from cramp_cli.output.machine import refuse_little_memory

        refuse_little_memory()
    command = typer.main.get_command(app)
    try:
        with command.make_context("cramp", list(words), obj=settings) as context:
            command.invoke(context)
    except typer.Exit as end:
        return end.exit_code
    return 0


def _explain(error: BaseException, verbosity: int) -> int:
    """Say in a line what went wrong and return the exit code that says the same."""
    from cramp_cli.output.exits import DECK, INTERNAL, USAGE, exit_code, one_line

    code = exit_code(error)
    if code == USAGE:
        error.show()
        return code
    notes = [f"({note})" for note in getattr(error, "__notes__", [])]
    if code == INTERNAL and verbosity < 2 and not notes:
        notes = ["(cramp -v shows more)"]
    first = "" if code == DECK else "cramp: "
    print(first + " ".join([one_line(error), *notes]), file=sys.stderr)
    if code == INTERNAL and verbosity > 1:
        import traceback

        traceback.print_exception(error)
    return code


if __name__ == "__main__":
    sys.exit(main())
