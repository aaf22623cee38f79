"""Numbers that the paper prints, as they stand in the tables of its figures."""

from fractions import Fraction

from cap.audit.means.need import need
from cap.audit.tables import stated


def printed(what: str, table: str = "fig:orbit") -> tuple[Fraction, Fraction]:
    """Return the ends of an interval that is printed."""
    text = stated(what, table)
    need(text.startswith("[") and text.endswith("]"), f"{text} is no interval")
    low, high = (Fraction(end.strip()) for end in text[1:-1].split(","))
    return low, high


def total(what: str, table: str) -> Fraction:
    """Return a number that is printed, or the sum of those between which there is a plus."""
    return sum((Fraction(each) for each in stated(what, table).split(" + ")), Fraction(0))
