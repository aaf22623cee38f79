"""Compiled functions, and a line on standard error while the first call is compiled."""

import multiprocessing
import sys
from collections.abc import Callable
from threading import Lock, Timer
from typing import Any

from cap.sets.kept import kept
from cap.words import say

PATIENCE = 3.0  # seconds: what is kept is loaded in less
WORDS = "compiling the engine of the float mode, the first time only: about ten seconds"


def announced(function: Callable[..., Any], digest: str = "") -> Callable[..., Any]:
    """Compile a function when it is first called, in nopython mode without the GIL, and keep it."""
    return _Announced(kept(function, digest, error_model="numpy"))


class _Announced:
    """A compiled function, of one signature, whose first call prints a line if it takes long."""

    def __init__(self, compiled: Callable[..., Any]) -> None:
        self._compiled, self._ready, self._lock = compiled, False, Lock()

    def __call__(self, *arguments: Any) -> Any:
        if not self._ready:
            with self._lock:  # of several threads one compiles
                if not self._ready:
                    return self._first(*arguments)
        return self._compiled(*arguments)

    def _first(self, *arguments: Any) -> Any:
        timer = Timer(PATIENCE, _say)
        timer.daemon = True
        timer.start()
        try:
            result = self._compiled(*arguments)
        finally:
            timer.cancel()
        self._ready = True
        return result


def _say() -> None:
    if multiprocessing.parent_process() is None:  # others would say the same
        say(WORDS, sys.stderr)
