"""Why a guard that is not the next event stays positive on a flight: found by exact algebra.

*Lemma M.*  If L h = - sum of c_i h_i over other guards h_i of the mode, with numbers c_i > 0, then
h decreases as long as these are positive: it is positive before it comes to zero, and negative
afterwards.

*Lemma C.*  If (L + lambda) h = g depends on the clock and on constants of the flight alone, lambda
a constant, then e^(lambda t) h has the derivative e^(lambda t) g: its extrema are at zeros of g.
If L^2 h = g does, h is convex or concave between the zeros of g.

*Lemma B.*  For any h: bisection in time, with a mean value form by L h.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations

from cap.system.model import System
from cap.system.polynomial import COS, SIN, ZERO, Polynomial

MOST = 3  # guards in a sum of Lemma M


@dataclass(frozen=True)
class Falls:
    """Lemma M: the numbers c_i, by the names of guards."""

    others: Mapping[str, Fraction]


@dataclass(frozen=True)
class Clocked:
    """Lemma C: (L + rate)^order h = ``value``, order 1 or 2; rate is 0 if it is 2.

    ``constants`` are the variables of the state that occur in it; they are constant on a flight.
    """

    order: int
    rate: Polynomial
    value: Polynomial
    constants: tuple[str, ...]


@dataclass(frozen=True)
class Bisected:
    """Lemma B: nothing is known of h but that it is smooth."""


Lemma = Falls | Clocked | Bisected


def lemmas(system: System, mode: str) -> dict[str, Lemma]:
    """Return a lemma for each guard of a mode, as M, C, B in this order of preference.

    The guards come in an order in which Lemma M uses only guards before it, so no two lean on each
    other.
    """
    found: dict[str, Lemma] = {}
    waiting = {name: _falls(system, mode, name) for name in system.modes[mode].guards}
    while waiting:
        ready = [n for n, lemma in waiting.items() if lemma and lemma.others.keys() <= found.keys()]
        other = [n for n, lemma in waiting.items() if lemma is None]
        name = next(iter(other or ready or waiting))
        lemma = waiting.pop(name)
        leans = lemma is not None and lemma.others.keys() <= found.keys()
        found[name] = lemma if lemma and leans else _otherwise(system, mode, name)
    return found


def _falls(system: System, mode: str, name: str) -> Falls | None:
    """Return Lemma M for a guard if there is one, with as few others as possible."""
    guards = system.modes[mode].guards
    rate = system.lie(mode, guards[name].value)
    others = {n: g.value for n, g in guards.items() if n != name and rate}
    for count in range(1, MOST + 1):
        for names in combinations(others, count):
            weights = _combination(-rate, {n: others[n] for n in names})
            if weights is not None and min(weights.values()) > 0:
                return Falls(weights)
    return None


def _combination(target: Polynomial, parts: Mapping[str, Polynomial]) -> dict[str, Fraction] | None:
    """Return c_i with target = sum c_i part_i; None if there are none, or not by this method.

    Each part that has a monomial of its own is taken away first.
    """
    if not parts:
        return None if target else {}
    for name, part in parts.items():
        others = {n: q for n, q in parts.items() if n != name}
        shared = {m for q in others.values() for m in q.terms}
        own = next((m for m in part.terms if m not in shared), None)
        if own is not None:
            c = target.terms.get(own, Fraction(0)) / part.terms[own]
            rest = _combination(target - part * c, others)
            return None if rest is None else {name: c, **rest}
    return None


def _otherwise(system: System, mode: str, name: str) -> Clocked | Bisected:
    """Return Lemma C for a guard, else B."""
    return next(_clocked(system, mode, name), Bisected())


def _clocked(system: System, mode: str, name: str) -> Iterator[Clocked]:
    """Yield the forms of Lemma C that hold for a guard."""
    h = system.guard(mode, name).value
    first = system.lie(mode, h)
    field = system.modes[mode].field
    constants = {z for z in system.state if not field[z]}
    slopes = (first.derivative(z) for z in system.state)
    for rate in (ZERO, *(sign * q for q in slopes for sign in (-1, 1) if system.is_constant(q))):
        yield from _clock_alone(system, constants, Clocked(1, rate, first + rate * h, ()))
    yield from _clock_alone(system, constants, Clocked(2, ZERO, system.lie(mode, first), ()))


def _clock_alone(system: System, constants: set[str], lemma: Clocked) -> Iterator[Clocked]:
    """Yield a lemma if only the clock and constants of the flight occur in it."""
    used = lemma.value.variables & set(system.state)
    if used <= constants:
        yield Clocked(lemma.order, lemma.rate, lemma.value, tuple(sorted(used)))


def clock_part(lemma: Clocked) -> tuple[Polynomial, Polynomial, Polynomial] | None:
    """Return a, b, c of g = a cos wt + b sin wt + c; None if g is not of this form."""
    g = lemma.value
    a, b = g.derivative(COS), g.derivative(SIN)
    if {COS, SIN} & (a.variables | b.variables):
        return None
    return a, b, g.without(COS, SIN)
