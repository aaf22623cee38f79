"""Formulas of a TeX file as expressions of sympy: sums, products, powers, fractions, functions.

A product needs no sign, and a function takes what follows it up to the next sum or function:
\\cos\\omega t is cos(omega t).  Of names `_*`, `_-` and `_n` are dropped: v_- is v; f_{\\rm sc} is
f_sc, \\dot x is xdot, and e is Euler's number where it is no other name.  Formulas with commas, or
with ±, are lists.
"""

import re
from collections.abc import Mapping
from tokenize import TokenError
from typing import Any

from cap.audit.means.lazy import parser
from cap.audit.means.lazy import sympy as sp
from cap.errors import NotProved

_SKIP = re.compile(r"\\[,;! ]|\\(?:bigl|bigr|left|right|cdot|phantom\{-\})(?![A-Za-z])|&")
_NAME = re.compile(
    r"(?:\\dot +(?P<dotted>[a-z])|\\(?P<long>[A-Za-z]+)|(?P<one>[A-Za-z]))"
    r"(?:_\{\\rm (?P<word>[a-z]+)\}|_(?P<below>[A-Za-z\d*-]))?"
)
_SPELLED = {"lambda": "lam", "sgn": "sign", "dfrac": "frac", "tfrac": "frac", "arccos": "acos"}
_SPELLED |= {"arcsin": "asin", "arctan": "atan"}
_FUNCTIONS = "sin", "cos", "sinh", "cosh", "acos", "asin", "atan", "sign", "sech", "sqrt", "Abs"
_FUNCTION = rf"\b(?:{'|'.join(_FUNCTIONS)})\b"
_POWER = r"(?: ?\*\*(?:\w+| \( [^()]*\)))?"
_AS_PYTHON = (  # one after the other
    (r"\|([^|]*)\|", r" Abs (\1) "),
    (r"\bfrac\s+(\d)(\d)(?!\d)", r"(\1/\2)"),
    (r"\}\s*\{", ","),  # between the groups of a fraction
    (r"\{", "("),
    (r"\}", ")"),
    (r"\^", "**"),
    (r"([()])", r" \1 "),
    (r"\s+", " "),
    (rf"({_FUNCTION}) (\w+{_POWER}(?: (?!{_FUNCTION})[A-Za-z]\w*{_POWER})*)", r"\1 ( \2 )"),
    (rf"({_FUNCTION}|\bfrac) \(", r"\1("),
    (r"(?<=[\w)]) (?=[\w(])", "*"),
)


def meaning(text: str, names: Mapping[str, Any]) -> Any:
    """Return what a formula means, in which each part between commas may have one ±.

    Raises `NotProved` if it is not understood.
    """
    parts = [
        part.replace("\\pm", sign)
        for part in (text.split(",\\ ") if "\\pm" in text else [text])
        for sign in ("+-" if "\\pm" in part else "+")
    ]
    whole = ",".join(parts).replace(r"\mathrm{sech}", r"\sech")
    code = _NAME.sub(_name, _SKIP.sub(" ", whole))
    if not re.fullmatch(r"(?:[\w\s(){}|^,/+-]|\d\.\d)*", code):
        raise NotProved("tex", f"this is not understood: {text}")
    for pattern, new in _AS_PYTHON:
        code = re.sub(pattern, new, code)
    known = {"pi": sp.pi, "e": sp.E, "frac": lambda above, below: above / below}
    known |= {name: getattr(sp, name) for name in _FUNCTIONS}
    exact = {"__builtins__": {}, "Integer": sp.Integer, "Rational": sp.Rational}
    reading = parser.auto_number, parser.rationalize
    try:
        value = parser.parse_expr(code.strip(), {**known, **names}, reading, exact)
    except (SyntaxError, NameError, TypeError, ValueError, TokenError) as error:
        raise NotProved("tex", f"this is not understood: {text} ({error})") from None
    return list(value) if isinstance(value, tuple) else value


def _name(found: re.Match[str]) -> str:
    """Return a name as Python has it, between blanks."""
    name = found["long"] or found["one"] or f"{found['dotted']}dot"
    below = f"_{found['word']}" if found["word"] else (found["below"] or "").strip("*-n")
    return f" {_SPELLED.get(name, name)}{below} "
