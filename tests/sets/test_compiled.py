"""What numba makes of intervals and records: the same bits as Python, and nothing contracted."""

import ctypes
import re
import sys
from pathlib import Path

import numpy as np
import pytest
from support import rounds, seeded

import cap
from cap.errors import NotProved
from cap.sets import compiled as compiling
from cap.sets.compiled import PROBE, require_ieee, sources
from cap.sets.doubles import Interval
from sets.compiled_functions import compiled, elementary, polynomial, probe
from sets.draw import interval

FUNCTIONS = {"polynomial": polynomial, "elementary": elementary}
FLAGS = "fast|contract|reassoc|nnan|ninf|nsz|arcp|afn"
LIBM = r"\bcall\w*\s+\*?\$?(sin|cos|tan|exp|log|pow|sqrt|acos|asin|atan|fma|floor|ldexp)f?\b"


@pytest.mark.parametrize("name", FUNCTIONS)
def test_the_same_bits_as_python(name):
    """Compiled code and Python agree in every bit: there is one text, and one rounding."""
    random, function = seeded(1), FUNCTIONS[name]
    fast = compiled(function)
    for _ in range(rounds(500)):
        x, y = interval(random, 2), interval(random, 2)
        one, other = function(x, y), fast(x, y)
        assert np.array_equal((one.mid, one.rad), (other.mid, other.rad), equal_nan=True), (x, y)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_nothing_is_contracted_or_fast(name):
    """No fused multiplication and addition, no fast-math flag, no call of the C library."""
    fast = compiled(FUNCTIONS[name])
    fast(Interval(0.5, 0.0), Interval(0.5, 0.0))
    (llvm,) = fast.inspect_llvm().values()
    (assembly,) = fast.inspect_asm().values()
    assert len(re.findall(r"\bf(add|sub|mul|div)\b", llvm)) > 50
    assert not re.findall(
        r"\bf(?:add|sub|mul|div|neg|cmp)\s+(?:fast|contract|reassoc|n|arcp|afn)", llvm
    )
    assert "llvm.fmuladd" not in llvm
    assert "llvm.fma" not in llvm
    assert not re.findall(r"\bv?fn?m(add|sub)", assembly)
    assert not re.findall(LIBM, assembly)
    if name == "elementary" and "sd" in assembly:
        assert re.search(r"\bv?sqrtsd\b", assembly)


def test_the_processor_rounds_to_nearest():
    """The question to the processor: yes here, in Python and compiled."""
    assert probe(PROBE)
    require_ieee(probe(PROBE))
    with pytest.raises(NotProved, match="round"):
        require_ieee(False)


ROUNDINGS = {"downward": 0x400, "upward": 0x800, "to zero": 0xC00}


@pytest.mark.skipif(sys.platform != "linux", reason="the C library's numbers of rounding modes")
@pytest.mark.parametrize("name", ROUNDINGS)
def test_another_rounding_is_noticed(name):
    """In a thread that rounds otherwise, the question is answered with no."""
    libm = ctypes.CDLL("libm.so.6")
    old = libm.fegetround()
    try:
        if libm.fesetround(ROUNDINGS[name]) != 0:
            pytest.fail("this processor has other numbers of rounding modes")
        answer = probe(PROBE)
    finally:
        libm.fesetround(old)
    assert not answer
    assert probe(PROBE)


def test_flushing_to_zero_is_noticed():
    """Small numbers that are flushed to zero, as some libraries have it: no."""
    for k, small in ((3, 0.0), (4, 0.0)):
        flushed = PROBE.copy()
        flushed[k] = small
        assert not probe(flushed)


def test_sources_are_those_compiled():
    """The digest is one of all files of these rooms, so no old code is loaded after a change."""
    assert len(sources()) == 64
    here = Path(cap.__file__).parent
    assert (here / "areas" / "folded" / "paths.py").exists()
    assert (here / "sets" / "doubles.py").exists()


def test_without_a_place_for_a_cache():
    """Code from no file that one may write beside: it compiles all the same."""
    names = {}
    exec(compile("def successor(x):\n    return x + 1", "<nowhere>", "exec"), names)  # noqa: S102
    assert compiling.compiled(names["successor"])(1) == 2
