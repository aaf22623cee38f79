"""Numbers and words of the paper beside what is found here.

A count is an integer: it agrees if it is equal.  A number is a float: it agrees with a printed one
that is this number, rounded to its last digit; if that is farther away, but by no more than a unit
of this digit, it is imprecise.  Two decimals enclose a number that is proved: the printed one is
rounded from both, or, if it is an interval, holds them.  Of several floats, which only chance tells
apart, the range agrees, to half a unit.  Dots after a number mean that further digits follow.
"""

import ast
import math
import operator
import re
from collections.abc import Mapping, Sequence
from decimal import Decimal
from fractions import Fraction
from string import Formatter
from typing import Any, NamedTuple

from cap.audit.verdict import Outcome, Strength, Verdict
from cap.errors import NotProved

MORE = 3  # digits shown beyond those of the paper
PROVED = " (proved)"
_RELATION = re.compile(r"(.+) (==|!=|<=|>=|<|>) (.+)")
_RELATIONS = {"==": "eq", "!=": "ne", "<=": "le", ">=": "ge", "<": "lt", ">": "gt"}
Seen = tuple[str, Outcome]  # what is found, as it is shown, and what that says of the paper
NOT_ROUNDED = "less than a unit of the last digit away, but not rounded"


class Comparison(NamedTuple):
    """A row of a table: what is found, what that says of the paper, and why, or a remark."""

    what: str
    paper: str
    ours: str
    outcome: Outcome
    reason: str = ""

    @property
    def agrees(self) -> bool:
        """Whether the paper is right."""
        return self.outcome is Outcome.CONFIRMED

    @property
    def verdict(self) -> Verdict:
        """What this says of the claim."""
        proved, found = PROVED in self.ours, self.ours.replace(PROVED, "")
        strength = Strength.PROVED if proved else Strength.NUMERICAL
        if self.outcome is Outcome.UNCHECKABLE:
            strength, found = Strength.NONE, f"here: {found}"
        evidence = f"{self.reason}." if self.reason else ""
        return Verdict(outcome=self.outcome, strength=strength, found=found, evidence=evidence)


def compared(row: Mapping[str, Any], found: Mapping[str, Any]) -> Comparison:
    """Return the comparison that a row of a table asks for: see `cap.audit.tables`.

    A number that is another one is corrected, words that are not so are refuted; what the paper
    says too roughly, or of a procedure that it does not give, is imprecise; where it does not say
    what is to be computed (a start, seeds), nothing found here can agree or differ.
    """
    if "ours" in row:
        ours = row["ours"].format_map(found)
        seen = _if(_holds(row.get("holds", False), found), Outcome.REFUTED)
    else:
        printed = cut(row["paper"]) if row.get("cut") else row["paper"]
        ours, seen = value(printed, _part(row["value"], found))
    outcome = seen
    if row.get("unstated"):
        outcome = Outcome.UNCHECKABLE
    elif row.get("rough") and outcome is not Outcome.CONFIRMED:
        outcome = Outcome.IMPRECISE
    text = "note" if outcome is Outcome.CONFIRMED else "why"
    reason = row.get(text, "").format_map(found)
    if seen is outcome is Outcome.IMPRECISE:
        reason = NOT_ROUNDED
    return Comparison(row["what"], row["paper"], ours, outcome, reason)


def _holds(condition: str | bool, found: Mapping[str, Any]) -> bool:
    """Return whether a part is true, or in a relation to another, a number or a word in quotes."""
    if isinstance(condition, bool):
        return condition
    if (relation := _RELATION.fullmatch(condition)) is None:
        return bool(_part(condition, found))
    left, right = _part(relation[1], found), _part(relation[3], found)
    return bool(getattr(operator, _RELATIONS[relation[2]])(left, right))


def _part(text: str, found: Mapping[str, Any]) -> Any:
    """Return a number, a word in quotes, or a part of what is found: ``name[0][key].name``."""
    try:
        return ast.literal_eval(text)
    except (ValueError, SyntaxError):
        return Formatter().get_field(text, (), found)[0]


def value(paper: str, ours: Any) -> Seen:
    """Compare what is printed with a count, a number, what is proved, or what runs give."""
    if isinstance(ours, int):
        return str(ours), _if(int(paper) == ours)
    if isinstance(ours, float) and not math.isfinite(ours):
        return str(ours), Outcome.CORRECTED
    ends, mark = ([ours], "") if isinstance(ours, float) else (ours, PROVED)
    if mark and not isinstance(ends[0], str):
        return _among(paper, sorted(ours))
    low, *_, high = sorted(map(Fraction, (*ends, ends[-1])))  # of one, it is both
    printed = paper.strip("[]").split(", ")
    shown = f"{Decimal(ends[0]):.{max(map(digits, printed)) + MORE}f}{mark}"
    if paper.startswith("["):
        return shown, _if(Fraction(printed[0]) <= low and high <= Fraction(printed[1]))
    return shown, rounded(paper, low, high)


def _among(paper: str, ours: Sequence[float]) -> Seen:
    """Compare a printed number with those of several runs that only chance tells apart."""
    near, places = (unit(paper) / 2, digits(paper) + 1) if "." in paper else (Fraction(0), 0)
    shown = f"{ours[0]:.{places}f} to {ours[-1]:.{places}f} in {len(ours)} runs"
    low, high = Fraction(ours[0]) - near, Fraction(ours[-1]) + near
    return shown, _if(low <= Fraction(paper) <= high)


def _if(agrees: bool, otherwise: Outcome = Outcome.CORRECTED) -> Outcome:
    return Outcome.CONFIRMED if agrees else otherwise


def rounded(printed: str, lower: Fraction | float, upper: Fraction | float) -> Outcome:
    """Return the verdict on a printed decimal for a number in [lower, upper].

    It is this number, rounded to its last digit; farther away, but by no more than a unit of this
    digit, it is imprecise.  Raises `NotProved` if that depends on where it is there.
    """
    low, high = Fraction(lower), Fraction(upper)
    own, last = Fraction(printed), unit(printed)
    least, most = max(low - own, own - high, Fraction(0)), max(high - own, own - low)
    if most <= last / 2:
        return Outcome.CONFIRMED
    if last / 2 < least and most <= last:
        return Outcome.IMPRECISE
    if least > last:
        return Outcome.CORRECTED
    raise NotProved("number", f"whether {printed} is right is undecided", {"in": (low, high)})


def cut(printed: str) -> str:
    """Return the interval in which a number is that begins with these digits."""
    own = Decimal(printed)
    ends = own, own + Decimal(1).scaleb(-digits(printed)).copy_sign(own)
    return f"[{', '.join(map(str, sorted(ends)))}]"


def digits(printed: str) -> int:
    """Return how many digits there are after the point."""
    return max(0, -int(Decimal(printed).as_tuple().exponent))


def unit(printed: str) -> Fraction:
    """Return one unit of the last digit."""
    return Fraction(1, 10 ** digits(printed))
