"""Tasks of a long proof in several processes, phase by phase, and how far all of it is."""

from __future__ import annotations

import multiprocessing
import signal
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from itertools import takewhile
from typing import Any

from cap.checker.kernel.rounding import in_doubles

Tell = Callable[[str, float], None]
"""Hears what is done now, and which part of the whole proof is done."""

_done = list[Callable[[Any], Any]]()  # in a process that helps: what it does


class Work:
    """The tasks of a proof, in so many processes.

    ``phases``: what is done, in words, in this order, each with the sum of the weights of its
    tasks, which tell how long they may take.
    """

    def __init__(self, jobs: int, tell: Tell, phases: Mapping[str, float]) -> None:
        self.jobs, self.tell, self.phases = jobs, tell, phases

    def __call__(
        self,
        f: Callable[[Any], Any],
        tasks: Iterable[Any],
        words: str,
        weight: Callable[[Any], float] = lambda _task: 1,
    ) -> list[Any]:
        """Do the tasks of a phase."""
        waiting, found, done = list(tasks), list[Any](), 0.0
        before = sum(self.phases[name] for name in takewhile(words.__ne__, self.phases))
        whole = sum(self.phases.values()) or 1.0
        self.tell(words, before / whole)
        for task, result in zip(waiting, each(self.jobs, f, waiting), strict=True):
            found.append(result)
            done = min(done + weight(task), self.phases[words])
            self.tell(words, (before + done) / whole)
        return found


def each(jobs: int, f: Callable[[Any], Any], tasks: Sequence[Any]) -> Iterator[Any]:
    """Do tasks in so many processes, in order; f, with all that it knows, goes to each once.

    In each of them, before and after a task, doubles are those of IEEE 754 (``rounding``).
    """
    if jobs < 2:
        yield from map(in_doubles()(f), tasks)
        return
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(jobs, context, _begin, (f,)) as pool:
        yield from pool.map(_do, tasks, chunksize=1 + len(tasks) // (64 * jobs))


def _begin(f: Callable[[Any], Any]) -> None:
    """Prepare a process; ctrl-C is for the one that asks."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    _done[:] = [in_doubles()(f)]


def _do(task: Any) -> Any:
    """Do a task."""
    return _done[0](task)
