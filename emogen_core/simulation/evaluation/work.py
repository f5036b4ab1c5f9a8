"""Runs shared out to processes; the numbers do not depend on how many there are, nor on which does what."""

from __future__ import annotations

import signal
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from contextlib import closing, contextmanager
from dataclasses import dataclass
from multiprocessing import get_context
from threading import current_thread, main_thread
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

from threadpoolctl import threadpool_limits

from emogen_core.errors import WorkerError
from emogen_core.simulation.runs import chunks, joined

if TYPE_CHECKING:
    from collections.abc import Callable, Generator, Iterable, Iterator, Mapping, Sequence

    from emogen_core.simulation.evaluation.laboratory import Laboratory
    from emogen_core.simulation.evaluation.specs import RunSpec
    from emogen_core.simulation.runs import Elites

    Progress = Callable[[int, int], None]

T = TypeVar("T")
T_co = TypeVar("T_co", covariant=True)


class Maker(Protocol[T_co]):
    """What makes one chunk of a run: a laboratory, or something that looks closer at its searches."""

    def chunk(self, spec: RunSpec, number: int, searches: int, /) -> T_co:
        """Return what came of a chunk."""
        ...


@dataclass(frozen=True)
class Task:
    """One chunk of one run."""

    spec: RunSpec
    number: int
    searches: int


def tasks(specs: Iterable[RunSpec], repetitions: int) -> list[Task]:
    """Return the chunks of runs; equal runs are made once."""
    different = {spec.key: spec for spec in specs}.values()
    return [Task(spec, number, searches) for spec in different for number, searches in chunks(repetitions, spec.chunk)]


class Engine(Protocol):
    """What makes tasks, here or elsewhere, in any order."""

    def run(self, maker: Maker[T], todo: Sequence[Task]) -> Generator[tuple[Task, T], None, None]:
        """Yield every task with what came of it, as it is done; stop the rest when closed.

        Raises:
            WorkerError: a process that shares the work is gone.
        """
        ...


class Serial:
    """Makes them here, one after the other."""

    def run(self, maker: Maker[T], todo: Sequence[Task]) -> Generator[tuple[Task, T], None, None]:
        """Yield every task with what came of it."""
        with _one_thread():
            for task in todo:
                yield task, maker.chunk(task.spec, task.number, task.searches)


SERIAL = Serial()


@dataclass(frozen=True)
class Processes:
    """Shares them out to processes of this machine."""

    workers: int

    def run(self, maker: Maker[T], todo: Sequence[Task]) -> Generator[tuple[Task, T], None, None]:
        """Yield every task with what came of it, as it is done; stop the rest when closed.

        Raises:
            WorkerError: a process was ended from outside.
        """
        pool = ProcessPoolExecutor(self.workers, get_context("spawn"), _enter, (maker,))
        try:
            with _uninterrupted():
                waiting = {pool.submit(_work, task): task for task in todo}
            for future in as_completed(waiting):
                yield waiting.pop(future), future.result()
        except BrokenProcessPool as error:
            raise WorkerError(
                "A process that simulates was ended from outside, most likely because memory ran out."
                " Run again with fewer --workers, or with more memory."
            ) from error
        finally:
            pool.shutdown(cancel_futures=True)


def engine(workers: int) -> Engine:
    """Return what makes tasks with as many processes."""
    return SERIAL if workers == 1 else Processes(workers)


def make(
    laboratory: Laboratory,
    specs: Iterable[RunSpec],
    repetitions: int,
    engine: Engine = SERIAL,
    progress: Progress = lambda _done, _all: None,
) -> dict[str, Elites]:
    """Return the elites of runs by their keys.

    Args:
        laboratory: where they are made.
        specs: the runs.
        repetitions: searches a run.
        engine: what does the work; the numbers do not depend on it.
        progress: told after every chunk how many are done, of how many.

    Raises:
        WorkerError: a process that shares the work is gone.
    """
    made = parts(laboratory, specs, repetitions, engine, progress)
    return {key: joined(chunks) for key, chunks in made.items()}


def parts(
    maker: Maker[T],
    specs: Iterable[RunSpec],
    repetitions: int,
    engine: Engine = SERIAL,
    progress: Progress = lambda _done, _all: None,
) -> Mapping[str, list[T]]:
    """Return what came of the chunks of runs, in their order, by the runs' keys; as `make`, for any maker.

    Raises:
        WorkerError: a process that shares the work is gone.
    """
    todo = tasks(specs, repetitions)
    done: dict[str, dict[int, T]] = {}
    with closing(engine.run(maker, todo)) as made:
        for count, (task, part) in enumerate(made, 1):
            done.setdefault(task.spec.key, {})[task.number] = part
            progress(count, len(todo))
    return {key: [chunks[at] for at in sorted(chunks)] for key, chunks in done.items()}


@contextmanager
def _uninterrupted() -> Iterator[None]:
    """Put Ctrl-C off while processes start: who is half started cannot be ended.

    They inherit the mask, so they never see it themselves; the pool ends them.
    """
    if current_thread() is not main_thread():
        yield
        return
    pressed: list[int] = []
    handler = signal.signal(signal.SIGINT, lambda number, _: pressed.append(number))
    mask = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)
        signal.signal(signal.SIGINT, handler)
    if pressed:
        raise KeyboardInterrupt


def _one_thread() -> threadpool_limits:
    """Keep the algebra library to one thread: the products are small, and several only get in each other's way."""
    return threadpool_limits(1)


_here: list[Maker[Any]] = []
"""The maker of a process of the pool: handed over once, not with every task."""


def _enter(maker: Maker[Any]) -> None:
    _one_thread()
    _here[:] = [maker]


def _work(task: Task) -> Any:
    return _here[0].chunk(task.spec, task.number, task.searches)
