"""Compiled functions, kept for the next time where that is possible."""

from collections.abc import Callable
from contextlib import suppress
from pickle import UnpicklingError
from typing import Any, TypeVar, cast

from numba import njit
from numba.core.caching import FunctionCache

from cap.process import at_home

F = TypeVar("F", bound=Callable[..., Any])
# What pickle raises for files that are not whole, or not what they were:
DAMAGED = UnpicklingError, EOFError, ValueError, AttributeError, ImportError, IndexError


def kept(function: F, digest: str = "", **options: Any) -> F:
    """Compile a function when it is first called; it releases the interpreter lock.

    The code is kept beside its source or in the user's cache directory.  Where neither can be
    written (a package that is installed read-only, no home directory, a full disk) it is compiled
    anew in each process.  numba does not notice changes of what is compiled into it: ``digest`` is
    one of that, unless it is in the function's closure.
    """
    compiled: Any = njit(function, nogil=True, **options)
    if at_home():
        with suppress(RuntimeError):  # numba finds no directory
            cache = _Cache(function)  # type: ignore[no-untyped-call]
            cache.digest = digest
            compiled._cache = cache  # noqa: SLF001 (what njit(cache=True) sets)
    return cast(F, compiled)


class _Cache(FunctionCache):
    """A cache that may fail to read or to write; what it keeps is of sources with one digest."""

    digest = ""

    def _index_key(self, *arguments: Any) -> Any:
        """Return what code is found by."""
        return (*super()._index_key(*arguments), self.digest)  # type: ignore[no-untyped-call]

    def load_overload(self, *arguments: Any) -> Any:
        """Return what is kept, None if there is nothing that can be read."""
        with suppress(OSError):
            try:
                return super().load_overload(*arguments)  # type: ignore[no-untyped-call]
            except DAMAGED:
                self.flush()  # type: ignore[no-untyped-call]  # what is written now can be read
        return None

    def save_overload(self, *arguments: Any) -> None:
        """Keep something, if that is possible."""
        with suppress(OSError):
            super().save_overload(*arguments)  # type: ignore[no-untyped-call]
