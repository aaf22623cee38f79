"""Formulas of a TeX file as expressions of sympy: sums, products, powers, fractions, functions.

A product needs no sign, and a function takes what follows it up to the next sum or function:
\\cos\\omega t is cos(omega t).  Of names `_*`, `_-` and `_n` are dropped: v_- is v; f_{\\rm sc} is
f_sc, \\dot x is xdot, and e is Euler's number where it is no other name.  Formulas with commas, or
with ±, are lists.
"""

import re
from collections.abc import Mapping
from typing import Any

from cap.audit.means.lazy import sympy as sp
from cap.errors import NotProved

_WHOLE = r"\\mathrm\{sech\}|_\{\\rm [a-z]+\}|\\dot +[a-z]"
_TOKEN = re.compile(_WHOLE + r"|\\[A-Za-z]+|\d+(?:\.\d+)?|[A-Za-z]|[-+/^_{}()|*,]")
_SKIP = re.compile(r"\\[,;! ]|\\(?:bigl|bigr|left|right|cdot|phantom\{-\})(?![A-Za-z])|[\s&]")
_FUNCTIONS = {
    **{f"\\{name}": name for name in ("sin", "cos", "sinh", "cosh")},
    "\\arccos": "acos",
    "\\arcsin": "asin",
    "\\arctan": "atan",
    "\\sgn": "sign",
    "\\mathrm{sech}": "sech",
    "\\sqrt": "sqrt",
}
_FRACTIONS = "\\frac", "\\dfrac", "\\tfrac"
_BRACKETS = {"(": ")", "{": "}", "|": "|"}
_DROPPED = "*", "-", "n"


def expression(text: str, names: Mapping[str, Any]) -> Any:
    """Return the expression that a formula means; `NotProved` if it is not understood."""
    reader = _Reader(text, names)
    values = [reader.sum()]
    while reader.next() == ",":
        reader.take()
        values.append(reader.sum())
    if reader.tokens:
        raise NotProved("tex", f"this is not understood: {' '.join(reader.tokens)}")
    return values[0] if len(values) == 1 else values


def meaning(text: str, names: Mapping[str, Any]) -> Any:
    """Return what a formula means, in which each part between commas may have one ±."""
    parts = [
        part.replace("\\pm", sign)
        for part in (text.split(",\\ ") if "\\pm" in text else [text])
        for sign in ("+-" if "\\pm" in part else "+")
    ]
    return expression(parts[0] if len(parts) == 1 else ",".join(parts), names)


class _Reader:
    def __init__(self, text: str, names: Mapping[str, Any]) -> None:
        left = _SKIP.sub(" ", text)
        if unknown := _TOKEN.sub("", left).split():
            raise NotProved("tex", f"this is not understood: {' '.join(unknown)}")
        self.tokens: list[str] = _TOKEN.findall(left)
        self.names, self.bars = {"pi": sp.pi, "e": sp.E, **names}, 0

    def next(self) -> str:
        return self.tokens[0] if self.tokens else ""

    def take(self, *wanted: str) -> str:
        """Take the next token, which must be one of those wanted, if any are named."""
        if not self.tokens or (wanted and self.tokens[0] not in wanted):
            raise NotProved("tex", f"here is no {' or '.join(wanted) or 'term'}: {self.tokens}")
        return self.tokens.pop(0)

    def sum(self) -> Any:
        value = self.product()
        while self.next() in ("+", "-"):
            value = value + self.product() if self.take() == "+" else value - self.product()
        return value

    def product(self) -> Any:
        if self.next() in ("+", "-"):
            return -self.product() if self.take() == "-" else self.product()
        value = self.power()
        while self.next() not in ("", "+", "-", ")", "}", ",") and not (
            self.bars and self.next() == "|"
        ):
            if self.next() == "/":
                self.take()
                value = value / self.power()
            else:
                value = value * self.power()
        return value

    def power(self) -> Any:
        base = self.base()
        if self.next() != "^":
            return base
        self.take()
        return base ** (self.group() if self.next() == "{" else self.base())

    def group(self, opening: str = "{", closing: str = "}") -> Any:
        self.take(opening)
        value = self.sum()
        self.take(closing)
        return value

    def base(self) -> Any:
        sign = self.take()
        if sign in _BRACKETS:
            self.tokens.insert(0, sign)
            return self.bracket(sign)
        if sign in _FRACTIONS:
            return self.fraction()
        if sign in _FUNCTIONS:
            return getattr(sp, _FUNCTIONS[sign])(self.argument())
        if sign[0].isdigit():
            return sp.Rational(sign)
        if sign.startswith("\\dot "):
            return self.name(f"{sign[-1]}dot")
        return self.name(sign.removeprefix("\\"))

    def fraction(self) -> Any:
        r"""Read what follows \frac: two groups, or two digits."""
        if self.next() == "{":
            return self.group() / self.group()
        digits = self.take()
        return sp.Rational(int(digits[:1]), int(digits[1:]))

    def bracket(self, opening: str) -> Any:
        self.bars += opening == "|"
        value = self.group(opening, _BRACKETS[opening])
        self.bars -= opening == "|"
        return sp.Abs(value) if opening == "|" else value

    def argument(self) -> Any:
        if self.next() in _BRACKETS:
            return self.bracket(self.next())
        value = self.power()
        while self.next().removeprefix("\\").isalpha() and self.next() not in _FUNCTIONS:
            value = value * self.power()
        return value

    def name(self, name: str) -> Any:
        if self.next() == "_":
            self.take()
            below = self.take()
            name += "" if below in _DROPPED else below
        elif self.next().startswith("_{"):
            name += f"_{self.take()[6:-1]}"
        name = "lam" if name == "lambda" else name
        if name not in self.names:
            raise NotProved("tex", f"{name} has no meaning here")
        return self.names[name]
