"""Other modes of the processor, set through the C library: directed roundings, flushing to zero."""

from __future__ import annotations

import ctypes
import ctypes.util
import platform
import sys

import pytest

# of fesetround, and which bits of fenv_t flush small results and small operands to zero: in
# MXCSR, behind 28 bytes, or in FPCR, the first word
_MACHINES = {
    "x86_64": ({"downward": 0x400, "upward": 0x800, "to zero": 0xC00}, 7, {1 << 15, 1 << 6}),
    "aarch64": ({"upward": 0x400000, "downward": 0x800000, "to zero": 0xC00000}, 0, {1 << 24}),
}
KNOWN = sys.platform == "linux" and platform.machine() in _MACHINES
MODES, _WORD, _FLUSH = _MACHINES.get(platform.machine(), ({}, 0, set()))
FLUSHES = {f"flushed by {bit:#x}": bit for bit in sorted(_FLUSH)}
ALL = [*MODES, *FLUSHES] if KNOWN else []

only_where_known = pytest.mark.skipif(not KNOWN, reason="the numbers of modes are known on Linux")


def set_mode(name):
    """Let this thread round, or flush, so."""
    libm = ctypes.CDLL(ctypes.util.find_library("m"))
    if name in MODES:
        if libm.fesetround(MODES[name]) != 0:
            pytest.fail("this processor has other numbers of rounding modes")
        return
    environment = (ctypes.c_uint32 * 8)()
    libm.fegetenv(environment)
    environment[_WORD] |= FLUSHES[name]
    libm.fesetenv(environment)


def set_and_return(task):
    """Do a task that sets a mode."""
    set_mode(task)
    return task
