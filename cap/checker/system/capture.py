"""Capture: infinitely many hits of a guard of a given system accumulate, and it rests.

*A wall* is a guard h of a mode D, in which h falls; h' = L h is its derivative.  After a hit h
rises in a mode U, which may be D.  What the lemma of ``chatter`` asks for is read from the data:

- h' = L h in U too, an identity.  h and h' are linear in two variables of the state, with numbers
  as coefficients and a determinant that is not 0.  So these two are polynomials in h, h', the other
  variables and the clock, and so is every polynomial in the state.
- The reset at h = 0: h stays 0, h' becomes -e h', the other variables stay; identities modulo h.
- If U is not D, a guard c h', c > 0, ends each rise: it changes no variable, an identity modulo h',
  it leads to D, and it names no other mode of rest than R; one of D is c h', c < 0, so that h' < 0
  there.
- All other guards of U are positive where 0 <= h <= H_B, 0 <= h' <= q_B, those of D where h' <= 0.
- Of all modes to which a hit leads, but U, one guard is negative where h = 0 and 0 <= h' <= q_B, or
  is c h', c < 0; of those at the turn, but D, one is negative where h' = 0.

*Other variables* do not jump.  With rates in [a, b] as long as they lie in a box Z, they have moved
by at most [a, b] times the time that has passed; if this keeps them inside Z, they do not leave it.

*The rest.*  In the mode R that the guard names, L h and L h' vanish where h = h' = 0, identities:
h = h' = 0 stays as long as R lasts, and all guards of R are positive until a time.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction
from itertools import combinations, pairwise
from typing import NamedTuple

from cap.checker.kernel.arctangent import pi
from cap.checker.kernel.elementary import cos_sin
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import TooCoarse, need
from cap.checker.system.chatter import Pull, States
from cap.checker.system.evaluation import Values
from cap.checker.system.model import COS, PI, SIN, Guard, Model
from cap.checker.system.polynomial import ZERO, Polynomial, variable

HEIGHT, RATE = "(h)", "(h')"  # no names of variables
DEGREE, TERMS, TO = 3, 16, 8  # of resets; of h and h'; modes after a hit
NONE: Mapping[str, Polynomial] = {HEIGHT: ZERO, RATE: ZERO}

Known = Mapping[str, Interval]


class Modes(NamedTuple):
    """The mode in which h falls, with its guard h, and that in which h rises."""

    falling: str
    guard: str
    rising: str


class Wall:
    """A guard h and h' as coordinates; the identities hold, the numbers are not yet looked at."""

    def __init__(self, model: Model, modes: Modes, e: Fraction) -> None:
        falling, guard, rising = modes
        known = {falling, rising} <= {*model.modes} and guard in model.modes[falling].guards
        need(known, "there is no such guard, or mode")
        self.model, self.modes, self.event = model, modes, model.modes[falling].guards[guard]
        need(self.event.rest is not None, f"the guard {guard} of {falling} names no mode of rest")
        self.rest = str(self.event.rest)
        self.h, self.rate = self.event.value, model.lie(falling, self.event.value)
        need(model.lie(rising, self.h) == self.rate, f"h' is not the same in {rising}")
        short = len(self.h.terms) <= TERMS and len(self.rate.terms) <= TERMS
        need(short, f"h or h' has more than {TERMS} terms")
        few = len(self.event.to) <= TO
        need(few, f"a hit leads to more than {TO} modes")
        self.state = self._solved()
        self._hit(e)
        self.turn = None if rising == falling else self._turn()
        kept = (self.at(model.lie(self.rest, q), NONE) for q in (self.h, self.rate))
        need(not any(q.terms for q in kept), f"h or h' does not stay 0 in {self.rest}")

    def _solved(self) -> dict[str, Polynomial]:
        """Return two variables of the state as polynomials in h, h' and the others."""
        for p, q in combinations(self.model.state, 2):
            (a, b), (c, d) = ([f.derivative(z) for z in (p, q)] for f in (self.h, self.rate))
            if not all(slope.terms.keys() <= {()} for slope in (a, b, c, d)):
                continue
            det = a.number * d.number - b.number * c.number
            if det:
                self.others = tuple(z for z in self.model.state if z not in (p, q))
                H = variable(HEIGHT) - self.h.without((p, q))
                G = variable(RATE) - self.rate.without((p, q))
                return {p: (d * H - b * G) * (1 / det), q: (a * G - c * H) * (1 / det)}
        need(ok=False, why="h and h' are not linear in two variables of the state")
        return {}

    def at(self, q: Polynomial, where: Mapping[str, Polynomial]) -> Polynomial:
        """Return a polynomial in the state as one in h, h', where some of them are known."""
        return q.substituted(self.state).substituted(where)

    def _hit(self, e: Fraction) -> None:
        """Prove that a hit makes h' to -e h', and changes nothing else."""
        at, guard = {HEIGHT: ZERO}, self.event
        after, divisor = self._after(guard)
        same = all(after[z] == variable(z) * divisor for z in self.others)
        need(same, "a hit changes another variable")
        h, rate = (self._composed(q, after, divisor) for q in (self.h, self.rate))
        need(not self.at(h, at).terms, "h is not 0 after a hit")
        wrong = self.at(rate + self.rate * (e * divisor), at)
        need(not wrong.terms, "h' after a hit is not -e times that before it")

    def _turn(self) -> str:
        """Return the guard that ends a rise; prove that it changes nothing, and leads to D."""
        falling, _, rising = self.modes
        ends = [key for key, c in self._multiples(rising, self.rate) if c > 0]
        need(len(ends) == 1, f"not one guard of {rising} is h' times a positive number")
        begins = any(c < 0 for _, c in self._multiples(falling, self.rate))
        need(begins, f"no guard of {falling} is h' times a negative number")
        guard = self.model.modes[rising].guards[ends[0]]
        need(falling in guard.to, f"{ends[0]} of {rising} does not lead to {falling}")
        one = guard.rest in (None, self.rest)  # infinitely many hits have as many turns
        need(one, f"{ends[0]} of {rising} names another mode of rest than {self.rest}")
        after, divisor = self._after(guard)
        changes = (after[z] - variable(z) * divisor for z in self.model.state)
        same = not any(self.at(q, {RATE: ZERO}).terms for q in changes)
        need(same, f"{ends[0]} of {rising} changes the state")
        return ends[0]

    def _after(self, guard: Guard) -> tuple[dict[str, Polynomial], Fraction]:
        """Return the state after an event times a number, and this number."""
        divisor = guard.divisor.number
        need(guard.divisor == Polynomial.of(divisor), "what divides a reset is no rational number")
        low = all(len(m) <= DEGREE for q in guard.reset.values() for m in q.terms)
        need(low, f"a reset has a degree above {DEGREE}")
        state = {z: variable(z) * divisor for z in self.model.state}
        return state | dict(guard.reset), divisor

    def _composed(
        self, q: Polynomial, after: Mapping[str, Polynomial], divisor: Fraction
    ) -> Polynomial:
        """Return q after an event, times the divisor; q is linear in the state."""
        rest, total = q.without(self.model.state), ZERO
        for z in self.model.state:
            slope = q.derivative(z)
            need(slope.variables <= {PI}, "h or h' is not linear in the state")
            total += slope * after[z]
        return total + rest * divisor

    def _multiples(self, mode: str, q: Polynomial) -> Iterator[tuple[str, Fraction]]:
        """Give the guards of a mode that are c q, c a number, with c."""
        monomial, leading = next(iter(q.terms.items()))
        for key, guard in self.model.modes[mode].guards.items():
            c = guard.value.terms.get(monomial, Fraction(0)) / leading
            if c and guard.value == q * c:
                yield key, c

    def positive(self, mode: str) -> Iterator[tuple[str, Polynomial]]:
        """Give the guards of U or D that have to be positive, by numbers."""
        falling, guard, rising = self.modes
        clear = (
            {guard}
            if mode == falling
            else {key for key, c in self._multiples(mode, self.h) if c > 0}
        )
        if rising != falling:
            sign = 1 if mode == rising else -1
            clear |= {key for key, c in self._multiples(mode, self.rate) if c * sign > 0}
        for key, other in self.model.modes[mode].guards.items():
            if key not in clear:
                yield key, other.value

    def is_above(self, mode: str) -> bool:
        """Return whether h is positive where the guards of U or D are."""
        above = mode == self.modes.falling
        return above or any(c > 0 for _, c in self._multiples(mode, self.h))

    def rested(self) -> dict[str, Polynomial]:
        """Return the guards of R where h = h' = 0."""
        guards = self.model.modes[self.rest].guards
        return {key: self.at(g.value, NONE) for key, g in guards.items()}

    def falls_at_hits(self, mode: str) -> bool:
        """Return whether a guard of a mode is c h', c < 0: it is negative after a hit."""
        return any(c < 0 for _, c in self._multiples(mode, self.rate))


