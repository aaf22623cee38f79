"""Kneading sequences and entropy of unimodal maps, by comparison with tent maps.

A unimodal map is taken to have a maximum: L is the branch on which it increases, R that on which it
decreases.  Its kneading sequence tells the branches of G(c), G²(c), ..., c the critical point.  Two
sequences are compared at their first difference: L < R if an even number of R comes before it, R <
L if an odd one.  The entropy is a monotone function of the sequence (Milnor and Thurston), and that
of the tent map y -> s min(y, 1 - y), 1 < s <= 2, is log s.
"""

from collections.abc import Iterator
from fractions import Fraction
from itertools import count

from cap.sets import interval
from cap.sets.interval import Ball


def tent(s: Ball) -> Iterator[str]:
    """Yield the kneading sequence of a tent map, as long as it is certain."""
    y = s / 2
    while y < Ball("0.5") or y > Ball("0.5"):
        left = bool(y < Ball("0.5"))
        yield "L" if left else "R"
        y = s * y if left else s * (1 - y)


def doubling() -> Iterator[str]:
    """Yield the sequence at the limit of period doubling, the largest of those of entropy zero.

    Its first 2ⁿ - 1 symbols K give the first 2ⁿ⁺¹ - 1: K, then L if R is in K an odd number of
    times and R if not, then K.
    """
    known = "R"
    for n in count():
        if n == len(known):
            known += ("L" if known.count("R") % 2 else "R") + known
        yield known[n]


def compared(symbols: str, other: Iterator[str]) -> int:
    """Return 1 if every sequence that begins with ``symbols`` is larger than the other one, -1 if
    smaller, 0 if that is not decided."""
    sign = 1
    for mine, its in zip(symbols, other, strict=False):
        if mine != its:
            return sign if mine == "R" else -sign
        sign = -sign if mine == "R" else sign
    return 0


def extreme(symbols: str, *, least: bool) -> str:
    """Return the least, or the greatest, sequence with R or L in the place of each ?.

    At each ? it has the symbol that makes it smaller, or larger, whatever follows.
    """
    found = ""
    for symbol in symbols:
        even = found.count("R") % 2 == 0
        found += ("L" if even == least else "R") if symbol == "?" else symbol
    return found


def slopes(symbols: str, bits: int) -> tuple[Fraction, Fraction]:
    """Return slopes (s, s'), multiples of 2^-bits, of tent maps that are certainly smaller, larger.

    As close as the symbols allow; s = 1 where no tent map is smaller, s' = 1 where the entropy
    certainly is zero.
    """
    if compared(symbols, doubling()) < 0:
        return Fraction(1), Fraction(1)
    lower, upper, unit = Fraction(1), Fraction(2), Fraction(1, 2**bits)
    undecided: Fraction | None = None
    while undecided is None and upper - lower > unit:
        middle = (lower + upper) / 2
        sign = compared(symbols, tent(interval.ball(middle)))
        lower, upper = (middle if sign > 0 else lower), (middle if sign < 0 else upper)
        undecided = middle if sign == 0 else None
    if undecided is None:
        return lower, upper
    return _last(symbols, lower, undecided, 1, unit), _last(symbols, upper, undecided, -1, unit)


def _last(symbols: str, good: Fraction, bad: Fraction, sign: int, unit: Fraction) -> Fraction:
    """Return nearly the last slope from ``good`` towards ``bad`` with this comparison."""
    while abs(good - bad) > unit:
        middle = (good + bad) / 2
        decided = compared(symbols, tent(interval.ball(middle))) == sign
        good, bad = (middle, bad) if decided else (good, middle)
    return good
