"""Numbers and claims of the paper beside what is computed here.

A printed number agrees if it is what is found, rounded to its last digit; if it is farther away,
but by no more than a unit of this digit, it is imprecise; a count agrees if it is equal; an
enclosure, if it holds what is proved.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal
from enum import StrEnum

MORE = 3  # digits shown beyond those of the paper
PROVED = " (proved)"
NOT_ROUNDED = "less than a unit of the last digit away, but not rounded"


class Kind(StrEnum):
    """What is compared."""

    VALUE = "number"
    WORDS = "description"


@dataclass(frozen=True)
class Comparison:
    """What the paper says and what is computed; why they differ, or a remark if they agree.

    ``imprecise``: if they differ, the paper is too rough, or is about a procedure that it does not
    describe, rather than wrong.  ``unstated``: it does not say what would have to be computed (a
    start, seeds), so that nothing found here can agree or differ.  ``where`` is the place that says
    it, if that is not the figure.
    """

    what: str
    paper: str
    ours: str
    agrees: bool
    reason: str = ""
    kind: Kind = Kind.VALUE
    where: str = ""
    imprecise: bool = False
    unstated: bool = False

    @property
    def rigorous(self) -> bool:
        """Whether what is computed is proved."""
        return PROVED in self.ours


def taken_from(place: str, rows: Iterable[Comparison]) -> list[Comparison]:
    """Return the rows, as taken from a place of the paper with this label."""
    return [replace(row, where=place) for row in rows]


def roughly(row: Comparison) -> Comparison:
    """Return the row; if it does not agree, the paper is imprecise there."""
    return replace(row, imprecise=True)


def cut_off(row: Comparison) -> Comparison:
    """Return the row of a number after which the paper has dots: it need not be rounded."""
    return replace(row, agrees=True, reason="", imprecise=False) if row.imprecise else row


def unstated(row: Comparison, why: str) -> Comparison:
    """Return the row, as one that nothing computed here can confirm or refute, for this reason."""
    return replace(row, agrees=False, reason=why, unstated=True)


def number(what: str, paper: str, ours: float, reason: str = "", *, note: str = "") -> Comparison:
    """Compare a float with a printed decimal."""
    printed, value = Decimal(paper), Decimal(float(ours))
    return _rounded(_made(what, paper, _shown(value, printed), True, "", note), [value], reason)


def proved(
    what: str, paper: str, ours: Sequence[str], reason: str = "", *, note: str = ""
) -> Comparison:
    """Compare a proved enclosure, (lower, upper) in decimals, with a printed decimal."""
    printed = Decimal(paper)
    ends = [Decimal(end) for end in ours]
    row = _made(what, paper, _shown(ends[0], printed) + PROVED, True, "", note)
    return _rounded(row, ends, reason)


def enclosure(
    what: str, paper: tuple[str, str], ours: Sequence[str], reason: str = "", *, note: str = ""
) -> Comparison:
    """Compare a proved enclosure with a printed one: does that hold it?"""
    low, high = map(Decimal, paper)
    ends = [Decimal(end) for end in ours]
    agrees = low <= min(ends) and max(ends) <= high
    shown = _shown(ends[0], min(low, high, key=_exponent)) + PROVED
    return _made(what, f"[{paper[0]}, {paper[1]}]", shown, agrees, reason, note)


def count(what: str, paper: int, ours: int, reason: str = "", *, note: str = "") -> Comparison:
    """Compare counts."""
    return _made(what, str(paper), str(ours), paper == ours, reason, note)


def among(
    what: str, paper: str, ours: Iterable[float], reason: str = "", *, note: str = ""
) -> Comparison:
    """Compare a printed number with those of several runs that only chance tells apart."""
    printed, values = Decimal(paper), sorted(Decimal(float(value)) for value in ours)
    near = unit(printed) if "." in paper else Decimal(0)
    agrees = values[0] - near <= printed <= values[-1] + near
    digits = max(0, -_exponent(printed) + 1) if "." in paper else 0
    shown = f"{values[0]:.{digits}f} to {values[-1]:.{digits}f} in {len(values)} runs"
    return _made(what, paper, shown, agrees, reason, note)


def claim(
    what: str, paper: str, ours: str, agrees: bool, reason: str = "", *, note: str = ""
) -> Comparison:
    """Compare words."""
    return replace(_made(what, paper, ours, agrees, reason, note), kind=Kind.WORDS)


def _made(what: str, paper: str, ours: str, agrees: bool, reason: str, note: str) -> Comparison:
    return Comparison(what, paper, ours, bool(agrees), note if agrees else reason)


def _rounded(row: Comparison, values: Iterable[Decimal], reason: str) -> Comparison:
    """Return the row of a printed number, whose value is one of these or between them."""
    printed = Decimal(row.paper)
    away = max(abs(value - printed) if value.is_finite() else Decimal("Inf") for value in values)
    if away <= unit(printed) / 2:
        return row
    if away <= unit(printed):
        return replace(row, agrees=False, reason=NOT_ROUNDED, imprecise=True)
    return replace(row, agrees=False, reason=reason)


def _exponent(value: Decimal) -> int:
    exponent = value.as_tuple().exponent
    return exponent if isinstance(exponent, int) else 0


def unit(printed: Decimal) -> Decimal:
    """Return one unit of the last digit."""
    return Decimal(1).scaleb(_exponent(printed))


def _shown(value: Decimal, printed: Decimal) -> str:
    """Return a value with some digits more than are printed, no more than a double has."""
    if not value.is_finite():
        return str(value)
    places = max(0, -_exponent(printed)) + MORE
    return f"{value:.{places}f}"


def markdown(rows: Iterable[Comparison]) -> list[str]:
    """Return a table."""
    lines = ["| what | paper | ours | agrees? | why not, or a remark |", "|---|---|---|---|---|"]
    for row in rows:
        agrees = "not said" if row.unstated else "yes" if row.agrees else "**no**"
        cells = (row.what, row.paper, row.ours, agrees, row.reason)
        lines.append("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |")
    return lines


def percent(part: float, whole: float) -> str:
    """Return a share in words."""
    return f"{100 * part / whole:.3g}%" if whole else "none"
