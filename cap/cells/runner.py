"""Long computations in pieces: here, on many cores or a cluster; kept when they are interrupted.

One runner for all: it knows nothing of cells.  A task is given to a function, on any executor of
`concurrent.futures` (processes, threads, dask's `Client.get_executor()`, mpi4py's), a few tasks at
a time, so that their number does not matter; results come as they are ready.  A result may call for
more tasks.  With a journal each result is written down when it comes, and read when the same is
asked for again.
"""

import multiprocessing
import signal
import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    Executor,
    Future,
    ProcessPoolExecutor,
    wait,
)
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Generic, TypeVar

from cap.cells.journal import Journal, Memo, Nothing
from cap.errors import BadInput

A = TypeVar("A")
B = TypeVar("B")

AHEAD = 3  # tasks given to each worker, or waiting for it


@dataclass(frozen=True, slots=True)
class Progress:
    """How far it is: what is done, of how much (None: not known), in how many seconds.

    ``before`` of what is done was in the journal.
    """

    done: float
    total: float | None
    seconds: float
    before: float = 0

    @property
    def left(self) -> float | None:
        """An estimate of the seconds left, None if there is none yet."""
        fresh = self.done - self.before
        if self.total is None or fresh <= 0:
            return None
        return self.seconds * (self.total - self.done) / fresh

    def __str__(self) -> str:
        if self.total is None:
            return f"{self.done:.6g} done in {_duration(self.seconds)}"
        part = 100 * self.done / self.total if self.total else 100
        left = "" if self.left is None else f", about {_duration(self.left)} left"
        return f"{self.done:.6g} of {self.total:.6g} done ({part:.0f} %){left}"


def _duration(seconds: float) -> str:
    if seconds < 100:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 6000 else f"{seconds / 3600:.1f} h"


@dataclass
class Runner:
    """How tasks are done: on which executor (None: ``jobs`` processes, or here if that is 1).

    ``journal``: where results are kept; ``tell`` hears of the progress.  After ctrl-C what is done
    is kept, ``interrupted`` is set, and no other task begins.
    """

    jobs: int = 1
    executor: Executor | None = None
    journal: Path | None = None
    tell: Callable[[Progress], None] = field(default=lambda _progress: None)
    interrupted: bool = False

    def run(
        self, function: Callable[[A], B], tasks: Iterable[A], plan: "Plan[A, B]"
    ) -> Iterator[tuple[A, B]]:
        """Give (task, result) as they come; fewer after an interrupt.

        For processes and clusters, ``function``, tasks and results are pickled.  What ``function``
        raises is raised.
        """
        with self._memo(plan) as memo, self._pool() as pool:
            yield from _Run(self, pool, memo, plan).results(function, tasks)

    def _memo(self, plan: "Plan[A, B]") -> Any:
        return Nothing() if self.journal is None else Journal(self.journal, plan.key)

    @contextmanager
    def _pool(self) -> Iterator[Executor | None]:
        """Give the executor; processes of our own end with it."""
        if self.executor is not None or self.jobs == 1:
            yield self.executor
            return
        fresh = multiprocessing.get_context("spawn")
        pool = ProcessPoolExecutor(self.jobs, fresh, signal.signal, (signal.SIGINT, signal.SIG_IGN))
        try:
            yield pool
        except BaseException:
            _stop(pool)
            raise
        finally:
            pool.shutdown(cancel_futures=True)


def _stop(pool: ProcessPoolExecutor) -> None:
    """End the processes of a pool of our own: a task may take minutes."""
    for process in list((pool._processes or {}).values()):  # noqa: SLF001 (nothing else knows them)
        process.terminate()


@dataclass(frozen=True)
class Plan(Generic[A, B]):
    """What a run is about.

    ``key`` names the computation: a journal of another is refused.  ``name`` gives the name of a
    task in the journal, ``encode`` and ``decode`` turn results to strings and back.  ``more`` gives
    the tasks that a result calls for.  ``weight`` is the size of a task, ``total`` that of all.
    """

    key: str = ""
    name: Callable[[A], str] = str
    encode: Callable[[B], str] = str
    decode: Callable[[str], Any] = str
    more: Callable[[A, B], Iterable[A]] = field(default=lambda _task, _result: ())
    weight: Callable[[A], float] = field(default=lambda _task: 1)
    total: float | None = None


class _Run(Generic[A, B]):
    """One run: the tasks that wait, those in work, and what is done."""

    def __init__(self, runner: Runner, pool: Executor | None, memo: Memo, plan: Plan[A, B]) -> None:
        self.runner, self.pool, self.memo, self.plan = runner, pool, memo, plan
        self.working: dict[Future[B], A] = {}
        self.extra: deque[A] = deque()
        self.done, self.before, self.began = 0.0, 0.0, time.monotonic()

    def results(self, function: Callable[[A], B], tasks: Iterable[A]) -> Iterator[tuple[A, B]]:
        """Give the results."""
        waiting = iter(tasks)
        try:
            while True:
                yield from self._begin(function, waiting)
                if not self.working:
                    return
                finished, _ = wait(self.working, return_when=FIRST_COMPLETED)
                for future in finished:
                    yield self._finish(self.working.pop(future), future.result())
        except KeyboardInterrupt:
            self.runner.interrupted = True
        except BrokenExecutor:
            raise BadInput("a process that worked on a task died: too little memory?") from None
        finally:
            for future in self.working:
                future.cancel()

    def _begin(self, function: Callable[[A], B], waiting: Iterator[A]) -> Iterator[tuple[A, B]]:
        """Give tasks to the executor while there is room; do them here if there is none."""
        while len(self.working) < self._room():
            found = self._next(waiting)
            if not found:
                return
            (task,) = found
            known = self.memo.get(self.plan.name(task))
            if known is not None:
                self.before += self.plan.weight(task)
                yield self._finish(task, self.plan.decode(known), fresh=False)
            elif self.pool is None:
                yield self._finish(task, function(task))
            else:
                self.working[self.pool.submit(function, task)] = task

    def _next(self, waiting: Iterator[A]) -> tuple[A, ...]:
        if self.extra:
            return (self.extra.popleft(),)
        return tuple([task for task, _ in zip(waiting, range(1), strict=False)])

    def _room(self) -> int:
        """Return how many tasks may be in work, or wait for it."""
        if self.pool is None:
            return 1
        workers = getattr(self.pool, "_max_workers", None) or self.runner.jobs
        return AHEAD * max(workers, self.runner.jobs)

    def _finish(self, task: A, result: B, *, fresh: bool = True) -> tuple[A, B]:
        """Note a result."""
        if fresh:
            self.memo.put(self.plan.name(task), self.plan.encode(result))
        self.extra.extend(self.plan.more(task, result))
        self.done += self.plan.weight(task)
        seconds = time.monotonic() - self.began
        self.runner.tell(Progress(self.done, self.plan.total, seconds, self.before))
        return task, result
