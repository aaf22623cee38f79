"""Compiled code that computes with intervals of doubles.

Importing this module teaches numba the type `Interval`, its operators, and the functions of
`cap.sets.doubles` and its companions.  A float operand stands for itself, exactly.  Nothing
contracts a product and a sum to one operation (the tests look at the code that comes out), and
division gives infinities and NaN instead of exceptions.
"""

import operator
import platform
from collections.abc import Callable
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Any, TypeVar, cast

import numpy as np
from numba.extending import overload, register_jitable
from numpy.typing import NDArray

from cap.errors import NotProved
from cap.sets import circular, doubles
from cap.sets.doubles import Interval
from cap.sets.kept import kept
from cap.sets.lowering import DOUBLE, INTERVAL

F = TypeVar("F", bound=Callable[..., Any])
IEEE: Any = {"error_model": "numpy", "_nrt": False}  # no exceptions, and no arrays of its own

__all__ = ["PROBE", "compiled", "kernel", "require_ieee", "rounds_to_nearest", "sources"]


def kernel(function: F) -> F:
    """Let compiled code call a function, which stays what it is for Python."""
    register_jitable(**IEEE)(function)
    return function


for _function in (*doubles.BRANCHING, *circular.BRANCHING):
    kernel(cast(Any, _function))


def _quotient(*operands: Any) -> Any:
    def left(x: Any, y: Any) -> Any:
        return doubles.divide(x, Interval(y, 0.0))

    def right(x: Any, y: Any) -> Any:
        return doubles.divide(Interval(x, 0.0), y)

    patterns: dict[Any, Any] = {
        (INTERVAL, INTERVAL): doubles.divide,
        (INTERVAL, DOUBLE): left,
        (DOUBLE, INTERVAL): right,
    }
    return patterns.get(operands)


overload(operator.truediv, jit_options=IEEE, strict=False)(_quotient)


def compiled(function: F) -> F:
    """Compile a function that Python calls, and keep it: see `cap.sets.kept`."""
    return kept(function, sources(), **IEEE)


@cache
def sources() -> str:
    """Return a digest of all that may be compiled.

    With the constants of the checker: a change there must not leave what was compiled before.
    """
    return sha256(b"".join(file.read_bytes() for file in files())).hexdigest()


def files() -> list[Path]:
    """Return the sources of all that may be compiled: the arithmetic, areas, and the flight."""
    here = Path(__file__).parent
    folders = here, here.parent / "areas", here.parent / "checker" / "folded"
    found = sorted(file for folder in folders for file in folder.rglob("*.py"))
    return [*found, *(here.parent / "flow" / name for name in ("flight.py", "kernels.py"))]


PROBE = np.array([1.0, 2.0**-53, 2.0**-53 + 2.0**-105, 2.0**-1074, 2.0**-1022, 2.0**900])


@kernel
def rounds_to_nearest(probe: NDArray[np.float64]) -> bool:
    """Return whether the processor rounds to nearest, with gradual underflow, in this thread.

    It rounds once: 1 + ``more``, rounded to the 64 bits of an extended double first, is the tie 1 +
    ``half``.  ``probe`` is `PROBE`; of constants the compiler would do the sums itself.
    """
    one, half, more, least, normal, large = probe
    ties = one + half == one and -one - half == -one and one + more > one and one - more < one
    gradual = normal * 0.5 > 0 and least * large > 0 and least + least > least
    return bool(ties and gradual and -one - more < -one)


def require_ieee(found: bool) -> None:
    """Raise `NotProved` if the processor does not do what the bounds of errors assume."""
    if not found:
        reason = "the processor does not round to nearest, or flushes small numbers to zero"
        raise NotProved("arithmetic", reason, {"machine": platform.machine()})