class Numbers:
    """Numbers for a wall: those of the clock, and of polynomials."""

    def __init__(self, wall: Wall, bits: int) -> None:
        self.wall, self.bits = wall, bits
        self.one, self.pi = Interval.enclosing(1, 1, bits), pi(bits)
        self.omega = self.values({}).of(wall.model.frequency)

    def values(self, known: Known) -> Values[Interval]:
        """Return values, with those of pi."""
        return Values({PI: self.pi, **known}, self.one)

    def clock(self, when: tuple[Fraction, Fraction]) -> dict[str, Interval]:
        """Return cos and sin during some time."""
        cos, sin = cos_sin(Interval.enclosing(*when, self.bits) * self.omega)
        return {COS: cos, SIN: sin}


class Near(Numbers):
    """Numbers near a wall: where the heights, rates and other variables are, and when."""

    def __init__(self, wall: Wall, bits: int, inside: States, others: Known) -> None:
        super().__init__(wall, bits)
        self.inside, self.others = inside, others
        self._written: dict[Polynomial, Polynomial] = {}

    def over(self, q: Polynomial, clock: Known, height: int = 1, signs: str = "+-") -> Interval:
        """Return an enclosure of q where h <= H_B, or h = 0, and h' has a sign of these or is 0."""
        up, down = (self.inside.speed.hi if sign in signs else 0 for sign in "+-")
        known = {
            HEIGHT: Interval(0, self.inside.height.hi * height, self.bits),
            RATE: Interval(-down, up, self.bits),
        }
        if q not in self._written:
            self._written[q] = q.substituted(self.wall.state)
        return self.values({**known, **clock, **self.others}).of(self._written[q])

    def pull(self, clock: Known) -> Pull:
        """Return the bounds of -h''."""
        falling, _, rising = self.wall.modes
        lie, rate = self.wall.model.lie, self.wall.rate
        up = -self.over(lie(rising, rate), clock, signs="+")
        down = -self.over(lie(falling, rate), clock, signs="-")
        low, high = (Interval(x, x, self.bits) for x in (down.lo, down.hi))
        return Pull(Interval(up.lo, up.lo, self.bits), low, high)

    def strongest(self, clock: Known) -> Interval:
        """Return an upper bound of -h''."""
        falling, _, rising = self.wall.modes
        parts = [
            -self.over(self.wall.model.lie(m, self.wall.rate), clock) for m in (falling, rising)
        ]
        most = max(x.hi for x in parts)
        return Interval(most, most, self.bits)

    def confirm_alone(self, clock: Known) -> None:
        """Prove that no other event happens, and which modes follow."""
        falling, _, rising = self.wall.modes
        for mode, sign in ((rising, "+"), (falling, "-")):
            for key, q in self.wall.positive(mode):
                clear = self.over(q, clock, signs=sign).is_positive()
                need(clear, f"{key} of {mode} may come to 0")
        for mode in self.wall.event.to:
            shut = (
                mode == rising or self.wall.falls_at_hits(mode) or self._shut(mode, clock, 0, "+")
            )
            need(shut, f"the mode {mode} may be open after a hit")
        need(rising in self.wall.event.to, f"a hit does not lead to {rising}")
        if self.wall.turn is not None:
            for mode in self.wall.model.modes[rising].guards[self.wall.turn].to:
                shut = mode == falling or self._shut(mode, clock, 1, "")
                need(shut, f"the mode {mode} may be open where h' is 0")

    def _shut(self, mode: str, clock: Known, height: int, signs: str) -> bool:
        """Return whether a guard of a mode is negative there."""
        guards = self.wall.model.modes[mode].guards.values()
        return any((-self.over(g.value, clock, height, signs)).is_positive() for g in guards)

    def confirm_others(self, begin: Known, clock: Known, duration: Fraction) -> None:
        """Prove that the other variables do not leave their box, in D, U and R."""
        passed = Interval.enclosing(0, duration, self.bits)
        for mode in dict.fromkeys((*self.wall.modes[::2], self.wall.rest)):
            field = self.wall.model.modes[mode].field
            for z in self.wall.others:
                at = (self.over(field[z], clock) * passed) + begin[z]
                box = self.others[z]
                need(box.lo < at.lo and at.hi < box.hi, f"{z} may leave its box")

    # the rest

    def confirm_held(self, cuts: list[Fraction]) -> None:
        """Prove that the guards of R are positive between the first and the last of these times.

        On each piece a guard is positive, or it falls and is at the end, or rises and is at first.
        """
        model, rest = self.wall.model, self.wall.rest
        for key, q in self.wall.rested().items():
            rate = self.wall.at(model.lie(rest, q), NONE)
            for a, b in pairwise(cuts):
                if not self._held(q, rate, a, b):
                    raise TooCoarse(f"{key} of {rest} may come to 0 between {a} and {b}")

    def _held(self, q: Polynomial, rate: Polynomial, a: Fraction, b: Fraction) -> bool:
        values = self.values({**self.clock((a, b)), **self.others})
        if values.of(q).is_positive():
            return True
        slope = values.of(rate)
        ends = [b] if (-slope).is_positive() else [a] if slope.is_positive() else []
        return any(self.rested(q, t).is_positive() for t in ends)

    def rested(self, q: Polynomial, t: Fraction) -> Interval:
        """Return a guard of R at a time."""
        return self.values({**self.clock((t, t)), **self.others}).of(q)
