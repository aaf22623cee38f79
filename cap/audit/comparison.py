"""Numbers and words of the paper beside what is found here.

A count is an integer: it agrees if it is equal.  A number is a float: it agrees with a printed one
that is this number, rounded to its last digit; if that is farther away, but by no more than a unit
of this digit, it is imprecise.  Two decimals enclose a number that is proved: the printed one is
rounded from both, or, if it is an interval, holds them.  Of several floats, which only chance tells
apart, the range agrees.
"""

import ast
import operator
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal
from string import Formatter
from typing import Any, NamedTuple

MORE = 3  # digits shown beyond those of the paper
PROVED = " (proved)"
_RELATION = re.compile(r"(.+) (==|!=|<=|>=|<|>) (.+)")
_RELATIONS: dict[str, Callable[[Any, Any], Any]] = {
    "==": operator.eq,
    "!=": operator.ne,
    "<=": operator.le,
    ">=": operator.ge,
    "<": operator.lt,
    ">": operator.gt,
}
NOT_ROUNDED = "less than a unit of the last digit away, but not rounded"


@dataclass(frozen=True)
class Comparison:
    """What the paper says and what is found; why they differ, or a remark if they agree.

    ``words``: it is no number.  ``imprecise``: if they differ, the paper is too rough, or is about
    a procedure that it does not describe, rather than wrong.  ``unstated``: it does not say what
    would have to be computed (a start, seeds), so that nothing found here can agree or differ.
    """

    what: str
    paper: str
    ours: str
    agrees: bool
    reason: str = ""
    words: bool = False
    imprecise: bool = False
    unstated: bool = False

    @property
    def rigorous(self) -> bool:
        """Whether what is found is proved."""
        return PROVED in self.ours


class Seen(NamedTuple):
    """What is found, as it is shown; whether the paper has it, and if not, nearly."""

    ours: str
    agrees: bool
    nearly: bool = False


def compared(row: Mapping[str, Any], found: Mapping[str, Any]) -> Comparison:
    """Return the comparison that a row of a table asks for: see `cap.audit.tables`."""
    words, unstated = "ours" in row, row.get("unstated", False)
    if words:
        seen = Seen(row["ours"].format_map(found), _holds(row.get("holds", False), found))
    else:
        seen = value(row["paper"], _part(row["value"], found))
    agrees = not unstated and (seen.agrees or (seen.nearly and row.get("cut", False)))
    nearly = seen.nearly and not unstated
    text = "note" if agrees else "why"
    return Comparison(
        row["what"],
        row["paper"],
        seen.ours,
        agrees,
        NOT_ROUNDED if nearly and not agrees else row.get(text, "").format_map(found),
        words,
        imprecise=row.get("rough", False) or nearly,
        unstated=unstated,
    )


def _holds(condition: str | bool, found: Mapping[str, Any]) -> bool:
    """Return whether a part is true, or in a relation to another, a number or a word in quotes."""
    if isinstance(condition, bool):
        return condition
    if (relation := _RELATION.fullmatch(condition)) is None:
        return bool(_part(condition, found))
    return bool(_RELATIONS[relation[2]](_part(relation[1], found), _part(relation[3], found)))


def _part(text: str, found: Mapping[str, Any]) -> Any:
    """Return a number, a word in quotes, or a part of what is found: ``name[0][key].name``."""
    try:
        return ast.literal_eval(text)
    except (ValueError, SyntaxError):
        return Formatter().get_field(text, (), found)[0]


def value(paper: str, ours: Any) -> Seen:
    """Compare what is printed with a count, a number, what is proved, or what runs give."""
    if isinstance(ours, int):
        return Seen(str(ours), int(paper) == ours)
    if isinstance(ours, float):
        return number(paper, ours)
    if not isinstance(ours[0], str):
        return among(paper, ours)
    return enclosure(paper, ours) if paper.startswith("[") else proved(paper, ours)


def number(paper: str, ours: float) -> Seen:
    """Compare a float with a printed decimal."""
    printed, value = Decimal(paper), Decimal(float(ours))
    return _rounded(printed, _shown(value, printed), [value])


def proved(paper: str, ours: Sequence[str]) -> Seen:
    """Compare a proved enclosure, (lower, upper) in decimals, with a printed decimal."""
    printed, ends = Decimal(paper), [Decimal(end) for end in ours]
    return _rounded(printed, _shown(ends[0], printed) + PROVED, ends)


def enclosure(paper: str, ours: Sequence[str]) -> Seen:
    """Compare a proved enclosure with a printed one: does that hold it?"""
    low, high = map(Decimal, paper.strip("[]").split(", "))
    ends = [Decimal(end) for end in ours]
    shown = _shown(ends[0], max(low, high, key=_digits)) + PROVED
    return Seen(shown, low <= min(ends) and max(ends) <= high)


def among(paper: str, ours: Iterable[float]) -> Seen:
    """Compare a printed number with those of several runs that only chance tells apart."""
    printed, values = Decimal(paper), sorted(Decimal(float(value)) for value in ours)
    decimals = "." in paper
    near, digits = (unit(printed), _digits(printed) + 1) if decimals else (Decimal(0), 0)
    shown = f"{values[0]:.{digits}f} to {values[-1]:.{digits}f} in {len(values)} runs"
    return Seen(shown, values[0] - near <= printed <= values[-1] + near)


def _rounded(printed: Decimal, shown: str, values: Iterable[Decimal]) -> Seen:
    """Compare a printed number with one that is among these or between them."""
    away = max(abs(value - printed) if value.is_finite() else Decimal("Inf") for value in values)
    last = unit(printed)
    return Seen(shown, away <= last / 2, nearly=last / 2 < away <= last)


def _digits(value: Decimal) -> int:
    """Return how many digits there are after the point."""
    exponent = value.as_tuple().exponent
    return -exponent if isinstance(exponent, int) else 0


def unit(printed: Decimal) -> Decimal:
    """Return one unit of the last digit."""
    return Decimal(1).scaleb(-_digits(printed))


def _shown(value: Decimal, printed: Decimal) -> str:
    """Return a value with some digits more than are printed, no more than a double has."""
    if not value.is_finite():
        return str(value)
    return f"{value:.{max(0, _digits(printed)) + MORE}f}"


def markdown(rows: Iterable[Comparison]) -> list[str]:
    """Return a table."""
    lines = ["| what | paper | ours | agrees? | why not, or a remark |", "|---|---|---|---|---|"]
    for row in rows:
        agrees = "not said" if row.unstated else "yes" if row.agrees else "**no**"
        cells = (row.what, row.paper, row.ours, agrees, row.reason)
        lines.append("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |")
    return lines
