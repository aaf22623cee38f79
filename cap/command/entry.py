"""How a command begins and ends: loaded late, stopped at any time, in one line and with a status.

`run` calls a function of words that returns an exit status, and sees to all that goes wrong around
it:

- Ctrl-C, SIGTERM and SIGHUP are a line, and the status 130, 143 or 129.  While modules load the
  process ends at once; later `KeyboardInterrupt` is raised, so that files are written whole or not
  at all; again if it is lost where nothing can be raised.  Signals that are ignored stay ignored.
- A reader that has closed the output, as ``| head`` does, is the status 141 and no line; output
  that cannot be written, or too little memory, is a line and the status 2.
- A library that is not installed is a line and the status 2.
- Characters that the output cannot encode are escaped.
- Where there is no home directory, libraries keep nothing: they would make a directory `~`.

Nothing is imported here that takes time to load.
"""

import io
import os
import signal
import sys
import threading
from _thread import interrupt_main
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from errno import EBADF, EFBIG, EIO, ENOSPC
from importlib import import_module
from types import FrameType
from typing import NoReturn

from cap.process import SIGNALS, at_home

INTERRUPTED = 130
CLOSED = 141
FAILED = 2
STOPPED = 128  # plus the number of the signal
AGAIN = 0.05  # seconds: when what could not be stopped is over

_FULL = (ENOSPC, EFBIG, EIO, EBADF)
_WORDS = {"SIGINT": "interrupted", "SIGTERM": "terminated", "SIGHUP": "hung up"}


class _Stops:
    """What happens at a signal; ``last`` is the last one."""

    def __init__(self) -> None:
        self.last: signal.Signals | None = None
        self.loading = self.ending = False
        self._before: dict[signal.Signals, object] = {}

    def __enter__(self) -> "_Stops":
        self._unraisable, sys.unraisablehook = sys.unraisablehook, self._lost
        with suppress(ValueError):  # not in the main thread: then signals are not for us
            for number in SIGNALS:
                if signal.getsignal(number) is not signal.SIG_IGN:
                    self._before[number] = signal.signal(number, self._stop)
        return self

    def __exit__(self, *_: object) -> None:
        sys.unraisablehook = self._unraisable
        for number, handler in self._before.items():
            signal.signal(number, handler)  # type: ignore[arg-type]

    def _stop(self, number: int, _frame: FrameType | None) -> None:
        self.last = signal.Signals(number)
        if self.loading and not self.ending:
            with suppress(OSError):
                os.write(2, f"{self.line()}\n".encode())
        if self.loading or self.ending:
            os._exit(STOPPED + number)
        raise KeyboardInterrupt

    def _lost(self, unraisable: "sys.UnraisableHookArgs") -> None:
        """Stop again: the interrupt came in a finalizer, or a function that C has called."""
        if isinstance(unraisable.exc_value, KeyboardInterrupt) and self.last:
            again = threading.Timer(AGAIN, interrupt_main, [self.last])
            again.daemon = True
            again.start()
        else:
            self._unraisable(unraisable)

    def line(self) -> str:
        """Return what happened, in a line."""
        return f"{_WORDS[(self.last or signal.SIGINT).name]}; nothing half-written"

    def status(self, status: int) -> int:
        """Return the status of the signal instead of that of any interrupt."""
        return STOPPED + self.last if self.last and status == INTERRUPTED else status


_STOPS = _Stops()


@contextmanager
def loading() -> Iterator[None]:
    """End at once if stopped, inside: while modules load there is nothing to be kept."""
    before, _STOPS.loading = _STOPS.loading, True
    try:
        yield
    finally:
        _STOPS.loading = before


def run(target: str, words: Sequence[str] | None) -> int:
    """Return the status of the function ``module:function`` of the words (default: sys.argv)."""
    global _STOPS  # noqa: PLW0603 (the signals of a process are one)
    before, _STOPS = _STOPS, _Stops()
    try:
        with _STOPS as stops:
            return stops.status(_guarded(target, sys.argv[1:] if words is None else words))
    finally:
        _STOPS = before


def leave(status: int) -> NoReturn:
    """Exit; from now on a signal ends the process without a word."""
    for number in SIGNALS:
        if signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, signal.SIG_DFL)
    sys.exit(status)


def _guarded(target: str, words: Sequence[str]) -> int:
    try:
        with loading():
            _escape()
            if not at_home():
                os.environ["HOME"] = os.devnull
            module, _, name = target.partition(":")
            command: Callable[[Sequence[str]], int] = getattr(import_module(module), name)
        return _flushed(command, words)
    except KeyboardInterrupt:
        _STOPS.ending = True  # a second signal ends it at once
        _complain(_STOPS.line())
        return INTERRUPTED
    except MemoryError:
        _complain("error: not enough memory: ask for less")
        return FAILED
    except ModuleNotFoundError as error:
        library = str(error.name).partition(".")[0]
        if library == "cap":
            raise
        _complain(f"error: the library {library} is missing: install cap, say by pip install -e .")
        return FAILED
    except OSError as error:
        return _unwritten(error)


def _flushed(command: Callable[[Sequence[str]], int], words: Sequence[str]) -> int:
    """Return the status when all output is written, also if the command exits by itself."""
    try:
        return command(words)
    finally:
        for stream in (sys.stdout, sys.stderr):
            if stream is not None:
                stream.flush()


def _escape() -> None:
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


def _unwritten(error: OSError) -> int:
    """Return the status after an error of the system; what is still buffered goes nowhere."""
    for number, stream in ((1, sys.stdout), (2, sys.stderr)):
        try:
            if stream is not None:
                stream.flush()
        except OSError:
            os.dup2(os.open(os.devnull, os.O_WRONLY), number)
    if isinstance(error, BrokenPipeError):
        return CLOSED
    what = "output cannot be written" if error.errno in _FULL else "the system refused"
    _complain(f"error: {what}: {error.strerror}")
    return FAILED


def _complain(line: str) -> None:
    if sys.stderr is not None:
        with suppress(OSError):
            print(line, file=sys.stderr, flush=True)
