"""A wall of a system given as data: a guard h whose events make h' to -e h', with a mode of rest.

After an event, a hit, h rises in a mode U.  Where h' is L h in both modes, and h and h' are linear
in two variables of the state, with rational coefficients and a determinant that is not 0, these two
are polynomials in h, h', the other variables and the clock.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import combinations

from cap.errors import BadInput
from cap.system.model import System
from cap.system.polynomial import COS, PI, SIN, ZERO, Polynomial, Quotient, variable

HEIGHT, RATE = variable("(h)"), variable("(h')")  # no names of variables of a state


@dataclass(frozen=True)
class Wall:
    """A guard of D, the mode U after a hit, the mode of rest, and e; two variables by h and h'."""

    system: System
    falling: str
    guard: str
    rising: str
    rest: str
    e: Fraction
    solved: Mapping[str, Polynomial]

    @cached_property
    def h(self) -> Polynomial:
        """The guard."""
        return self.system.guard(self.falling, self.guard).value

    @cached_property
    def rate(self) -> Polynomial:
        """The derivative h' of h."""
        return self.system.lie(self.falling, self.h)

    @property
    def others(self) -> tuple[str, ...]:
        """The variables that h and h' do not give."""
        return tuple(z for z in self.system.state if z not in self.solved)

    def pull(self, mode: str) -> Polynomial:
        """Return -h'' in a mode, by h, h', the other variables and the clock."""
        return -self.system.lie(mode, self.rate).substituted(self.solved)

    def rested(self) -> dict[str, Polynomial]:
        """Return the guards of the mode of rest, where h = h' = 0."""
        guards = self.system.modes[self.rest].guards
        return {key: self.standing(guard.value) for key, guard in guards.items()}

    def standing(self, q: Polynomial) -> Polynomial:
        """Return a polynomial where h = h' = 0."""
        still = {"(h)": ZERO, "(h')": ZERO}
        return q.substituted(self.solved).substituted(still)


def wall(system: System, mode: str | None = None, guard: str | None = None) -> Wall:
    """Return the first wall of a system, of these names; `BadInput` says why there is none."""
    named = [
        (key, name)
        for key, each in system.modes.items()
        for name in each.guards
        if mode in (None, key) and guard in (None, name)
    ]
    if not named:
        raise BadInput(f"there is no guard {guard} of a mode {mode or 'of the system'}")
    resting = [at for at in named if system.guard(*at).rest is not None]
    if not resting:
        told = ", ".join(f"{name} of {key}" for key, name in named)
        raise BadInput(
            f"no guard names a mode of rest ({told}): what follows infinitely many of its events "
            "is not defined"
        )
    reasons = []
    for at in resting:
        try:
            return _wall(system, *at)
        except BadInput as reason:
            reasons.append(f"{at[1]} of {at[0]}: {reason}")
    raise BadInput("; ".join(reasons))


def _wall(system: System, mode: str, guard: str) -> Wall:
    """Return the wall of a guard that names a mode of rest."""
    h = system.guard(mode, guard).value
    rate = system.lie(mode, h)
    solved = _solved(system, h, rate)
    e = _restitution(system, (mode, guard), rate, solved)
    rising = [to for to in system.guard(mode, guard).to if system.lie(to, h) == rate]
    if not rising:
        raise BadInput("in no mode after an event its guard has the derivative that it had before")
    return Wall(system, mode, guard, rising[0], system.rest(mode, guard), e, solved)


def _solved(system: System, h: Polynomial, rate: Polynomial) -> Mapping[str, Polynomial]:
    """Return two variables of the state by h, h', the others and the clock."""
    for pair in combinations(system.state, 2):
        slopes = [q.derivative(z) for q in (h, rate) for z in pair]
        if all(slope.terms.keys() <= {()} for slope in slopes):
            a, b, c, d = (slope.terms.get((), Fraction(0)) for slope in slopes)
            if det := a * d - b * c:
                H, G = HEIGHT - h.without(*pair), RATE - rate.without(*pair)
                return {pair[0]: (d * H - b * G) * (1 / det), pair[1]: (a * G - c * H) * (1 / det)}
    raise BadInput("the guard and its derivative are not linear, with rational numbers, in two "
                   "variables of the state")  # fmt: skip


def _restitution(
    system: System, at: tuple[str, str], rate: Polynomial, solved: Mapping[str, Polynomial]
) -> Fraction:
    """Return e, where a hit makes h' to -e h'."""
    after = system.reset(*at)
    new = Quotient.of(rate.evaluated(after | _clock(), Quotient.of, variable(PI)))
    top, bottom, before = (
        q.substituted(solved).substituted({"(h)": ZERO})
        for q in (new.numerator, new.denominator, rate)
    )
    c = top.multiple_of(before * bottom)
    if c is None:
        raise BadInput("an event does not make the derivative of its guard to -e times it")
    if not 0 < -c <= 1:
        raise BadInput(
            f"restitution {-c}: only with 0 < e <= 1 infinitely many hits can accumulate"
        )
    return -c


def _clock() -> dict[str, Polynomial]:
    return {COS: variable(COS), SIN: variable(SIN)}
