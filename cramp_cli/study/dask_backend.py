"""Cases on the workers of a dask scheduler that runs already; all see one file system."""

from collections.abc import Callable, Sequence

from cramp_cli.output.exits import FolderError
from cramp_cli.study.cases import Case
from cramp_cli.study.one_case import Sweep, take_up
from cramp_cli.study.outcome import Outcome, SweepFolder

LOST = 10  # workers that may be lost under one case before it is given up


def run_on_dask(
    sweep: Sweep, cases: Sequence[Case], address: str, tell: Callable[[Case, Outcome], None]
) -> None:
    """Run cases on the workers of a scheduler, and tell each outcome as it comes.

    A case whose worker is lost goes to another one, which waits for the run if that goes on.
    Raises FolderError when dask is not installed or nobody answers at the address.
    """
    (sweep.folder.path / "runs").mkdir(parents=True, exist_ok=True)
    here = sweep._replace(
        deck=sweep.deck.absolute(), cases=(), folder=SweepFolder(sweep.folder.path.absolute())
    )
    with _client(address) as client:
        from distributed import as_completed

        futures = {client.submit(take_up, here, case, key=case.name): case for case in cases}
        for future in as_completed(futures):
            future.result()
            tell(futures[future], sweep.folder.outcome(futures[future].name))


def _client(address: str):
    try:
        from distributed import Client
    except ImportError:
        told = "--backend dask needs dask; install it with: pip install 'cramp[dask]'"
        raise FolderError(told) from None
    try:
        client = Client(address, timeout="10s")
    except (OSError, ValueError) as error:
        raise FolderError(f"--scheduler {address}: no dask scheduler answers ({error})") from None
    from dask import config

    config.set({"distributed.scheduler.allowed-failures": LOST})
    return client
