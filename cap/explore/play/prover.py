"""A proof in a process of its own: it tells how far it is, and can be stopped at any time.

The process ends with the one that began it, however that ends.
"""

import multiprocessing
import os
import signal
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from multiprocessing.connection import Connection
from threading import Thread
from typing import Any, NamedTuple

from cap.errors import BadInput, NotProved
from cap.process import as_worker

PATIENCE = 1.0  # seconds that a process has to end
SELDOM = 0.1  # seconds between two words of progress


Tell = Callable[[str], None]
Prove = Callable[[str, dict[str, Any], Tell], Any]  # returns a `cap.Verified`


class News(NamedTuple):
    """What a proof tells: ``kind`` is progress, proved, not proved, bad input or failed."""

    kind: str
    words: str
    name: str = ""
    certificate: bytes = b""


class Proof:
    """The proof of a theorem, which begins at once.

    ``options`` are those of `prove_theorem`; with ``prove`` those of that function, of a module.
    """

    def __init__(
        self, theorem: str, options: Mapping[str, Any], prove: Prove | None = None
    ) -> None:
        context = multiprocessing.get_context("spawn")
        self._news, theirs = context.Pipe(duplex=False)
        asked = theorem, dict(options), prove or _of_oscillator
        self._process = context.Process(target=_prove, args=(theirs, *asked))
        self._process.start()
        theirs.close()

    @property
    def pid(self) -> int:
        """The number of its process."""
        return self._process.pid or 0

    def news(self) -> Iterator[News]:
        """Give what it has told since it was asked last; after a last word that is no progress
        it has ended."""
        try:
            while self._news.poll():
                yield self._news.recv()
        except (EOFError, OSError):
            yield News("failed", "the process of the proof was killed")

    def stop(self) -> None:
        """End it, and all that it has begun."""
        for number in ("SIGTERM", "SIGKILL"):
            if self._process.is_alive():
                self._end(number)
                self._process.join(PATIENCE)
        self._news.close()

    def _end(self, number: str) -> None:
        """Send a signal to its group, or, if it has none yet, or there are none, to the process."""
        if hasattr(os, "killpg"):
            with suppress(ProcessLookupError, PermissionError):
                os.killpg(self.pid, getattr(signal, number))
        self._process.terminate() if number == "SIGTERM" else self._process.kill()


def _prove(pipe: Connection, theorem: str, options: dict[str, Any], prove: Prove) -> None:
    """Prove a theorem, and tell it: what runs in the process."""
    as_worker()
    if hasattr(os, "setsid"):
        os.setsid()
    Thread(target=_with_the_parent, daemon=True).start()
    with suppress(BrokenPipeError):
        pipe.send(_outcome(theorem, options, prove, _Teller(pipe)))


def _of_oscillator(theorem: str, options: dict[str, Any], tell: Tell) -> Any:
    from cap import interface  # noqa: PLC0415 (slow to load: in this process alone)

    return interface.proved(theorem, options, tell)


def _outcome(theorem: str, options: dict[str, Any], prove: Prove, teller: "_Teller") -> News:
    try:
        proved = prove(theorem, options, teller.tell)
    except BadInput as error:
        return News("bad input", str(error))
    except NotProved as failure:
        return News("not proved", str(failure))
    except Exception as error:  # noqa: BLE001 (the page says so: it has no other way to be told)
        return News("failed", f"{type(error).__name__}: {error}")
    return News("proved", proved.html(), proved.theorem, proved.data)


class _Teller:
    """Tells the progress through a pipe, now and then."""

    def __init__(self, pipe: Connection) -> None:
        self._pipe, self._told = pipe, 0.0

    def tell(self, words: str) -> None:
        """Tell it, unless it has just been told."""
        now = time.monotonic()
        if words and now - self._told >= SELDOM:
            self._told = now
            self._pipe.send(News("progress", words))


def _with_the_parent() -> None:
    """Wait until the process that began this one has ended; then end at once, with all others."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        if hasattr(os, "killpg"):
            os.killpg(os.getpid(), signal.SIGKILL)
        os._exit(1)
