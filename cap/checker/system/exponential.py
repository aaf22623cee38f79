"""exp(M d) for a matrix M of rational numbers: rows of it at a point, and over an interval.

*At a point* d = 2^s y, |y| <= 1: the i-th row of exp(M d) is the sum of the rows c_j y^j, c_j =
(the i-th unit row) (2^s M)^j/j!.  Let c be the largest column sum of |M|, so that no entry of a row
times M is above c times the largest entry of that row; with a = 2^s c no entry of c_j is above b_j
= a^j/j!.  The c_j are computed exactly, and rounded to nearest in units 2^-p; those from j = N on
are left out, where N >= 2a and b_N <= 2^-p: each b_j is at most half of the one before, so together
they are at most two units.  Horner's rule rounds each product with y down; an error is not enlarged
by the products after it.  So the sum is wrong by at most N/2 + N + 2 units.

*Over an interval* [a, b], R_k = (unit row) exp(M t) M^k has the derivative R_(k+1).  An entry of
R_k whose derivative has one sign lies between its values at the ends; any other one lies, by the
mean value theorem, in its value at a + (its derivatives) [0, b - a]; so does any one if b - a is so
small that R_k(b) is not computed.  For the last R_(k+1) needed, let D = [0, b - a] and z = c (b -
a) <= 1:

    R_0(t) lies in R_0(a) (1 + M D + M^2 D^2/2) + [-r, r],    r = |R_0(a)| z^3/2,

where |.| is the largest entry, as z^3/3! + z^4/4! + ... <= (z^3/6) e^z <= z^3/2.

*A nilpotent M.*  If M^N = 0, exp(M d) is a polynomial in d, and so are its rows, which are
evaluated by Horner's rule.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import lcm, perm

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import TooCoarse, need

MOST = 400  # of a
GUARD = 16  # p - bits
MOST_KNOWN = 10_000  # rows at points that are kept
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
        self._tables = dict[tuple[int, int], list[list[int]]]()
        powers = [self._powers(i, M) for i in range(len(M))]
        self._series = powers if all(not any(rows[-1]) for rows in powers) else None
        self._columns = dict[tuple[int, int], list[list[Interval]]]()

    def _powers(self, i: int, M: Sequence[Sequence[Fraction]]) -> list[list[Fraction]]:
        """Return the i-th row of M^j/j!, j = 0, 1, ..., until one is zero, or none will be."""
        none = Fraction(0)
        rows = [[Fraction(int(i == j)) for j in range(len(M))]]
        while any(rows[-1]) and len(rows) <= len(M):
            total = [none] * len(M)
            for x, row in zip(rows[-1], M, strict=True):
                if x:
                    total = [t + x * y if y else t for t, y in zip(total, row, strict=True)]
            rows.append([t / len(rows) if t else t for t in total])
        return rows

    def over(self, i: int, d: Interval, order: int = 0) -> list[Row]:
        """Return enclosures of the i-th row of M^k exp(M t) for all t in d, k = 0, ..., order."""
        if self._series:
            return [self._polynomial(i, d, k) for k in range(order + 1)]
        left = self._rates(self.at(i, d.lo), order)
        if d.lo == d.hi:
            return left
        span, narrow = Interval(0, d.width, self.bits), d.width < 1 << self.bits // 2
        right = left if narrow else self._rates(self.at(i, d.hi), order)
        above = self._rates(self._whole(left[0], span), order + 1)[-1]
        rows = list[Row]()
        for a, b in zip(reversed(left), reversed(right), strict=True):
            if narrow:
                above = [x + slope * span for x, slope in zip(a, above, strict=True)]
            else:
                above = [_between(*entry, span) for entry in zip(a, b, above, strict=True)]
            rows.append(above)
        return rows[::-1]

    @property
    def is_polynomial(self) -> bool:
        """Whether M is nilpotent."""
        return self._series is not None

    def polynomials(self, i: int, order: int) -> list[list[Interval]]:
        """Return the coefficients, highest power first, of the derivative of the i-th row.

        M is nilpotent.
        """
        if (i, order) not in self._columns:
            self._columns[i, order] = self._coefficients(i, order)
        return self._columns[i, order]

    def _polynomial(self, i: int, d: Interval, order: int) -> Row:
        """Return the derivative of some order of the i-th row, a polynomial in d."""
        found = Row()
        for first, *others in self.polynomials(i, order):
            for c in others:
                first = first * d + c  # noqa: PLW2901
            found.append(first)
        return found

    def _coefficients(self, i: int, order: int) -> list[list[Interval]]:
        """Return for each column the coefficients, that of the highest power first."""
        found = list[list[Interval]]()
        for column in zip(*(self._series or [])[i], strict=True):
            terms = [column[j] * perm(j, order) for j in range(order, len(column))] or [Fraction(0)]
            while len(terms) > 1 and not terms[-1]:
                terms.pop()
            found.append([Interval.enclosing(c, c, self.bits) for c in reversed(terms)])
        return found

    def at(self, i: int, z: int) -> Row:
        """Return the i-th row at the point z 2^-bits."""
        if (i, z) not in self._known:
            if len(self._known) == MOST_KNOWN:
                self._known.clear()
            s = max(0, abs(z).bit_length() - self.bits)
            if (i, s) not in self._tables:
                self._tables[i, s] = self._table(i, s)
            p, row = self.bits + GUARD, Row()
            for column in self._tables[i, s]:
                total = 0
                for c in column:
                    total = c + (total * z >> self.bits + s)
                error = 2 * len(column) + 2
                row.append(Interval(total - error, total + error, p).with_bits(self.bits))
            self._known[i, z] = row
        return self._known[i, z]

    def _table(self, i: int, s: int) -> list[list[int]]:
        """Return for each column its entries of c_(N-1), ..., c_0."""
        a, p = self.norm * 2**s, self.bits + GUARD
        need(a <= MOST, "a flight is too long for an exponential")
        power = [int(i == j) for j in range(len(self.columns))]  # c_j = power/divisor
        found, divisor, bound, j = list[list[int]](), 1, 1 << p, 0
        least = 2 * a
        while j < least or bound > 1:
            found.append([((x << p + 1) + divisor) // (2 * divisor) for x in power])
            j += 1
            sums = (sum(power[k] * x for k, x in column) for column in self.columns)
            power, divisor = [x << s for x in sums], divisor * self.common * j
            bound = -(-bound * a.numerator // (a.denominator * j))
        return [list(column) for column in zip(*reversed(found), strict=True)]

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
        if z > 1:
            raise TooCoarse("a piece of a flight is too long for an exponential")
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
