"""Long computations in pieces: here, on many cores or a cluster; kept when they are interrupted.

A task is given to a function, in this process, in threads, or on any executor of
`concurrent.futures` (processes, dask's `Client.get_executor()`, mpi4py's), a few tasks at a time,
so that their number does not matter; results come as they are ready.  A result may call for more
tasks.  With a journal each result is written down when it comes, and read when the same is asked
for again.
"""

from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent import futures
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass, field
from itertools import islice
from pathlib import Path
from typing import Any, Generic, TypeVar

from cap.errors import BadInput
from cap.journal import Journal
from cap.process import as_worker

A = TypeVar("A")
B = TypeVar("B")

AHEAD = 3  # tasks given to each worker, or waiting for it

Tell = Callable[[str, float | None], None]
"""Hears of the progress: what is done, and which part of it, if that is known."""


def within(tell: Tell, begin: float, end: float, before: str = "") -> Tell:
    """Return what hears of one phase, the part from ``begin`` to ``end`` of what ``tell`` hears of.

    ``before`` goes before the words.
    """

    def told(words: str, part: float | None) -> None:
        tell(before + words, None if part is None else begin + (end - begin) * part)

    return told


@dataclass(frozen=True)
class Plan(Generic[A, B]):
    """What a run is about.

    ``key`` names the computation: a journal of another is refused.  ``name`` gives the name of a
    task in the journal, ``encode`` and ``decode`` turn results to strings and back.  ``more`` gives
    the tasks that a result calls for.  ``weight`` is the size of a task, ``total`` that of all;
    with ``words`` the progress is told under this name.

    Our own workers are processes; with ``threads``, where the function releases the interpreter
    lock, they are threads: nothing is loaded again for them, and nothing pickled.  With ``inside``,
    where it writes to arrays, say, it is done by our own workers whatever the executor is.
    """

    key: str = ""
    name: Callable[[A], str] = str
    encode: Callable[[B], str] = str
    decode: Callable[[str], Any] = str
    more: Callable[[A, B], Iterable[A]] = field(default=lambda _task, _result: ())
    weight: Callable[[A], float] = field(default=lambda _task: 1)
    total: float | None = None
    words: str = ""
    threads: bool = False
    inside: bool = False


@dataclass
class Runner:
    """How tasks are done: on which executor (None: ``jobs`` workers of our own, or here if 1).

    ``journal``: where results are kept.  After ctrl-C what is done is kept, ``interrupted`` is set,
    and no other task begins; with ``whole``, `KeyboardInterrupt` is raised (the journal has what is
    done).  Processes of our own end at once, threads and an executor finish what they have begun.
    ``jobs`` is the number of workers of an executor that does not tell it.
    """

    jobs: int = 1
    tell: Tell = field(default=lambda _words, _part: None)
    executor: futures.Executor | None = None
    journal: Path | None = None
    whole: bool = False
    interrupted: bool = False

    def run(
        self, function: Callable[[A], B], tasks: Iterable[A], plan: Plan[A, B]
    ) -> Iterator[tuple[A, B]]:
        """Give (task, result) as they come; fewer after an interrupt.

        What ``function`` raises is raised.  Raises `BadInput` if a process dies, or for a journal
        that cannot be used.
        """
        if self.interrupted:
            return
        with self.keeping(), self._memo(plan) as memo, self._pool(plan) as pool:
            try:
                yield from _Run(self, pool, memo, plan).results(function, tasks)
            except futures.BrokenExecutor:
                raise BadInput(
                    "a process was killed: ask for less, or for fewer --jobs (what a journal has "
                    "is kept)"
                ) from None

    def map(
        self, function: Callable[[A], B], tasks: Sequence[A], words: str, *, processes: bool = False
    ) -> list[B]:
        """Return the results of the tasks in their order; after an interrupt only the first ones.

        In threads, unless ``processes``.
        """
        done: dict[int, B] = {}
        here = not processes
        plan = Plan[tuple[int, A], B](words=words, total=len(tasks), threads=here, inside=here)
        with self.keeping():
            for (k, _), result in self.run(_Second(function), enumerate(tasks), plan):
                done[k] = result
        first = next((k for k in range(len(tasks)) if k not in done), len(tasks))
        return [done[k] for k in range(first)]

    @contextmanager
    def keeping(self) -> Iterator[None]:
        """Note an interrupt of what is inside, and go on after it."""
        try:
            yield
        except KeyboardInterrupt:
            self.interrupted = True
            if self.whole:
                raise

    def _memo(self, plan: Plan[A, B]) -> Any:
        return nullcontext() if self.journal is None else Journal(self.journal, plan.key)

    def _pool(self, plan: Plan[A, B]) -> Any:
        """Return what gives the executor; threads and processes of our own end with it."""
        if self.executor is not None and not plan.inside:
            return nullcontext(self.executor)
        if self.jobs == 1 or (plan.total is not None and plan.total < 2):
            return nullcontext()
        return futures.ThreadPoolExecutor(self.jobs) if plan.threads else _processes(self.jobs)


