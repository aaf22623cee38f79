"""Symbolic steps: identities by sympy, differences at exact points in balls.

That two expressions are equal is left to a computer algebra system;
that they are not is certain, because both are enclosed at a rational point.
"""

from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager
from fractions import Fraction
from functools import reduce
from operator import add, mul
from typing import Any

from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import made
from cap.audit.verdict import Outcome
from cap.errors import NotProved
from cap.sets import interval
from cap.sets.interval import Ball

BITS = 120
_UNARY: dict[str, Callable[[Ball], Ball]] = {
    **{name: getattr(Ball, name) for name in ("sin", "cos", "tan", "exp", "log")},
    **{name: getattr(Ball, name) for name in ("asin", "acos", "atan", "sinh", "cosh", "tanh")},
    "sech": lambda x: 1 / x.cosh(),
    "Abs": abs,
    "sign": Ball.sgn,
}


def precisely() -> AbstractContextManager[None]:
    """Compute with many digits."""
    return interval.workprec(BITS)


def same(left: Any, right: Any) -> bool:
    """Return whether the difference of two expressions, or matrices, simplifies to 0."""
    difference = left - right
    entries = list(difference) if isinstance(difference, sp.MatrixBase) else [difference]
    return all(
        sp.expand(each) == 0 or sp.simplify(sp.expand(sp.expand_trig(each))) == 0
        for each in entries
    )


def differs(left: Any, right: Any) -> bool:
    """Return whether two expressions, or matrices, certainly differ at an exact point.

    A dummy symbol stands for one number, which is no point that may be chosen.
    """
    difference = left - right
    if isinstance(difference, sp.MatrixBase):
        return any(differs(entry, 0) for entry in difference)
    free = sorted(difference.free_symbols, key=str)
    if any(isinstance(symbol, sp.Dummy) for symbol in free):
        return False
    point = {
        symbol: Fraction(7 * k + 10, 1 if symbol.is_integer else 5 * k + 13)
        for k, symbol in enumerate(free)
    }
    with precisely():
        value = enclosure(difference, point)
        return bool(value.is_finite() and (value > 0 or value < 0))


def enclosure(expression: Any, point: Mapping[Any, Fraction | Ball] | None = None) -> Ball:
    """Return a ball that contains the expression at a point, at the current precision."""
    known = {sp.pi: interval.pi(), **(point or {})}
    values = {k: v if isinstance(v, Ball) else interval.ball(v) for k, v in known.items()}
    return _value(sp.sympify(expression), values)


def _value(expression: Any, values: Mapping[Any, Ball]) -> Ball:
    if expression in values:
        return values[expression]
    if expression.is_Rational:
        return interval.ball(Fraction(expression))
    arguments = [_value(each, values) for each in expression.args]
    if expression.is_Add or expression.is_Mul:
        return reduce(add if expression.is_Add else mul, arguments)
    if expression.is_Pow:
        base, power = arguments
        if expression.exp.is_Rational and expression.exp.q <= 2:
            return (base if expression.exp.q == 1 else base.sqrt()) ** int(expression.exp.p)
        return base**power
    name = type(expression).__name__
    if name not in _UNARY:
        raise NotProved("algebra", f"no enclosure of {name} is known")
    return _UNARY[name](*arguments)


def shown(expression: Any) -> str:
    """Return an expression in one line for people."""
    text: str = sp.sstr(expression)
    for name, sign in zip(_NAMES.split(), "²³⁴ωθλεμταβπξ ", strict=True):
        text = text.replace(name, sign)
    return text


_NAMES = "**2 **3 **4 omega theta lambda epsilon mu tau alpha beta pi xi *"


def compared(derived: Any, printed: Any) -> Outcome:
    """Return the verdict on a formula: confirmed if it is the one derived here, else corrected."""
    made()
    if same(derived, printed):
        return Outcome.CONFIRMED
    if differs(derived, printed):
        return Outcome.CORRECTED
    raise NotProved("algebra", f"whether {shown(derived)} is {shown(printed)} is undecided")
