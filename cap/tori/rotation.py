"""Quadratic irrationals in (0, 1), by their continued fractions, and how badly they are approached.

α = [0; a1, a2, ...], the quotients after a head periodic.  With q_(-1) = 0, q_0 = 1, q_n = a_n
q_(n-1) + q_(n-2) and the complete quotients A_n = [a_n; a_(n+1), ...],

    |q_n α - p_n| = 1/(q_n A_(n+1) + q_(n-1)),   dist(kα, Z) >= |q_n α - p_n|  for 0 < k < q_(n+1):

so k dist(kα, Z) >= 1/(A_(n+1) + q_(n-1)/q_n) for q_n <= k < q_(n+1).  (Khinchin, Continued
Fractions, Theorems 9 and 17.)  After the head, A_(n+1) is one of a few, and q_(n-1)/q_n <= 1.
"""

from dataclasses import dataclass
from fractions import Fraction
from itertools import cycle, islice

from cap.sets import interval
from cap.sets.interval import Ball

AHEAD = 40  # quotients from which the complete ones are enclosed


@dataclass(frozen=True)
class Quadratic:
    """The number [0; head, period, period, ...]; all quotients positive."""

    head: tuple[int, ...]
    period: tuple[int, ...]

    def __str__(self) -> str:
        """Return it as it is written: [0;3,(1)]."""
        return f"[0;{''.join(f'{a},' for a in self.head)}({','.join(map(str, self.period))})]"

    def quotients(self, first: int, count: int) -> list[int]:
        """Return a_first, ... ; the first of all is a_1."""
        endless = (*self.head, *self.period) if first <= len(self.head) else ()
        if endless:
            return [*self.head[first - 1 :], *islice(cycle(self.period), count)][:count]
        start = (first - 1 - len(self.head)) % len(self.period)
        return list(islice(cycle(self.period), start, start + count))

    def complete(self, n: int) -> tuple[Fraction, Fraction]:
        """Return numbers on both sides of A_n."""
        *others, last = self.quotients(n, AHEAD)
        a, b = (_finite([*others, end]) for end in (last, last + 1))
        return min(a, b), max(a, b)

    def value(self) -> Ball:
        """Return an enclosure at the working precision."""
        p, q, n, most = (1, 0), (0, 1), 1, 2 ** (interval.working_bits() // 2 + 4)
        while q[1] < most:
            for a in self.quotients(n, AHEAD):
                p, q = (p[1], a * p[1] + p[0]), (q[1], a * q[1] + q[0])
            n += AHEAD
        return interval.hull(*(interval.ball(Fraction(p[k], q[k])) for k in (0, 1)))

    def diophantine(self) -> Fraction:
        """Return γ > 0 with dist(kα, Z) >= γ/k for all k > 0."""
        q, least = (0, 1), Fraction(1)
        for n, a in enumerate(self.head):
            least = min(least, 1 / (self.complete(n + 1)[1] + Fraction(*q)))
            q = q[1], a * q[1] + q[0]
        m = len(self.head)
        tail = max(self.complete(m + 1 + j)[1] for j in range(len(self.period)))
        return min(least, 1 / (tail + 1))


def _finite(quotients: list[int]) -> Fraction:
    """Return [a; b, ...]."""
    *others, last = quotients
    value = Fraction(last)
    for a in reversed(others):
        value = a + 1 / value
    return value
