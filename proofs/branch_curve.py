"""The curve of asymmetric orbits at exact values of δ: where it passes what, as claims.

See `cap.proofs.branch`.
"""

from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import Any, NamedTuple

from cap.certificate import NONE
from cap.certificate.writer import Pair
from cap.errors import BadInput, NotProved, TooFewDigits
from cap.one_one.closed_form import Orbit, asymmetric
from cap.proofs.one_one import Scale, asymmetry
from cap.proofs.options import range_of_f
from cap.sets import bisection, interval
from cap.sets.interval import Ball
from cap.subdivision import Cell

MOST = 8  # the largest denominator of the resonances listed
WIDE = 12  # digits of what holds for a whole cell
LOW_ORDER = (Fraction(1, 4), Fraction(1, 3))  # with 1/2, where the pair ceases to be elliptic
LOWEST = Fraction(1, 50)  # f/F down to which the pair is followed if it does not end

Bracket = tuple[Fraction, Fraction]


class Part(NamedTuple):
    """A cell, and an enclosure without 0 of (1 + trace) τ_1 on it, in scaled units, or None."""

    cell: Cell
    twist: Bracket | None

    @property
    def sign(self) -> str:
        """The sign of the twist, or that there is none."""
        return NONE if self.twist is None else "+" if self.twist[0] > 0 else "-"