@dataclass(frozen=True)
class _Second(Generic[A, B]):
    """A function of the second of a pair."""

    function: Callable[[A], B]

    def __call__(self, pair: tuple[int, A]) -> B:
        return self.function(pair[1])


@dataclass(frozen=True)
class _Written(Generic[A, B]):
    """A function, and its result as a string if that is asked for: both are the worker's work."""

    function: Callable[[A], B]
    encode: Callable[[B], str] | None

    def __call__(self, task: A) -> tuple[B, str | None]:
        result = self.function(task)
        return result, self.encode(result) if self.encode else None


@contextmanager
def _processes(jobs: int) -> Iterator[futures.Executor]:
    """Give fresh processes; after an error they end at once, though a task may take minutes."""
    import multiprocessing  # noqa: PLC0415 (slow to load)

    others = multiprocessing.active_children()
    pool = futures.ProcessPoolExecutor(jobs, multiprocessing.get_context("spawn"), as_worker)
    try:
        yield pool
    except BaseException:
        for child in multiprocessing.active_children():
            if child not in others:
                child.terminate()
        raise
    finally:
        pool.shutdown(cancel_futures=True)


class _Run(Generic[A, B]):
    """One run: the tasks that wait, those in work, and what is done."""

    def __init__(
        self, runner: Runner, pool: futures.Executor | None, memo: Journal | None, plan: Plan[A, B]
    ) -> None:
        self.runner, self.pool, self.memo, self.plan = runner, pool, memo, plan
        self.working: dict[futures.Future[tuple[B, str | None]], A] = {}
        self.extra: deque[A] = deque()
        self.done = 0.0

    def results(self, function: Callable[[A], B], tasks: Iterable[A]) -> Iterator[tuple[A, B]]:
        """Give the results."""
        waiting = iter(tasks)
        work = _Written(function, self.plan.encode if self.memo else None)
        try:
            while True:
                yield from self._begin(work, waiting)
                if not self.working:
                    return
                finished, _ = futures.wait(self.working, return_when=futures.FIRST_COMPLETED)
                for future in finished:
                    yield self._kept(self.working.pop(future), future.result())
        finally:
            for future in self.working:
                future.cancel()

    def _begin(self, work: "_Written[A, B]", waiting: Iterator[A]) -> Iterator[tuple[A, B]]:
        """Give tasks to the executor while there is room; do them here if there is none."""
        while len(self.working) < self._room():
            found = self._next(waiting)
            if not found:
                return
            (task,) = found
            known = self.memo.get(self.plan.name(task)) if self.memo else None
            if known is not None:
                yield self._finish(task, self.plan.decode(known))
            elif self.pool is None:
                yield self._kept(task, work(task))
            else:
                self.working[self.pool.submit(work, task)] = task

    def _next(self, waiting: Iterator[A]) -> list[A]:
        """Return the next task, if there is one; those that results call for come first."""
        return [self.extra.popleft()] if self.extra else list(islice(waiting, 1))

    def _room(self) -> int:
        """Return how many tasks may be in work, or wait for it."""
        if self.pool is None:
            return 1
        workers = getattr(self.pool, "_max_workers", None) or self.runner.jobs
        return AHEAD * max(workers, self.runner.jobs)

    def _kept(self, task: A, done: tuple[B, str | None]) -> tuple[A, B]:
        """Write a result to the journal, and note it."""
        result, text = done
        if self.memo and text is not None:
            self.memo.put(self.plan.name(task), text)
        return self._finish(task, result)

    def _finish(self, task: A, result: B) -> tuple[A, B]:
        """Note a result, and the tasks that it calls for."""
        self.extra.extend(self.plan.more(task, result))
        self.done += self.plan.weight(task)
        if self.plan.words:
            total = self.plan.total
            self.runner.tell(self.plan.words, self.done / total if total else None)
        return task, result
