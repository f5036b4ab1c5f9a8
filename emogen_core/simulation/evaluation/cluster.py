"""Runs shared out to a Dask cluster: the same chunks and seeds, so the same numbers, on as many machines as there are.

Dask is an extra of the package (`emogen-study[dask]`); the workers need this package too, in the same version.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any, TypeVar

from emogen_core.errors import EmogenError, WorkerError

if TYPE_CHECKING:
    from collections.abc import Generator, Sequence

    from emogen_core.simulation.evaluation.work import Maker, Task

T = TypeVar("T")

PATIENCE = "4s"
"""How long a scheduler, or a first worker, may take to answer."""


class DaskCluster:
    """A scheduler to which work is sent. Close it when done."""

    def __init__(self, address: str) -> None:
        """Connect.

        Args:
            address: of the scheduler, for example ``tcp://localhost:8786``.

        Raises:
            EmogenError: Dask is not installed, or nobody answers.
        """
        self._dask = _distributed()
        try:
            self._client = self._dask.Client(address, timeout=PATIENCE)
        except (OSError, ValueError) as error:
            raise EmogenError(f"No Dask scheduler answers at {address}: {error}.") from error

    def run(self, maker: Maker[T], todo: Sequence[Task]) -> Generator[tuple[Task, T], None, None]:
        """Yield every task with what came of it, as it is done; stop the rest when closed.

        Raises:
            WorkerError: there is no worker, workers die of a task, or the scheduler is gone.
        """
        try:
            there = self._client.scatter(maker, broadcast=True, hash=False)
            waiting = {self._client.submit(_work, there, task, pure=False): task for task in todo}
            for future in self._dask.as_completed(list(waiting)):
                yield waiting.pop(future), future.result()
        except (OSError, self._dask.CancelledError, self._dask.KilledWorker) as error:
            raise WorkerError(
                f"The Dask cluster does not go on ({error}). See that its scheduler and workers run and that"
                " no worker runs out of memory, then run again."
            ) from error

    def close(self) -> None:
        """End the connection; the cluster stays."""
        self._client.close()


def _distributed() -> Any:
    # An extra, without types of its own.
    try:
        return importlib.import_module("dask.distributed")
    except ImportError as error:
        raise EmogenError("Dask is not installed: pip install 'emogen-study[dask]'.") from error


def _work(maker: Maker[T], task: Task) -> T:
    return maker.chunk(task.spec, task.number, task.searches)
