"""Kneading sequences of unimodal maps of an interval, and their order.

Let G be a unimodal map of an interval I into its interior; R the branch on which it decreases, L
that on which it increases.

*Order.*  Two sequences are compared at their first difference: L < R if an even number of R comes
before it, R < L if an odd one.  Let h be the topological entropy of G on I, T_s(y) = s min(y, 1 -
y) on [0, 1], 1 < s <= 2.  Then h(T_s) = log s, and entropy is a monotone function of the kneading
sequence [Milnor, Thurston]: if that of G is larger than that of T_s, h >= log s; if smaller, h <=
log s.  (The theorem is about maps that take the ends of an interval to one end of it.  Let J be a
larger interval, and continue G, with a maximum, say, linearly to J so that both ends of J go to the
lower one, e.  As G(I) lies inside I, points outside of I, but for e, move into I sooner or later:
for x below I, x < G(x) < the maximum of G on I, and points above I go below it or into it.  So no
entropy is added.) If it is smaller than RLRRRLRL.., the limit of the sequences of period doubling,
h = 0: all those of tent maps with s > 1 are larger.  The sequence of that limit begins with K, s, K
if it begins with K, 2^n - 1 symbols, where s is L if R is in K an odd number of times, else R.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fractions import Fraction

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected, need

_HALF = Fraction(1, 2)


def order(symbols: Iterable[str], other: Iterator[str]) -> int:
    """Return 1 if a sequence that begins with the symbols is larger than the other one, else -1."""
    even = True
    for mine, its in zip(symbols, other, strict=False):
        if mine != its:
            return 1 if (mine == "R") == even else -1
        even = even if mine == "L" else not even
    raise Rejected("the kneading sequence is too short to be compared")


def doubling() -> Iterator[str]:
    """Yield the limit of the kneading sequences of period doubling."""
    known, n = "R", 0
    while True:
        if n == len(known):
            known += ("L" if known.count("R") % 2 else "R") + known
        yield known[n]
        n += 1


def tent(slope: Interval) -> Iterator[str]:
    """Yield the kneading sequence of all tent maps with slopes in an interval."""
    need(slope.lies_in(Fraction(1), Fraction(2)), "no tent map has such an entropy")
    y = slope / 2
    while True:
        left, right = y.upper < _HALF, y.lower > _HALF
        need(left or right, "the kneading sequence of a tent map is not decided")
        yield "L" if left else "R"
        y = slope * y if left else slope * (-y + 1)
