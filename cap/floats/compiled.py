"""Compiled functions: kept for the next time where that is possible, and a word if one waits."""

import multiprocessing
import sys
from collections.abc import Callable
from threading import Lock, Timer
from typing import Any

from numba import njit

from cap.command.console import say
from cap.files import at_home

PATIENCE = 3.0  # seconds: what is kept is loaded in less
WORDS = "compiling what follows orbits, for the first time: about ten seconds"


def kept(function: Callable[..., None]) -> Callable[..., None]:
    """Compile a function when it is first called, in nopython mode without the GIL.

    It is kept in a file beside its source or in the user's cache directory, if one can be written.
    """
    try:
        compiled = njit(function, cache=at_home(), error_model="numpy", nogil=True)
    except RuntimeError:  # there is no such directory
        compiled = njit(function, error_model="numpy", nogil=True)
    return _Announced(compiled)


class _Announced:
    """A compiled function, of one signature, whose first call says a word if it takes long."""

    def __init__(self, compiled: Callable[..., None]) -> None:
        self._compiled, self._ready, self._lock = compiled, False, Lock()

    def __call__(self, *arguments: Any) -> None:
        if not self._ready:
            with self._lock:  # of several threads one compiles
                if not self._ready:
                    self._first(*arguments)
                    return
        self._compiled(*arguments)

    def _first(self, *arguments: Any) -> None:
        timer = Timer(PATIENCE, _say)
        timer.daemon = True
        timer.start()
        try:
            self._compiled(*arguments)
        except OSError:  # it cannot be kept, but is compiled by now
            self._compiled(*arguments)
        finally:
            timer.cancel()
        self._ready = True


def _say() -> None:
    if multiprocessing.parent_process() is None:  # others would say the same
        say(WORDS, sys.stderr)
