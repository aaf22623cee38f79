"""A guard stays positive on a leg, by two lemmas; nothing is searched.

Let h be a guard along the flights of a mode from t_0 to t_1, each known in an interval.  Here h is
what the formula of the flights has, beyond their ends, too.

*Lemma M.*  If L h = -c g, c > 0, or L h = -(g + g'), for other guards of the mode that stay
positive between t_0 and t_1, h falls there: it is positive before t_1 if it is positive or 0 then.

*Lemma B, for given cuts.*  Cut the time from the least t_0 to the greatest t_1 into pieces.  On a
piece [a, b] let m <= L^2 h <= M, M > 0, m < 0, and s = b - a.

1. *A chord.*  h differs from its chord by less than M s^2/8 below: h > 0 if h(a) and h(b) are above
   M s^2/8; if L^2 h <= 0 all over the piece, if both are positive.
2. *A tangent.*  h(t) >= h(a) + L h(a) (t - a) + m (t - a)^2/2 by Taylor's formula, so h > 0 if the
   least of this at t = a and, with the last two terms replaced by min(0, L h(a)) s + m s^2/2, at b
   is; and so from b backwards.
3. *At the start*, where h(t_0) = 0: h > 0 after t_0 on the first piece, if L h(t_0) + m s/2 > 0 by
   the same formula; or if h(b) > 0 and L^2 h <= 0, so that h is concave.  If L h(t_0) = 0, too, if
   L^2 h > 0 on the piece.
4. *At the end*, where h(t_1) = 0: the same backward in time.

So h > 0 strictly between t_0 and t_1, and at those ends where it does not vanish.  If it is so for
all guards of the mode, the flights are orbits of the system until t_1.

*What vanishes after an event.*  Where the guard g comes to zero, the state z becomes R(z)/D.  If
D^k h(R/D) is a constant times D^k g, as polynomials, h vanishes after the event; and so for L h,
and so on.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import lru_cache
from itertools import combinations, pairwise
from typing import NamedTuple, Protocol

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import TooCoarse, need
from cap.checker.system.model import Guard, Model
from cap.checker.system.polynomial import ONE, ZERO, Polynomial

WORK = 20_000  # terms to be multiplied


class Flights(Protocol):
    """Flights of a mode, each from a time in the interval ``start`` on."""

    @property
    def start(self) -> Interval:
        """The times at which they begin."""

    def over(self, g: Polynomial, t: Interval) -> Interval:
        """Return a polynomial in the state at all times of an interval, for all of the flights."""

    def begun(self, g: Polynomial) -> Interval:
        """Return a polynomial in the state, for each of the flights where it begins."""


class Watched(NamedTuple):
    """A guard h of a mode, L h and L^2 h."""

    h: Polynomial
    rate: Polynomial
    bend: Polynomial

    @classmethod
    def of(cls, model: Model, mode: str, h: Polynomial) -> Watched:
        """Return them."""
        rate = model.lie(mode, h)
        return cls(h, rate, model.lie(mode, rate))


@lru_cache(maxsize=256)
def watched(model: Model, mode: str) -> Mapping[str, Watched]:
    """Return the guards of a mode; they are kept."""
    guards = model.modes[mode].guards
    return {key: Watched.of(model, mode, guard.value) for key, guard in guards.items()}


@lru_cache(maxsize=512)
def vanishing(model: Model, mode: str, guard: str, to: str) -> Mapping[str, int]:
    """Return how many of h, L h of the guards of a mode ``to`` vanish after an event; it is kept.

    The event is that of a guard of the first mode.
    """
    event = model.modes[mode].guards[guard]
    return {key: zeros_after(h, event) for key, h in watched(model, to).items()}


@lru_cache(maxsize=1024)
def falls(h: Watched, others: tuple[Watched, ...]) -> bool:
    """Return whether Lemma M holds for h and one of the others, or the sum of two."""
    listed = [other.h for other in others]
    one = any((c := _factor(-h.rate, g)) is not None and c > 0 for g in listed)
    return one or any(-h.rate == a + b for a, b in combinations(listed, 2))


def ends_positive(flights: Flights, h: Watched, end: Interval, zeros: tuple[int, int]) -> None:
    """Prove Lemma M's h > 0 at the end, if it does not vanish there, nor at the start."""
    first, last = zeros
    need(not first, "a guard falls from zero")
    need(last > 0 or flights.over(h.h, end).is_positive(), "a guard may vanish before the end")


