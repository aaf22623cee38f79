"""Long computations in pieces: on several cores, with progress, and kept when interrupted."""

import multiprocessing
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import (
    BrokenExecutor,
    Executor,
    Future,
    ProcessPoolExecutor,
    ThreadPoolExecutor,
)
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import islice
from typing import TypeVar

from cap.command.entry import as_worker
from cap.errors import BadInput

A = TypeVar("A")
B = TypeVar("B")

PIECE = 500  # orbits: few enough that `cap.floats.swarm` follows them in one thread
KEPT = 500_000  # orbits x periods of a piece: half a second; all these states have room
AHEAD = 4  # pieces that wait for each core: an interrupt waits only for those begun


@dataclass
class Work:
    """How the pieces of a computation are done; ``tell`` hears what is done, and which part.

    After ctrl-C the pieces that are done are kept, ``interrupted`` is set, and no other piece
    begins: arrays stay as they were prepared.
    """

    jobs: int = 1
    tell: Callable[[str, float], None] = field(default=lambda _words, _part: None)
    interrupted: bool = False

    @contextmanager
    def keeping(self) -> Iterator[None]:
        """Note an interrupt of what is inside, and go on after it."""
        try:
            yield
        except KeyboardInterrupt:
            self.interrupted = True

    def map(
        self, function: Callable[[A], B], tasks: Sequence[A], words: str, *, processes: bool = False
    ) -> list[B]:
        """Return the results of the tasks in their order; fewer after an interrupt.

        Compiled code runs in threads.  With ``processes``, ``function`` and tasks are pickled.
        """
        done: list[B] = []
        with self.keeping():
            if self.interrupted:
                return done
            if self.jobs == 1 or len(tasks) < 2:
                for task in tasks:
                    done.append(function(task))
                    self.tell(words, len(done) / len(tasks))
            else:
                self._in_parallel(function, tasks, words, done, self._pool(processes))
        return done

    def pieces(
        self, count: int, function: Callable[[slice], None], words: str, periods: int
    ) -> None:
        """Call ``function`` for slices of ``count`` orbits, each at most `PIECE` long.

        And so short that ``periods`` of them take less than a second.
        """
        length = max(1, min(PIECE, KEPT // periods))

        def piece(k: int) -> None:
            function(slice(k, min(k + length, count)))

        self.map(piece, range(0, count, length), words)

    def _pool(self, processes: bool) -> Executor:
        if not processes:
            return ThreadPoolExecutor(self.jobs)
        fresh = multiprocessing.get_context("spawn")
        return ProcessPoolExecutor(self.jobs, fresh, as_worker)

    def _in_parallel(
        self,
        function: Callable[[A], B],
        tasks: Sequence[A],
        words: str,
        done: list[B],
        pool: Executor,
    ) -> None:
        futures, rest = deque[Future[B]](), iter(tasks)
        others = multiprocessing.active_children()
        try:
            while len(done) < len(tasks):
                for task in islice(rest, AHEAD * self.jobs - len(futures)):
                    futures.append(pool.submit(function, task))
                done.append(futures.popleft().result())
                self.tell(words, len(done) / len(tasks))
        except BrokenExecutor:
            raise BadInput("a process was killed: ask for less, or for fewer --jobs") from None
        except KeyboardInterrupt:
            for child in multiprocessing.active_children():
                if child not in others:  # a piece may take minutes
                    child.terminate()
            raise
        finally:
            pool.shutdown(cancel_futures=True)
