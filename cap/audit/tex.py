"""Formulas of a TeX file as expressions of sympy: sums, products, powers, fractions, functions.

A product needs no sign, and a function takes what follows it up to the next sum or function:
\\cos\\omega t is cos(omega t).  Of names `_*`, `_-` and `_n` are dropped: v_- is v; f_{\\rm sc} is
f_sc, \\dot x is xdot, and e is Euler's number where it is no other name.  Formulas with commas, or
with ±, are lists.  What can be read in two ways is refused: a/bc, \\cos a(b), 1\\,000.
"""

import re
from collections.abc import Mapping
from tokenize import TokenError
from typing import Any

from cap.audit.means.lazy import parser
from cap.audit.means.lazy import sympy as sp
from cap.errors import NotProved

_REFUSED = re.compile(  # what TeX, or a reader, takes for something else
    r"\\sqrt(?! ?\{)|\^\d\d|\\cdot *[-+]|//|\d(?:\\[,;! ]|\s)+\d|\\pm[^,]*\\pm|\{[^{}]*,"
)
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
_BARE = rf"\w+{_POWER}(?: (?!{_FUNCTION}|e \*\*)[A-Za-z]\w*{_POWER})*"  # what a function takes
_GROUP = r"\s*\{((?:[^{}]|\{(?:[^{}]|\{[^{}]*\})*\})*)\}"
_FRACTION = re.compile(rf"\bfrac{_GROUP}{_GROUP}")
_DIVIDED = re.compile(rf"/ ?\w++{_POWER} ?[\w(]")  # by one thing, or by two
_AS_PYTHON = (  # one after the other
    (r"\|([^|]*)\|", r" Abs (\1) "),
    (r"\bfrac\s+(\d)(\d)(?!\d)", r"(\1/\2)"),
    (r"\{", "("),
    (r"\}", ")"),
    (r"\^", "**"),
    (r"([()])", r" \1 "),
    (r"\s+", " "),
    (rf"({_FUNCTION}) ((?>{_BARE}))(?! ?(?:\(|\*\*))", r"\1 ( \2 )"),
    (rf"({_FUNCTION}) \(", r"\1("),
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
    while (inside := _FRACTION.sub(r"((\1)/(\2))", code)) != code:
        code = inside
    known = re.fullmatch(r"(?:[\w\s(){}|^,/+-]|\d\.\d)*", code)
    for pattern, new in _AS_PYTHON:
        code = re.sub(pattern, new, code)
    if not known or _REFUSED.search(text) or _DIVIDED.search(code):
        raise NotProved("tex", f"this is not understood: {text}")
    code = re.sub(r"(?<=[\w)]) (?=[\w(])", "*", code)
    own = {"pi": sp.pi, "e": sp.E} | {name: getattr(sp, name) for name in _FUNCTIONS}
    exact = {"__builtins__": {}, "Integer": sp.Integer, "Rational": sp.Rational}
    reading = parser.auto_number, parser.rationalize
    try:
        value = parser.parse_expr(code.strip(), {**own, **names}, reading, exact)
    except (SyntaxError, NameError, TypeError, ValueError, TokenError) as error:
        raise NotProved("tex", f"this is not understood: {text} ({error})") from None
    return list(value) if isinstance(value, tuple) else value


def _name(found: re.Match[str]) -> str:
    """Return a name as Python has it, between blanks."""
    name = found["long"] or found["one"] or f"{found['dotted']}dot"
    below = f"_{found['word']}" if found["word"] else (found["below"] or "").strip("*-n")
    return f" {_SPELLED.get(name, name)}{below} "