def stays_positive(
    flights: Flights,
    h: Watched,
    end: Interval,
    cuts: Sequence[Fraction],
    zeros: tuple[int, int] = (0, 0),
    window: Interval | None = None,
) -> None:
    """Prove that a guard stays positive until each flight ends, at a time in ``end``.

    So many of h, L h, ... vanish at the start and at the end, 0 to 2 of them, as ``zeros`` says.
    One of the pieces may be a window, in which nothing is proved.
    """
    first, last = zeros
    pieces = _pieces(flights.start, end, cuts)
    if window:
        inner = any(_is(piece, window) for piece in pieces[1:-1])
        need(inner, "the window is none of the pieces of its leg")
    if len(pieces) < bool(first) + bool(last):
        raise TooCoarse("a guard is 0 at both ends of a piece")
    for k, piece in enumerate(pieces):
        at_start, at_end = k == 0, k + 1 == len(pieces)
        if window and _is(piece, window):
            continue
        why = _not_positive(flights, h, piece, end, (first * at_start, last * at_end))
        if why:
            raise TooCoarse(why)


def halved(flights: Flights, h: Watched, end: Interval, zeros: tuple[int, int], most: int) -> int:
    """Prove the same without cuts; return the number of pieces looked at, at most ``most``.

    Pieces that are not seen to be positive are halved.
    """
    first, last = zeros
    ends = flights.start.lo, end.hi
    waiting, count = [ends], 0
    while waiting:
        a, b = waiting.pop()
        here = first * (a == ends[0]), last * (b == ends[1])
        count += 1
        need(count <= most, "a guard needs too many pieces of a flight")
        piece = Interval(a, b, end.bits)
        if all(here) or not _is_seen(flights, h, piece, end, here):
            m = (a + b) >> 1
            need(flights.start.hi < m < end.lo, "a guard may vanish near the end of a flight")
            waiting += [(m, b), (a, m)]
    return count


def _is_seen(
    flights: Flights, h: Watched, piece: Interval, end: Interval, zeros: tuple[int, int]
) -> bool:
    """Return whether a guard is seen to be positive on a piece; it may be too long for that."""
    try:
        return not _not_positive(flights, h, piece, end, zeros)
    except TooCoarse:
        return False


def _not_positive(
    flights: Flights, h: Watched, piece: Interval, end: Interval, zeros: tuple[int, int]
) -> str:
    """Return where on a piece h may vanish, or nothing if it does not.

    On a first piece so many of h, L h vanish at the start, on a last one at the end.
    """
    on, (first, last) = Piece(flights, h, piece), zeros
    if first:
        shown, place = on.leaves(flights.start, first, 1), "again just after the start"
    elif last:
        shown, place = on.leaves(end, last, -1), "already before the end"
    else:
        shown = on.by_chord() or on.by_tangent()
        place = f"near {float(piece.midpoint().lower):.6g}"
    return "" if shown else f"a guard may vanish {place}"


