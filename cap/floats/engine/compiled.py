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
    """A compiled function, of one signature: of all of them the first to be compiled says so."""

    said = False

    def __init__(self, compiled: Callable[..., Any]) -> None:
        self._compiled, self._ready, self._lock = compiled, False, Lock()

    def __call__(self, *arguments: Any) -> Any:
        if not self._ready:
            with self._lock:  # of several threads one compiles
                if not self._ready:
                    return self._first(*arguments)
        return self._compiled(*arguments)

    def _first(self, *arguments: Any) -> Any:
        timer = Timer(PATIENCE, self._say)
        timer.daemon = True
        timer.start()
        try:
            result = self._compiled(*arguments)
        finally:
            timer.cancel()
        self._ready = True
        return result

    def _say(self) -> None:
        """Say that one has to wait, unless it is compiled, or loaded, and what it does takes long.

        Other processes would say the same.
        """
        waits = not getattr(self._compiled, "signatures", ())
        if waits and not _Announced.said and multiprocessing.parent_process() is None:
            _Announced.said = True
            say(WORDS, sys.stderr)
