"""The legs of orbits of a model: flights between events, and the derivatives of states by states.

A leg is a flight exp(M d) y and the event at its end.  Let h be the guard of the event, R its
reset, f the field before it, g the field after it.  At fixed times the state q after the event has
the derivative by the state before it

    dR/dq + (g - R') grad h / (L h),   R' the derivative of R in time along f: a saltation matrix.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property, lru_cache, partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cap.floats.models.engine import Ends, Engine
from cap.floats.models.identities import resting
from cap.floats.models.spectrum import Exponential, Floats, evaluated, number
from cap.system.polynomial import COS, ONE, SIN, Polynomial, Quotient

NONE = -1  # no event: the end of the time


@dataclass(frozen=True)
class Leg:
    """Legs (K,) of one kind: flights in ``mode`` from times and states, then an event, or none.

    ``word`` is the place of the event among `Engine.words`, ``to`` the mode after it; ``place``
    (K,) tells which legs these are.
    """

    mode: int
    word: int
    to: int
    place: NDArray[np.int64]


@dataclass(frozen=True)
class Legs:
    """The legs of N orbits, those of an orbit one after the other; ``phase`` of the clock at first.

    ``orbit``, ``begin``, ``end``, ``mode``, ``word``, ``to`` (K,); ``state`` (K, n) at the begin.
    """

    engine: Engine
    orbit: NDArray[np.int64]
    begin: Floats
    end: Floats
    mode: NDArray[np.int64]
    word: NDArray[np.int64]
    to: NDArray[np.int64]
    state: Floats
    phase: float = 0.0

    @staticmethod
    def of(
        engine: Engine,
        states: Floats,
        modes: NDArray[np.int64],
        ends: Ends,
        end: float,
        phase: float = 0.0,
    ) -> Legs:
        """Return the legs of orbits from their states and modes, and their log."""
        N, E = len(states), len(ends.log)
        orbit = np.concatenate([ends.log[:, 0].astype(np.int64), np.arange(N)])
        order = np.lexsort((np.arange(E + N), orbit))  # the end after all events
        first = np.concatenate([[True], np.diff(orbit[order]) != 0])
        word = np.concatenate([ends.log[:, 2].astype(np.int64), np.full(N, NONE)])[order]
        to = np.concatenate([ends.log[:, 3].astype(np.int64), ends.modes])[order]
        until = np.concatenate([ends.log[:, 1], np.full(N, end)])[order]
        after = np.concatenate([ends.log[:, 4:], np.full((N, states.shape[1]), np.nan)])[order]
        begin = np.where(first, 0.0, np.roll(until, 1))
        mode = np.where(first, modes[orbit[order]], np.roll(to, 1))
        state = np.where(first[:, None], states[orbit[order]], np.roll(after, 1, axis=0))
        return Legs(engine, orbit[order], begin, until, mode, word, to, state, phase)

    def kinds(self) -> Iterator[Leg]:
        """Yield the kinds of legs that occur."""
        key = np.stack([self.mode, self.word, self.to], axis=1)
        for mode, word, to in np.unique(key, axis=0).tolist():
            place = np.flatnonzero((key == (mode, word, to)).all(axis=1))
            yield Leg(mode, word, to, place)

    @property
    def flights(self) -> list[Exponential]:
        """The exponentials of the modes."""
        return self.engine.exponentials

    @cached_property
    def omega(self) -> float:
        """The frequency of the clock."""
        return float(number(self.engine.system.omega))

    def full(self, states: Floats, times: Floats) -> Floats:
        """Return y = (state, cos, sin, 1) (..., Z)."""
        angle = self.phase + self.omega * np.asarray(times)[..., None]
        return np.concatenate([states, np.cos(angle), np.sin(angle), np.ones_like(angle)], axis=-1)

    def at(self, k: int, d: Floats) -> Floats:
        """Return the states (J, n) on a leg, times (J,) after its begin."""
        y = self.full(self.state[k], self.begin[k])
        return self.flights[int(self.mode[k])].flown(y, d)[:, : self.state.shape[1]]

    def derivatives(self, *, sectional: bool = False) -> Floats:
        """Return (K, n, n) the derivative of the state at the end of each leg by that at its begin.

        With ``sectional`` not at a fixed time, but at the event; a leg without event is 1 then.
        """
        n = self.state.shape[1]
        found = np.tile(np.eye(n), (len(self.mode), 1, 1))
        for leg in self.kinds():
            if leg.word == len(self.engine.words) - 1:
                found[leg.place] = self._captured(leg)
            elif leg.word != NONE or not sectional:
                found[leg.place] = self._derivative(leg, sectional=sectional)
        return found

    def _derivative(self, leg: Leg, *, sectional: bool) -> Floats:
        """Return the derivatives (K, n, n) of legs of one kind."""
        begin, d, n = self.begin[leg.place], (self.end - self.begin)[leg.place], self.state.shape[1]
        E = matrices(self.flights[leg.mode], d)
        flown = E[:, :n, :n]
        if leg.word == NONE:
            return flown
        start = self.full(self.state[leg.place], begin)
        y = np.einsum("kij,kj->ki", E, start)
        values = dict(zip((*self.engine.system.state, COS, SIN), y.T, strict=False))
        jump = _jump(self.engine, leg.mode, leg.word, leg.to)
        grad, change = _values(jump.slopes, values), -_values(jump.rates, values)
        by = _values(jump.by, values).reshape(-1, n, n)
        if not sectional:
            reset = _values(jump.reset, values)
            after = values | dict(zip(self.engine.system.state, reset.T, strict=True))
            change = change + _values(jump.field, after)
        speed = _values([jump.speed], values)[:, :, None]
        saltation = by + change[:, :, None] * grad[:, None, :] / speed
        return np.asarray(saltation @ flown)

    def _captured(self, leg: Leg) -> Floats:
        """Return the derivatives where a mass comes to rest: of the state with h = L h = 0."""
        system, before = self.engine.system, leg.place - 1
        y = self.full(self.state[leg.place], self.end[leg.place])
        values = dict(zip((*system.state, COS, SIN), y.T, strict=False))
        found = np.empty((len(y), len(system.state), len(system.state)))
        for m, w in set(zip(self.mode[before].tolist(), self.word[before].tolist(), strict=True)):
            mode = self.engine.modes[m]
            own = (self.mode[before] == m) & (self.word[before] == w)
            rest = resting(system, mode, system.guard(mode, self.engine.words[w]))
            for i, q in enumerate(map(Quotient.of, rest)):
                slopes = [slope(q, along(z)) for z in system.state]
                found[own, i] = _values(slopes, values)[own]
        return found

    def numbered(self) -> NDArray[np.int64]:
        """Return for each leg its number among those of its orbit."""
        first = np.concatenate([[True], np.diff(self.orbit) != 0])
        places = np.arange(len(self.orbit))
        return places - np.maximum.accumulate(np.where(first, places, 0))


class Jump(NamedTuple):
    """Of an event: grad h, dR/dq row by row, R', R, L h; and the field g after it."""

    slopes: list[Quotient]
    by: list[Quotient]
    rates: list[Quotient]
    reset: list[Quotient]
    speed: Quotient
    field: list[Quotient]


