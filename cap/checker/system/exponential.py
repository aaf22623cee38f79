"""exp(M d) for a matrix M of rational numbers: rows of it at a point, and over an interval.

*At a point* d: the i-th row of exp(M d) is the sum of the rows T_0 = the i-th unit row and T_j =
T_(j-1) M d/j.  The loop computes them in units 2^-p, each entry rounded to nearest.  Let c be the
largest column sum of |M|, so that no entry of a row times M is above c times the largest entry of
that row; a = c |d| and m = 2 floor(a) + 2 > 2 a.  The errors e_j <= e_(j-1) a/j + 1/2 are at most

    e_j <= (1/2) sum over i < j of a^i/i! < e^a/2 < 2^m,

for (j - i)!/j! <= 1/i!.  The loop ends with j = N when T_N, as computed, is 0 and N >= m.  So the
true T_N is below 2^m, and each later one at most half of the one before, as a/(N + 1) < 1/2:
together below 2^(m+1).  With the N terms before, the sum is wrong by less than (N + 2) 2^m.

*Over an interval* [a, b], R_k = (unit row) exp(M t) M^k has the derivative R_(k+1).  An entry of
R_k whose derivative has one sign lies between its values at the ends; any other one lies, by the
mean value theorem, in its value at a + (its derivatives) [0, b - a].  For the last R_(k+1) needed,
let D = [0, b - a] and z = c (b - a) <= 1:

    R_0(t) lies in R_0(a) (1 + M D + M^2 D^2/2) + [-r, r],    r = |R_0(a)| z^3/2,

where |.| is the largest entry, as z^3/3! + z^4/4! + ... <= (z^3/6) e^z <= z^3/2.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import lcm

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need

MOST = 200  # of c |d|
Row = list[Interval]


class Exponential:
    """The rows of exp(M d) at a precision; those at points are kept."""

    def __init__(self, M: Sequence[Sequence[Fraction]], bits: int) -> None:
        self.bits = bits
        self.common = lcm(*(x.denominator for row in M for x in row))
        columns = [[(k, row[j]) for k, row in enumerate(M) if row[j]] for j in range(len(M))]
        self.columns = [[(k, int(x * self.common)) for k, x in column] for column in columns]
        self.norm = max(sum((abs(x) for _, x in column), Fraction(0)) for column in columns)
        self._known = dict[tuple[int, int], Row]()

    def over(self, i: int, d: Interval, order: int = 0) -> list[Row]:
        """Return enclosures of the i-th row of M^k exp(M t) for all t in d, k = 0, ..., order."""
        left, right = (self._rates(self.at(i, z), order) for z in (d.lo, d.hi))
        if d.lo == d.hi:
            return left
        span = Interval(0, d.hi - d.lo, self.bits)
        above = self._rates(self._whole(left[0], span), order + 1)[-1]
        rows = list[Row]()
        for a, b in zip(reversed(left), reversed(right), strict=True):
            above = [_between(*entry, span) for entry in zip(a, b, above, strict=True)]
            rows.append(above)
        return rows[::-1]

    def at(self, i: int, z: int) -> Row:
        """Return the i-th row at the point z 2^-bits."""
        if (i, z) not in self._known:
            self._known[i, z] = self._at(i, z)
        return self._known[i, z]

    def _at(self, i: int, z: int) -> Row:
        """Return the sum of the series."""
        a = self.norm * abs(z)
        need(a <= MOST << self.bits, "a flight is too long for an exponential")
        m = 2 * (int(a) >> self.bits) + 2
        p = self.bits + m + 16
        term = [int(i == j) << p for j in range(len(self.columns))]
        total, j = [0] * len(term), 0
        while any(term) or j < m:
            total = [s + t for s, t in zip(total, term, strict=True)]
            j += 1
            term = self._next(term, z, self.common * j << self.bits)
        error = (j + 2) << m
        return [Interval(s - error, s + error, p).with_bits(self.bits) for s in total]

    def _next(self, term: list[int], z: int, unit: int) -> list[int]:
        """Return T M z/unit, rounded to nearest."""
        sums = (sum(term[k] * x for k, x in column) for column in self.columns)
        return [(2 * z * s + unit) // (2 * unit) for s in sums]

    def _rates(self, row: Row, order: int) -> list[Row]:
        """Return the row, and the row times M, ..., M^order."""
        rows = [row]
        for _ in range(order):
            rows.append(self._times(rows[-1]))
        return rows

    def _times(self, row: Row) -> Row:
        """Return the row times M."""
        zero = row[0].integer(0)
        sums = (sum((row[k] * x for k, x in column), zero) for column in self.columns)
        return [s / self.common for s in sums]

    def _whole(self, first: Row, span: Interval) -> Row:
        """Return an enclosure of a row times exp(M t), t in [0, b - a]."""
        z = self.norm * span.upper
        need(z <= 1, "a piece of a flight is too long for an exponential")
        _, slope, bend = self._rates(first, 2)
        r = int(max(x.magnitude().hi for x in first) * z**3 / 2) + 1
        terms = zip(first, slope, bend, strict=True)
        far, half = Interval(-r, r, self.bits), span.square() / 2
        return [x + y * span + w * half + far for x, y, w in terms]


def _between(left: Interval, right: Interval, slope: Interval, span: Interval) -> Interval:
    """Return an enclosure of a function from its values at both ends and its derivative."""
    if slope.lo >= 0 or slope.hi <= 0:
        return Interval(min(left.lo, right.lo), max(left.hi, right.hi), left.bits)
    return left + slope * span