class Piece:
    """A guard on a piece of a leg."""

    def __init__(self, flights: Flights, h: Watched, piece: Interval) -> None:
        self.flights, self.h = flights, h
        self.a = Interval(piece.lo, piece.lo, piece.bits)
        self.b = Interval(piece.hi, piece.hi, piece.bits)
        self.bend = flights.over(h.bend, piece)
        self.length = self.b - self.a
        self.dip = self.length.square() * Interval(min(self.bend.lo, 0), 0, piece.bits) / 2

    @property
    def concave(self) -> bool:
        """Whether L^2 h <= 0 on it."""
        return self.bend.hi <= 0

    def by_chord(self) -> bool:
        """Return whether 1 holds."""
        above = Interval(0, max(self.bend.hi, 0), self.a.bits)
        sag = self.length.square() * above / 8
        heights = (self.flights.over(self.h.h, t) - sag for t in (self.a, self.b))
        return all(height.is_positive() for height in heights)

    def by_tangent(self) -> bool:
        """Return whether 2 holds, at one of the ends."""
        for t, sign in ((self.a, 1), (self.b, -1)):
            rate = self.flights.over(self.h.rate, t) * sign
            down = Interval(min(rate.lo, 0), 0, rate.bits) * self.length
            if (self.flights.over(self.h.h, t) + down + self.dip).is_positive():
                return True
        return False

    def leaves(self, at: Interval, zeros: int, sign: int) -> bool:
        """Return whether 3 holds at the start, ``sign`` = 1, or 4 at the end, ``sign`` = -1."""
        if zeros == 2:
            return self.bend.is_positive()
        first, flights = sign > 0, self.flights
        rate = flights.begun(self.h.rate) if first else -flights.over(self.h.rate, at)
        fall = self.length * Interval(min(self.bend.lo, 0), 0, rate.bits) / 2
        other = self.b if first else self.a
        concave = self.concave and self.flights.over(self.h.h, other).is_positive()
        return (rate + fall).is_positive() or concave


def _is(piece: Interval, window: Interval) -> bool:
    return (piece.lo, piece.hi) == (window.lo, window.hi)


def _pieces(start: Interval, end: Interval, cuts: Sequence[Fraction]) -> list[Interval]:
    """Return the pieces, which abut."""
    ends = [start.lower, *cuts, end.upper]
    need(all(a < b for a, b in pairwise(ends)), "the cuts of a leg are not in order")
    return [Interval.enclosing(a, b, start.bits) for a, b in pairwise(ends)]


def zeros_after(h: Watched, event: Guard) -> int:
    """Return how many of h, L h vanish in a mode just after an event."""
    found = 0
    for g in (h.h, h.rate):
        if not _vanishes(g, event):
            return found
        found += 1
    return found


def _vanishes(h: Polynomial, event: Guard) -> bool:
    """Return whether D^k h(R/D) is a constant times D^k g; no, if that is more than `WORK`."""
    found = after_event(h, event)
    if found is None:
        return False
    total, power = found
    return not total.terms or _factor(total, event.value * power) is not None


def after_event(h: Polynomial, event: Guard) -> tuple[Polynomial, Polynomial] | None:
    """Return D^k h(R/D), and D^k, just after an event; None if that is more than `WORK`."""
    jumps = {m: [z for z in m if z in event.reset] for m in h.terms}
    most = max(map(len, jumps.values()), default=0)
    degree = 0 if event.divisor == ONE else most
    sizes = [len(event.divisor.terms), *(len(q.terms) for q in event.reset.values())]
    if len(h.terms) * max(sizes) ** most > WORK:
        return None
    total, power = ZERO, _power(event.divisor, degree)
    for monomial, c in h.terms.items():
        term = Polynomial({tuple(z for z in monomial if z not in event.reset): c})
        for z in jumps[monomial]:
            term = term * event.reset[z]
        left = degree - len(jumps[monomial])
        total += term * _power(event.divisor, left) if degree else term
    return total, power


def _power(q: Polynomial, n: int) -> Polynomial:
    """Return q^n."""
    total = ONE
    for _ in range(n):
        total = total * q
    return total


def _factor(h: Polynomial, g: Polynomial) -> Fraction | None:
    """Return c if h is a constant c /= 0 times g."""
    if not h.terms:
        return None
    monomial, c = next(iter(h.terms.items()))
    divisor = g.terms.get(monomial)
    return c / divisor if divisor and h == g * (c / divisor) else None