@lru_cache(maxsize=512)
def _jump(engine: Engine, m: int, w: int, to: int) -> Jump:
    """Return what the derivative at an event is made of."""
    system, mode, word = engine.system, engine.modes[m], engine.words[w]
    h, names = system.guard(mode, word).value, system.state
    reset = [system.reset(mode, word)[z] for z in names]
    lie = partial(system.lie, mode)
    return Jump(
        [Quotient.of(h.derivative(z)) for z in names],
        [slope(q, along(z)) for q in reset for z in names],
        [slope(q, lie) for q in reset],
        reset,
        Quotient.of(lie(h)),
        [Quotient.of(system.modes[engine.modes[to]].field[z]) for z in names],
    )


def matrices(E: Exponential, d: Floats) -> Floats:
    """Return exp(M d) (K, Z, Z) for times (K,)."""
    x = np.multiply.outer(d, E.rates)
    R = np.exp(x) - 1 - x - x * x / 2
    linear = np.multiply.outer(d, E.first) + np.multiply.outer(d * d / 2, E.second)
    parts = np.tensordot(R.real, E.real, 1) + np.tensordot(R.imag, E.imaginary, 1)
    return np.asarray(np.eye(len(E.first)) + linear + parts)


def slope(q: Quotient, derivative: Callable[[Polynomial], Polynomial]) -> Quotient:
    """Return a derivative of a quotient, given that of polynomials."""
    top, below = q.numerator, q.denominator
    return Quotient(derivative(top) * below - top * derivative(below), below * below)


def along(name: str) -> Callable[[Polynomial], Polynomial]:
    """Return the derivative in a variable."""
    return lambda q: q.derivative(name)


def _values(table: list[Quotient], values: dict[str, Floats]) -> Floats:
    """Return the values (K, J) of functions."""
    found = np.zeros((len(next(iter(values.values()))), len(table)))
    for k, q in enumerate(table):
        if q.numerator:
            found[:, k] = evaluated(q.numerator, values)
        if q.denominator != ONE:
            found[:, k] /= evaluated(q.denominator, values)
    return found
