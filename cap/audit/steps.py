"""Steps that are data: lines of algebra, each a definition, or what has to hold.

    rate = diff(F*cos(omega*t), t)       a name for an expression of sympy
    rate.subs(t, 0) == 0                 an identity, confirmed by sympy
    pi/2 > 1                             a sign: of a number in balls, else by those of the symbols
    elliptic.twist > 0                   what elliptic.json claims, once the checker has accepted it
    late = follow("0.1", "0.5", 2)       what a function finds of a module that the claim ``uses``

``docs/own-paper.md`` has all of them.
"""

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import fields, is_dataclass
from fractions import Fraction
from importlib import import_module
from inspect import isroutine
from numbers import Rational
from types import SimpleNamespace
from typing import Any

from cap.audit import errata, labels, tex
from cap.audit.comparison import rounded
from cap.audit.means import algebra
from cap.audit.means.lazy import parser
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import made, need
from cap.audit.means.stored import THE_PAPER, claimed
from cap.audit.verdict import Outcome
from cap.checker.kernel.shapes import Enclosure
from cap.errors import NotProved
from cap.sets import interval
from cap.sets.interval import Ball

Given = Mapping[str, Any]
Words = Mapping[str, object]  # by their names
SYMBOLS = {key: {key: True} for key in ("positive", "real", "integer")} | {"any": {}}
_DEFINES = re.compile(r"(\w+) = (.+)")
_DECIMAL = re.compile(r"-?\d+\.\d+")
_HOLDS = re.compile(r"(.+) (==|!=|<|>|in) (.+)")
_CLAIMED = re.compile(r"(?<![\w.])[a-z_]+(?:-\d+)?(?:\.\w+)+")


