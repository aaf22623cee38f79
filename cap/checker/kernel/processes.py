"""Tasks of a long proof in several processes."""

from __future__ import annotations

import multiprocessing
from collections.abc import Callable, Iterable
from concurrent.futures import ProcessPoolExecutor
from typing import Any

from cap.checker.kernel.rounding import in_doubles

_done = list[Callable[[Any], Any]]()  # in a process that helps: what it does


def each(jobs: int, f: Callable[[Any], Any], tasks: Iterable[Any]) -> list[Any]:
    """Do tasks in so many processes; f, with all that it knows, goes to each of them once.

    In each of them, before and after a task, doubles are those of IEEE 754 (``rounding``).
    """
    if jobs < 2:
        return list(map(in_doubles()(f), tasks))
    waiting, context = list(tasks), multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(jobs, context, _begin, (f,)) as pool:
        return list(pool.map(_do, waiting, chunksize=1 + len(waiting) // (64 * jobs)))


def _begin(f: Callable[[Any], Any]) -> None:
    """Prepare a process."""
    _done[:] = [in_doubles()(f)]


def _do(task: Any) -> Any:
    """Do a task."""
    return _done[0](task)