class Curve:
    """The pair at exact δ, in the units of the parameters, and what is claimed of it."""

    def __init__(self, scale: Scale, birth: Ball) -> None:
        self.scale, self.birth = scale, birth
        self.places = scale.setting.precise
        setting = scale.setting
        self.low, self.high = range_of_f(setting.options, setting.parameters)

    def at(self, delta: Fraction) -> Orbit:
        """Return the orbit."""
        return asymmetric(interval.ball(delta), self.scale.rho)

    def force(self, delta: Fraction) -> Ball:
        """Return f."""
        f: Ball = self.at(delta).alpha * self.scale.F
        return f

    def least(self, delta: Fraction) -> Ball:
        """Return the least speed."""
        speed: Ball = self.at(delta).slowest()[0] * self.scale.F / self.scale.omega
        return speed

    def trace(self, delta: Fraction) -> Ball:
        """Return the trace."""
        trace: Ball = self.at(delta).trace()
        return trace

    def end(self) -> tuple[Bracket | None, Fraction]:
        """Return where the least speed vanishes, if it does, and where the cells end.

        If it does not above the lowest f of interest, or `LOWEST`, they end a little below that.
        """
        p = self.scale.p
        lowest = interval.ball(self.low * Fraction(999, 1000) / p.F if self.low else LOWEST)
        if not self.birth > lowest:
            born = interval.outward(self.birth * self.scale.F, 6 - interval.decade(p.F))[1]
            raise BadInput(f"the pair exists for f < {born} only: give a lower --from")
        top, _ = asymmetry(lowest, self.scale.rho, 12)
        if not top:
            raise NotProved("range", "the pair is born too near the lowest f: give a lower --from")
        if self.least(top) > 0:
            return None, top
        end = bisection.crossing(self.least, Fraction(0), top, self.places)
        return end, end[1]

    def resonances(self, last: Fraction) -> dict[Fraction, Bracket]:
        """Return p/q with the δ between which the rotation number passes it, ascending in p/q."""
        found = {}
        for ratio in sorted(
            {Fraction(p, q) for q in range(2, MOST + 1) for p in range(1, q // 2 + 1)}
        ):
            level = 2 * (2 * interval.pi() * interval.ball(ratio)).cos()
            if ratio == Fraction(1, 2):
                level = Ball(-2)
            above = self.trace(last) - level
            if above < 0:
                found[ratio] = self._passes(level, last)
            elif not above > 0:
                raise NotProved("resonances", f"the pair may end at the resonance {ratio}")
        return found

    def _passes(self, level: Ball, last: Fraction) -> Bracket:
        """Return the δ between which the trace, 2 at δ = 0, passes a level."""
        return bisection.crossing(
            lambda delta: self.trace(delta) - level, Fraction(0), last, self.places
        )

    def claims(
        self,
        end: Bracket | None,
        limits: Pair,
        resonances: dict[Fraction, Bracket],
        cells: list[Part],
    ) -> tuple[dict[str, Any], list[Bracket]]:
        """Return the claims, and where in δ the twist vanishes."""
        scale, zeros = self.scale, list(_zeros(cells))
        for ends in zeros:
            self._is_no_pole(ends)
        return {
            "f_start": scale.force(self.birth),
            "f_end": self._force_at(end) if end else NONE,
            "trace_end": scale.number(interval.hull(*map(self.trace, end))) if end else NONE,
            "f_range": limits,
            "resonances": [
                {"ratio": str(ratio), "f": self._force_at(ends)}
                for ratio, ends in resonances.items()
            ],
            "twist_zeros": [self._force_over(ends) for ends in zeros],
            "exceptions": self._exceptions(limits, resonances, cells),
            "cells": [self._cell(part) for part in cells],
        }, zeros

    def _is_no_pole(self, ends: Bracket) -> None:
        """Prove that the trace is not -1 in a bracket: there N = (1 + T) τ_1 may vanish alone."""
        above, below = (self.trace(delta) + 1 for delta in ends)
        if not (below > 0 or above < 0):
            raise NotProved("twist", "it may vanish at the resonance 1/3", {"delta": ends})

    def _force_at(self, ends: Bracket) -> Pair:
        """Return the claim on f, for δ in a tiny interval."""
        alphas = (self.at(delta).alpha for delta in ends)
        return self.scale.force(interval.hull(*alphas))

    def range(self, end: Bracket | None, last: Fraction) -> Pair:
        """Return decimals inside which all f have a pair."""
        lower, upper = self.force(end[0] if end else last), self.birth * self.scale.F
        places = self.scale.setting.digits - interval.decade(self.scale.p.F)
        low, high = interval.outward(lower, places)[1], interval.outward(upper, places)[0]
        if not Fraction(low) < Fraction(high):
            raise TooFewDigits("range", "birth and end of the pair are too close", {"f": low})
        found = f"{float(low):.10g} and {float(high):.10g}"
        if self.low and self.low > Fraction(low):
            low = _shown(self.low, places, up=True)
        if self.high and self.high < Fraction(high):
            high = _shown(self.high, places, up=False)
        if not Fraction(low) < Fraction(high):
            raise BadInput(f"no pair is found but for f between {found}: give other --from, --to")
        return [low, high]

    def _force_over(self, ends: Bracket) -> Pair:
        """Return the claim on f, for δ in a cell."""
        return self._wide(self.force, ends, self.scale.p.F)

    def _wide(self, value: Callable[[Fraction], Ball], ends: Bracket, unit: Fraction) -> Pair:
        """Return decimals around the values at both ends, between which a monotone function is."""
        places = max(0, WIDE - interval.decade(unit))
        pairs = [interval.outward(value(delta), places) for delta in ends]
        return [
            min((low for low, _ in pairs), key=Fraction),
            max((h for _, h in pairs), key=Fraction),
        ]

    def _cell(self, part: Part) -> dict[str, Any]:
        p = self.scale.p
        return {
            "delta": decimals(part.cell),
            "f": self._force_over(part.cell),
            "trace": self._wide(self.trace, part.cell, Fraction(1)),
            "least_speed": self._wide(self.least, part.cell, p.F / p.omega),
            "twist": part.sign,
            "regular_twist": self._twist(part.twist),
        }

    def _twist(self, scaled: Bracket | None) -> Pair | str:
        """Return the claim on (1 + trace) τ_1; the scaled unit of area is F²/ω³."""
        if scaled is None:
            return NONE
        p = self.scale.p
        low, high = (interval.ball(q * p.omega**3 / p.F**2) for q in scaled)
        value = interval.hull(low, high)
        size = max(map(abs, interval.ends(value)))
        return list(interval.outward(value, 6 - interval.decade(size)))

    def _exceptions(
        self, limits: Pair, resonances: dict[Fraction, Bracket], cells: list[Part]
    ) -> list[Pair]:
        """Return the f of the range for which invariant curves are not claimed.

        Disjoint intervals; where the trace is below -2 nothing is claimed anyway.
        """
        low, high = limits
        parabolic = resonances.get(Fraction(1, 2))
        if parabolic:
            low = max(low, self._force_at(parabolic)[0], key=Fraction)
        excluded: list[Bracket] = [part.cell for part in cells if part.twist is None]
        pairs = [self._force_over(ends) for ends in excluded]
        pairs += [self._force_at(resonances[ratio]) for ratio in LOW_ORDER if ratio in resonances]
        cut = [[max(a, low, key=Fraction), min(b, high, key=Fraction)] for a, b in pairs]
        joined: list[Pair] = []
        for a, b in sorted((p for p in cut if Fraction(p[0]) <= Fraction(p[1])), key=_lower):
            if joined and Fraction(a) <= Fraction(joined[-1][1]):
                joined[-1][1] = max(joined[-1][1], b, key=Fraction)
            else:
                joined.append([a, b])
        return joined


def _zeros(cells: list[Part]) -> Iterator[Bracket]:
    """Give the cells without sign between cells of different signs."""
    for before, part, after in zip(cells, cells[1:], cells[2:], strict=False):
        if part.twist is None and {before.sign, after.sign} == {"+", "-"}:
            yield part.cell


def _lower(pair: Pair) -> Fraction:
    return Fraction(pair[0])


def _shown(value: Fraction, places: int, *, up: bool) -> str:
    """Return a decimal not below, or not above, a number."""
    unit, shown = Fraction(10) ** -places, max(places, 0)
    multiple = -(-value // unit) if up else value // unit
    return interval.decimal(multiple * unit, shown)


def decimals(ends: Bracket) -> Pair:
    """Return exact decimals."""
    return [interval.exact_decimal(delta) for delta in ends]