class Steps:
    """The names that steps have defined, and the balls of the numbers that are enclosed.

    Steps are those of some data, one after the other; they may call the functions of modules.
    """

    def __init__(self, *given: Given, used: Iterable[str] = ()) -> None:
        self.names: dict[str, Any] = {"paper": THE_PAPER, "labels": labels.stored()}
        self.balls: dict[Any, Ball] = {}
        for module in used:
            for name, each in vars(import_module(module)).items():
                if getattr(each, "__module__", "") == module and isroutine(each):
                    self.names[name] = self._called(each)
        for data in given:
            self.make(data)

    def make(self, given: Given) -> None:
        """Declare the symbols, and make the steps; `NotProved` if one of them fails."""
        for key, assumed in SYMBOLS.items():
            self.names |= {name: sp.Symbol(name, **assumed) for name in given.get(key, "").split()}
        for line in given.get("steps", "").splitlines():
            if text := line.partition("  #")[0].strip():
                self._step(text)

    def _step(self, text: str) -> None:
        if found := _DEFINES.fullmatch(text):
            self.names[found[1]] = self._read(found[2])
        elif found := _HOLDS.fullmatch(text):
            left, right = self._read(found[1]), self._read(found[3])
            need(self._holds(left, found[2], right), f"this was not confirmed: {text}")
        else:
            raise NotProved("audit", f"this is no step: {text}")

    def _read(self, text: str) -> Any:
        """Return what a text means: an expression of sympy, or something that is claimed."""
        known = dict(self.names)

        def name(found: re.Match[str]) -> str:
            if (value := claimed(found[0])) is None:
                return found[0]
            known[own := f"claimed_{len(known)}"] = self._exact(value)
            return own

        rules = parser.standard_transformations
        declared = tuple(each for each in rules if each != parser.auto_symbol)
        try:
            return parser.parse_expr(_CLAIMED.sub(name, text), known, declared)
        except NameError as error:
            raise NotProved("audit", f"{error}, in {text}: symbols are declared") from None

    def _called(self, function: Callable[..., Any]) -> Callable[..., Any]:
        """Return a function for expressions."""

        def call(*given: Any, **named: Any) -> Any:
            with algebra.precisely():
                options = {name: self._given(each) for name, each in named.items()}
                return self._exact(function(*map(self._given, given), **options))

        return call

    def _given(self, value: Any) -> Any:
        """Return what a function is given: exact numbers as fractions, others as balls.

        Expressions that are no numbers, and words, are given as they are.
        """
        if isinstance(value, list | tuple):
            return tuple(map(self._given, value))
        if isinstance(value, Rational):
            return Fraction(value)
        number = isinstance(value, sp.Expr) and value.free_symbols <= self.balls.keys()
        return self.enclosed(value) if number else value

    def _exact(self, value: Any) -> Any:
        """Return what is claimed or found for an expression: for a ball a symbol, which has it."""
        if isinstance(value, Enclosure):
            with algebra.precisely():
                return self._exact(interval.hull(*map(interval.ball, value[:2])))
        if isinstance(value, Ball):
            symbol = sp.Dummy(str(value), real=True)
            self.balls[symbol] = value
            return symbol
        if is_dataclass(value):
            own = {each.name: self._exact(getattr(value, each.name)) for each in fields(value)}
            return SimpleNamespace(**own)
        if isinstance(value, dict):
            return {name: self._exact(each) for name, each in value.items()}
        if isinstance(value, list | tuple):
            return [self._exact(each) for each in value]
        number = isinstance(value, Fraction | int) and not isinstance(value, bool)
        return sp.Rational(value) if number else value

    def _holds(self, left: Any, relation: str, right: Any) -> bool:
        if relation == "in":
            return left in right
        if isinstance(left, dict | list) and not isinstance(right, dict | list):
            entries = list(left.values() if isinstance(left, dict) else left)
            return entries != [] and all(self._holds(each, relation, right) for each in entries)
        if relation in "<>":
            return self._positive(left - right if relation == ">" else right - left)
        if relation == "!=":
            return self._differs(left, right)
        symbolic = all(isinstance(each, sp.Basic | sp.MatrixBase) for each in (left, right))
        return bool(left == right) or (symbolic and algebra.same(left, right))

    def _differs(self, left: Any, right: Any) -> bool:
        """Return whether numbers, or expressions, certainly differ."""
        if self.balls and (left - right).free_symbols & self.balls.keys():
            return self._positive(left - right) or self._positive(right - left)
        return algebra.differs(left, right)

    def _positive(self, value: Any) -> bool:
        """Return whether a number or an expression is certainly positive."""
        if value.free_symbols <= self.balls.keys():
            return bool(self.enclosed(value) > 0)
        return bool(sp.factor(sp.simplify(value)).is_positive)

    def as_in_the_erratum(self, claim: str) -> None:
        """Compare the formulas of the changes that a claim asks for with what was derived."""
        for formula, text in errata.formulas(claim):
            self.agrees(formula, text)

    def agrees(self, formula: Given, text: str) -> None:
        """Raise `NotProved` unless a formula of a text is what it should be.

        Names are declared, or defined in ``where``.  It is equal to what it ``is``, to its last
        digit if it is a number; ``steps`` hold, in which it is called ``it``.
        """
        self.make({**formula, "steps": formula.get("where", "")})
        alone = rf"(?<![\w.^/-])(?<!- ){re.escape(formula['tex'])}(?!\w|\^(?!\\circ)|\.\d)"
        need(bool(re.search(alone, text)), "the formula is not in the text of the erratum")
        need("is" in formula or "steps" in formula, "the formula is compared with nothing")
        self.names["it"] = printed = tex.meaning(formula["tex"], self.names)
        self.make({"steps": formula.get("steps", "")})
        if "is" not in formula:
            return
        derived = self._read(formula["is"])
        if _DECIMAL.fullmatch(formula["tex"]):
            same = self.rounded(formula["tex"], derived) is Outcome.CONFIRMED
        else:
            same = bool(printed == derived) or algebra.same(printed, derived)
        need(same, f"the erratum has another formula: {printed} for {derived}")

    def rounded(self, printed: str, value: Any) -> Outcome:
        """Return the verdict on a printed decimal."""
        made()
        return rounded(printed, *interval.ends(self.enclosed(value)))

    def enclosed(self, value: Any) -> Ball:
        """Return an enclosure of a number."""
        with algebra.precisely():
            return algebra.enclosure(value, self.balls)


RULES: dict[str, Callable[[Steps, str], Outcome]] = {  # of what is defined, and what is stated
    "formula": lambda done, _: algebra.compared(done.names["derived"], done.names["printed"]),
    "number": lambda done, stated: done.rounded(stated, done.names["value"]),
}
